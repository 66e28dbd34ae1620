//! What a hop needs of the numbers it is computed with, beyond `f64`.

use crate::precision::double_double::DoubleDouble;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Real numbers to a fixed relative precision.
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
    /// Bound on the relative rounding error of an operation, with some bits to spare.
    const EPSILON: f64;
    /// Sudden lift-offs up to which a hop is computed in this arithmetic: some seconds' work.
    const SUDDEN_BUDGET: usize;

    /// The nearest `f64`.
    fn nearest(self) -> f64;

    /// self / `divisor`, for a small whole number.
    fn over(self, divisor: u32) -> Self;

    /// √self; 0 for a number that is not positive.
    fn sqrt(self) -> Self;

    /// sin and cos, with an error of EPSILON (1 + |self|), and of EPSILON |self| near zero.
    fn sin_cos(self) -> (Self, Self);

    /// α*_n.
    fn alpha_star(n: u64) -> Self;

    /// self².
    fn squared(self) -> Self {
        self * self
    }
}

impl Real for DoubleDouble {
    const EPSILON: f64 = 7.9e-31; // 2⁻¹⁰⁰
    const SUDDEN_BUDGET: usize = 100_000;

    fn nearest(self) -> f64 {
        self.high
    }

    fn over(self, divisor: u32) -> Self {
        self / DoubleDouble::from(f64::from(divisor))
    }

    fn sqrt(self) -> Self {
        DoubleDouble::sqrt(self)
    }

    fn sin_cos(self) -> (Self, Self) {
        DoubleDouble::sin_cos(self)
    }

    fn alpha_star(n: u64) -> Self {
        crate::model::fixed_points::exact_alpha_star(n)
    }
}
