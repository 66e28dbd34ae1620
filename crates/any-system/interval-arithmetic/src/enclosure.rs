//! Intervals that hold a value for certain.

use crate::error::Error;
use crate::rounding::{down, up};
use std::fmt;

/// An interval that holds a number, or all values of a function, for certain.
///
/// No interval is inverted or empty: [`Enclosure::between`] and [`Enclosure::point`] refuse what is none, and
/// [`Enclosure::new`] makes [`Enclosure::NONE`] of it. An end that is NaN is no bound: results of operations are without a bound on
/// its side, and neither [`Enclosure::sign`] nor another test tells anything of such an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Enclosure {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// The two ends, shortest and exactly: `[0.5, 1]`.
impl fmt::Display for Enclosure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = [self.low, self.high].map(shown);
        write!(formatter, "[{low}, {high}]")
    }
}

/// A number with all its digits, and with an exponent if it would have many zeros.
fn shown(number: f64) -> String {
    let size = number.abs();
    match size == 0.0 || !size.is_finite() || (1e-7..1e17).contains(&size) {
        true => number.to_string(),
        false => format!("{number:e}"),
    }
}

impl From<f64> for Enclosure {
    /// The number alone, without a check.
    #[inline]
    fn from(number: f64) -> Self {
        Enclosure { low: number, high: number }
    }
}

impl Enclosure {
    /// The number 0.
    pub const ZERO: Self = Enclosure { low: 0.0, high: 0.0 };

    /// The number 1.
    pub const ONE: Self = Enclosure { low: 1.0, high: 1.0 };

    /// All numbers: nothing is known.
    pub const WHOLE: Self = Enclosure { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// No interval, as IEEE 1788 has it: both ends are NaN. No test is true of it, and operations on it have no bounds.
    pub const NONE: Self = Enclosure { low: f64::NAN, high: f64::NAN };

    /// [low, high]; [`NONE`](Self::NONE) unless low ≤ high.
    #[inline]
    pub const fn new(low: f64, high: f64) -> Self {
        if low <= high { Enclosure { low, high } } else { Self::NONE }
    }

    /// The lower bound.
    #[inline]
    pub const fn low(&self) -> f64 {
        self.low
    }

    /// The upper bound.
    #[inline]
    pub const fn high(&self) -> f64 {
        self.high
    }

    /// [low, high].
    ///
    /// # Errors
    /// [`Error::Ends`] for an end that is not finite, or for low > high.
    pub fn between(low: f64, high: f64) -> Result<Self, Error> {
        if low.is_finite() && high.is_finite() && low <= high {
            Ok(Enclosure { low, high })
        } else {
            Err(Error::Ends { low, high })
        }
    }

    /// The interval that holds one number alone, which the `f64` is exactly.
    ///
    /// # Errors
    /// [`Error::Ends`] for a number that is not finite.
    pub fn point(value: f64) -> Result<Self, Error> {
        Enclosure::between(value, value)
    }

    /// A number that differs from `value` by at most `error`.
    #[inline]
    pub fn around(value: f64, error: f64) -> Self {
        Enclosure { low: down(value - error), high: up(value + error) }
    }

    /// The number is in the interval.
    #[inline]
    pub fn contains(&self, value: f64) -> bool {
        self.low <= value && value <= self.high
    }

    /// Every number of this interval is in the other one.
    #[inline]
    pub fn is_inside(&self, other: &Self) -> bool {
        other.low <= self.low && self.high <= other.high
    }

    /// All values are above zero.
    #[inline]
    pub fn is_positive(&self) -> bool {
        self.low > 0.0 && self.low <= self.high
    }

    /// All values are below zero.
    #[inline]
    pub fn is_negative(&self) -> bool {
        self.high < 0.0 && self.low <= self.high
    }

    /// The common sign of all values, ±1; `None` if the interval holds zero.
    pub fn sign(&self) -> Option<f64> {
        if self.is_positive() {
            Some(1.0)
        } else if self.is_negative() {
            Some(-1.0)
        } else {
            None
        }
    }

    /// The largest absolute value; ∞ without a bound on it.
    #[inline]
    pub fn magnitude(&self) -> f64 {
        // A maximum of `f64` passes over NaN.
        if self.low <= self.high { self.low.abs().max(self.high.abs()) } else { f64::INFINITY }
    }

    /// An upper bound of the distance between two values.
    #[inline]
    pub fn width(&self) -> f64 {
        if self.low == self.high { 0.0 } else { up(self.high - self.low) }
    }

    /// A number of the interval, next to its middle; NaN for an interval without bounds on both sides.
    #[inline]
    pub fn middle(&self) -> f64 {
        self.low.midpoint(self.high)
    }

    /// The smallest interval that contains both.
    #[inline]
    pub fn hull(&self, other: &Self) -> Self {
        // Minima and maxima of `f64` pass over NaN.
        let least = |a: f64, b: f64| {
            if a <= b {
                a
            } else if b < a {
                b
            } else {
                f64::NEG_INFINITY
            }
        };
        Enclosure { low: least(self.low, other.low), high: -least(-self.high, -other.high) }
    }

    /// The numbers in both; `None` if there are none.
    ///
    /// Two enclosures of one number always have a common part.
    #[inline]
    pub fn intersection(&self, other: &Self) -> Option<Self> {
        let (low, high) = (self.low.max(other.low), self.high.min(other.high));
        (low <= high).then_some(Enclosure { low, high })
    }

    /// Both ends moved outwards by `by` ≥ 0.
    #[inline]
    pub fn widened(&self, by: f64) -> Self {
        Enclosure { low: down(self.low - by), high: up(self.high + by) }
    }

    /// The values of a function on `domain`, from its value at a point of it and its slope on it: f(c) +
    /// f′(domain)·(domain − c).
    ///
    /// ```
    /// # use interval_arithmetic::Enclosure;
    /// // x (1 − x) next to its maximum: the slope 1 − 2x is small, and so is the width.
    /// let x = Enclosure::between(0.49, 0.51)?;
    /// let plain = x * (Enclosure::ONE - x);
    /// let c = Enclosure::point(0.5)?;
    /// let slope = Enclosure::ONE - 2.0 * x;
    /// let range = Enclosure::mean_value(c * (Enclosure::ONE - c), slope, x, c);
    /// assert!(range.contains(0.2499) && range.contains(0.25));
    /// assert!(range.width() < 0.05 * plain.width());
    /// # Ok::<(), interval_arithmetic::Error>(())
    /// ```
    #[inline]
    pub fn mean_value(at_point: Self, slope: Self, domain: Self, point: Self) -> Self {
        at_point + slope * (domain - point)
    }
}
