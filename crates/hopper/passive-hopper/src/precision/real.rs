//! The operations that the formulas of a flight need from a number type.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Real numbers to a fixed relative precision: `f64`, or an [`Extended`] arithmetic.
///
/// The formulas of a flight (`HalfTime`, `NearFixedPoint` in the room `landing`) are written once, for all of these
/// types. For `f64` the methods are single calls, which compile to the same code as formulas for `f64` alone.
pub(crate) trait Real:
    Copy
    + Debug
    + From<f64>
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// The nearest `f64`.
    fn nearest(self) -> f64;

    /// sin and cos. For an [`Extended`] number the error is EPSILON (1 + |self|), and EPSILON |self| near zero. For an
    /// `f64` the results are correctly rounded.
    fn sin_cos(self) -> (Self, Self);

    /// self − sin self and self²/2 − 1 + cos self, without cancellation near zero; given sin self and cos self.
    fn sine_remainders(self, sin: Self, cos: Self) -> (Self, Self);

    /// The number itself, or the largest finite number if a quotient overflowed.
    fn at_most_largest(self) -> Self;

    /// self².
    fn squared(self) -> Self {
        self * self
    }
}

/// Numbers longer than `f64`.
pub(crate) trait Extended: Real {
    /// Unit of the error bounds in this arithmetic: at least eight times the relative error of an operation, and at
    /// least the error of a sine for an argument up to 1 (docs/theory.md, Lemmas 55 to 57).
    const EPSILON: f64;
    /// Largest number of sudden lift-offs for which a hop is computed in this arithmetic. The value is chosen so that
    /// the computation takes at most some seconds. For a longer chain the result of the shorter arithmetic is used, or
    /// the hop is undecided.
    const SUDDEN_BUDGET: usize;
    /// Newton steps from a number with 100 right bits to the full precision.
    const STEPS_FROM_100_BITS: u32;

    /// self / `divisor`, for a small integer.
    fn over(self, divisor: u32) -> Self;

    /// √self; 0 for a number that is not positive.
    fn sqrt(self) -> Self;
}

impl Real for f64 {
    fn nearest(self) -> f64 {
        self
    }

    #[inline]
    fn sin_cos(self) -> (f64, f64) {
        pxfm::f_sincos(self)
    }

    /// From pxfm's sin x − x, which is right to an ulp everywhere, and t²/2 − 1 + cos t = 2 (η − sin η)(η + sin η), η =
    /// t/2. The sine and cosine of t itself are not needed.
    #[inline]
    fn sine_remainders(self, _: f64, _: f64) -> (f64, f64) {
        let half = 0.5 * self;
        let bend = -2.0 * pxfm::f_sinmx(half) * (half + pxfm::f_sin(half));
        (-pxfm::f_sinmx(self), bend)
    }

    #[inline]
    fn at_most_largest(self) -> f64 {
        self.min(f64::MAX)
    }
}

/// [`Real::sine_remainders`] of an extended number.
pub(crate) fn extended_sine_remainders<R: Extended>(t: R, sin: R, cos: R) -> (R, R) {
    // From |t| = 1 on the differences are at least 0.04 (1/2 − 1 + cos 1) and 0.16 (1 − sin 1). The errors of sine and
    // cosine, up to EPSILON, are then up to 25 EPSILON of the difference.
    if t.nearest().abs() < 1.0 {
        remainder_series(t)
    } else {
        (t - sin, t.squared() * 0.5 + cos + -1.0)
    }
}

/// t − sin t = t³/3! − t⁵/5! + … and t²/2 − 1 + cos t = t⁴/4! − t⁶/6! + …, for |t| < 1.
fn remainder_series<R: Extended>(t: R) -> (R, R) {
    let minus_square = -t.squared();
    let (mut odd, mut even) = (t * minus_square, minus_square.squared());
    (odd, even) = (-odd.over(6), even.over(24));
    let (mut rest, mut bend) = (odd, even);
    for k in 2..=MOST_TERMS {
        odd = (odd * minus_square).over(2 * k * (2 * k + 1));
        even = (even * minus_square).over((2 * k + 1) * (2 * k + 2));
        (rest, bend) = (rest + odd, bend + even);
        if !(odd.nearest().abs() > R::EPSILON * rest.nearest().abs()) {
            break;
        }
    }
    (rest, bend)
}

/// Guard on the number of terms, never reached: 1/(2k+1)! is below 2⁻¹⁰²⁴, the last bit of the longest
/// arithmetic, for k = 90.
const MOST_TERMS: u32 = 90;
