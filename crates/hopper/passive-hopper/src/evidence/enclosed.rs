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

    /// The product, with the error that both errors give it.
    pub fn times(self, other: Self) -> Self {
        let error = (self.value.abs() + self.error) * other.error + self.error * other.value.abs();
        Self::rounded(self.value * other.value, error)
    }

    /// The sum.
    pub fn plus(self, other: Self) -> Self {
        Self::rounded(self.value + other.value, self.error + other.error)
    }

    /// The quotient; of one by a number that may be zero nothing is known.
    pub fn over(self, other: Self) -> Self {
        let (quotient, least) = (self.value / other.value, other.value.abs() - other.error);
        let error = (self.error + quotient.abs() * other.error) / least;
        Self::rounded(quotient, if least > 0.0 { ROOM * error } else { f64::INFINITY })
    }

    /// A value that one operation has rounded, in normal numbers.
    fn rounded(value: f64, error: f64) -> Self {
        Enclosed { value, error: ROOM * (error + 0.5 * f64::EPSILON * value.abs()) }
    }

    /// Whether more digits would change no more than a part of the last bit of `value`.
    pub(crate) fn is_sharp(self) -> bool {
        self.error <= SHARP * self.value.abs()
    }
}

/// An error that is not larger, relative to its number, is no reason for longer arithmetic: a rounding, and a
/// quarter of it.
const SHARP: f64 = 0.625 * f64::EPSILON;

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// The results hold those of every number of the operands: of the ends and of the middle.
        #[test]
        fn operations_hold_what_their_operands_hold(a in -5.0..5f64, b in -5.0..5f64, wide in 0.0..2f64, wide_b in 0.0..2f64) {
            let (x, y) = (Enclosed { value: a, error: wide }, Enclosed { value: b, error: wide_b });
            for (p, q) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 0.5)] {
                let (s, t) = (a + p * wide, b + q * wide_b);
                let holds = |found: Enclosed, exact: f64| {
                    (found.value - exact).abs() <= found.error + 4.0 * f64::EPSILON * exact.abs().max(10.0)
                };
                prop_assert!(holds(x.times(y), s * t));
                prop_assert!(holds(x.plus(y), s + t));
                let quotient = x.over(y);
                prop_assert!(!quotient.error.is_finite() || holds(quotient, s / t) );
                prop_assert!(wide_b < b.abs() || !quotient.error.is_finite());
            }
        }
    }
}
