//! Sine, cosine and arc tangent of intervals.

use crate::enclosure::Enclosure;
use crate::rounding::{down, up};

/// π: the `f64` below it, and the one above it.
pub const PI: Enclosure = Enclosure { low: std::f64::consts::PI, high: 3.141_592_653_589_793_6 };

/// The largest argument whose place among the multiples of π is looked for. Beyond it the result is [−1, 1]. Below it a multiple kπ is
/// enclosed to some ulps of itself, far less than 1.
const LARGEST_ARGUMENT: f64 = 1e9;

/// The least and the greatest value of a function that has the value 1 at 2kπ + `shift`, −1 half a turn later, and is
/// monotone between. `value` is the function, correctly rounded.
#[inline]
fn wave(x: Enclosure, value: fn(f64) -> f64, shift: f64) -> Enclosure {
    if !(x.magnitude() <= LARGEST_ARGUMENT && x.low <= x.high) {
        return Enclosure::new(-1.0, 1.0);
    }
    let (at_low, at_high) = (value(x.low), value(x.high));
    let mut low = down(at_low.min(at_high)).max(-1.0);
    let mut high = up(at_low.max(at_high)).min(1.0);
    // The extrema are at kπ + shift·π. Candidates reach one further than the rounded places, on both sides.
    let pi = std::f64::consts::PI;
    let first = (x.low / pi - shift).floor() as i64;
    let last = (x.high / pi - shift).ceil() as i64;
    if last - first > 3 {
        return Enclosure::new(-1.0, 1.0);
    }
    for k in first..=last {
        let place = PI * (k as f64 + shift);
        if place.low <= x.high && x.low <= place.high {
            if k % 2 == 0 {
                high = 1.0;
            } else {
                low = -1.0;
            }
        }
    }
    Enclosure { low, high }
}

impl Enclosure {
    /// The sines of the numbers, in radians. An interval with an argument above 10⁹ has all of [−1, 1].
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let hump = Enclosure::between(1.0, 2.0)?.sin();
    /// assert_eq!(hump.high, 1.0); // the maximum at ½π is inside
    /// assert!((hump.low - 0.8414709848078965).abs() < 1e-15);
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    #[inline]
    pub fn sin(self) -> Self {
        wave(self, pxfm::f_sin, 0.5)
    }

    /// The cosines of the numbers, in radians. An interval with an argument above 10⁹ has all of [−1, 1].
    #[inline]
    pub fn cos(self) -> Self {
        wave(self, pxfm::f_cos, 0.0)
    }

    /// The arc tangents of the numbers.
    #[inline]
    pub fn arctan(self) -> Self {
        Enclosure { low: down(pxfm::f_atan(self.low)), high: up(pxfm::f_atan(self.high)) }
    }
}
