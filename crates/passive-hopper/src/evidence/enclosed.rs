//! A number with a bound on its error, as users see it.

use crate::precision::ball::Ball;
use crate::precision::real::Extended;

/// A number that is known to lie within `error` of `value`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Enclosed {
    /// The nearest `f64` to the middle of the enclosure.
    pub value: f64,
    /// Bound on |`value` − the exact number|. Infinite if nothing is known.
    pub error: f64,
}

/// Covers the roundings of a bound in `f64`.
const ROOM: f64 = 1.0 + 8.0 * f64::EPSILON;

impl Enclosed {
    /// The numbers of a ball.
    pub(crate) fn of<R: Extended>(ball: Ball<R>) -> Self {
        let value = ball.middle.nearest();
        let off = (ball.middle + -value).nearest().abs();
        let error = ROOM * (off + ball.radius);
        Enclosed { value, error: if error.is_nan() { f64::INFINITY } else { error } }
    }

    /// Bound on the error of a `computed` value of this number.
    ///
    /// ```
    /// use passive_hopper::Enclosed;
    /// let third = Enclosed { value: 1.0 / 3.0, error: 1e-17 };
    /// let error = third.error_of(0.333);
    /// assert!(error >= 1.0 / 3.0 - 0.333 && error < 1e-17 + 1.0 / 2999.0);
    /// ```
    pub fn error_of(self, computed: f64) -> f64 {
        ROOM * ((computed - self.value).abs() + self.error)
    }

    /// Whether more digits would change no more than a part of the last bit of `value`.
    pub(crate) fn is_sharp(self) -> bool {
        self.error <= SHARP * self.value.abs()
    }
}

/// An error that is not larger, relative to its number, is no reason for longer arithmetic: a rounding, and a quarter of it.
const SHARP: f64 = 0.625 * f64::EPSILON;
