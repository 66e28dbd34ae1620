//! Sine, cosine and arc tangent of intervals.
//!
//! What is taken as given, and how wide the results are: see `elementary.rs`.

use crate::enclosure::Enclosure;
use crate::rounding::{down, up};

/// π: the `f64` below it, and the one above it.
pub const PI: Enclosure = Enclosure { low: std::f64::consts::PI, high: 3.141_592_653_589_793_6 };

/// The largest argument whose place among the multiples of π is looked for. Beyond it the result is [−1, 1]. Below
/// it a multiple kπ is enclosed to some ulps of itself, far less than 1.
const LARGEST_ARGUMENT: f64 = 1e9;

/// All values of a sine or a cosine.
const ALL: Enclosure = Enclosure::new(-1.0, 1.0);

/// Both ends are numbers whose place among the multiples of π can be found.
#[inline]
fn has_places(x: Enclosure) -> bool {
    x.magnitude() <= LARGEST_ARGUMENT && x.low <= x.high
}

/// The k of all (k + `shift`)π that may be in the interval; `None` if there may be more than four, and if they cannot
/// be told.
#[inline]
pub(crate) fn multiples_of_pi(x: Enclosure, shift: f64) -> Option<impl Iterator<Item = i64>> {
    if !has_places(x) {
        return None;
    }
    // The rounded places reach one further than the exact ones, on both sides.
    let pi = std::f64::consts::PI;
    let first = (x.low / pi - shift).floor() as i64;
    let last = (x.high / pi - shift).ceil() as i64;
    let may_be_inside = move |k: &i64| {
        let place = PI * (*k as f64 + shift);
        place.low <= x.high && x.low <= place.high
    };
    (last - first <= 3).then(|| (first..=last).filter(may_be_inside))
}

/// The least and the greatest value of a function that has the value 1 at (2k + `shift`)π, −1 half a turn later, and is
/// monotone between. `at_low` and `at_high` are its values at the ends, within one `f64`.
#[inline]
fn wave(x: Enclosure, at_low: f64, at_high: f64, shift: f64) -> Enclosure {
    let mut low = down(at_low.min(at_high)).max(-1.0);
    let mut high = up(at_low.max(at_high)).min(1.0);
    if x.low == x.high {
        return Enclosure { low, high };
    }
    let Some(places) = multiples_of_pi(x, shift) else { return ALL };
    for k in places {
        if k % 2 == 0 {
            high = 1.0;
        } else {
            low = -1.0;
        }
    }
    Enclosure { low, high }
}

impl Enclosure {
    /// The sines of the numbers, in radians. A wide interval with an argument above 10⁹ has all of [−1, 1].
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// let hump = Enclosure::between(1.0, 2.0)?.sin();
    /// assert_eq!(hump.high(), 1.0); // the maximum at ½π is inside
    /// assert!((hump.low() - 0.8414709848078965).abs() < 1e-15);
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    #[inline]
    pub fn sin(self) -> Self {
        self.sin_cos().0
    }

    /// The cosines of the numbers, in radians. A wide interval with an argument above 10⁹ has all of [−1, 1].
    #[inline]
    pub fn cos(self) -> Self {
        self.sin_cos().1
    }

    /// The sines and the cosines of the numbers: one computation for both.
    #[inline]
    pub fn sin_cos(self) -> (Self, Self) {
        if !has_places(self) {
            return self.far_sin_cos();
        }
        let at_low = pxfm::f_sincos(self.low);
        let at_high = if self.low == self.high { at_low } else { pxfm::f_sincos(self.high) };
        (wave(self, at_low.0, at_high.0, 0.5), wave(self, at_low.1, at_high.1, 0.0))
    }

    /// The same where the place among the multiples of π is not known: the values in the middle, and what they change up
    /// to the ends, because no slope is above 1.
    #[cold]
    fn far_sin_cos(self) -> (Self, Self) {
        let middle = self.middle();
        let radius = up((self.high - middle).max(middle - self.low));
        // NaN too.
        if !(radius < 1.0 && middle.is_finite()) {
            return (ALL, ALL);
        }
        let around = |value: f64| Enclosure {
            low: down(down(value) - radius).max(-1.0),
            high: up(up(value) + radius).min(1.0),
        };
        let (sine, cosine) = pxfm::f_sincos(middle);
        (around(sine), around(cosine))
    }

    /// The arc tangents of the numbers.
    #[inline]
    pub fn arctan(self) -> Self {
        Enclosure { low: down(pxfm::f_atan(self.low)), high: up(pxfm::f_atan(self.high)) }
    }
}
