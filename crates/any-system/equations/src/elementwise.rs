//! Numbers side by side: a step of Taylor's method is written once, for one state and for some states at once.

use crate::algebra::Algebra;
use std::fmt::Debug;

/// A number, or one for each of some states. A condition is 1 where it holds, and 0 elsewhere.
pub(crate) trait Elementwise: Algebra + Copy + Debug {
    /// The same number for each state.
    fn number(value: f64) -> Self;
    /// A function of each number.
    fn each(self, f: impl Fn(f64) -> f64) -> Self;
    /// A function of each two numbers.
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self;
    /// The first where this condition holds, the second elsewhere.
    fn select(self, first: Self, second: Self) -> Self;
    /// True if a condition holds somewhere.
    fn any(self) -> bool;

    /// The sizes.
    #[inline(always)]
    fn size(self) -> Self {
        self.each(f64::abs)
    }

    /// The larger of each two; the second where one is NaN.
    #[inline(always)]
    fn larger(self, other: Self) -> Self {
        self.with(other, |x, y| if x > y { x } else { y })
    }

    /// The smaller of each two; the second where one is NaN.
    #[inline(always)]
    fn smaller(self, other: Self) -> Self {
        self.with(other, |x, y| if x < y { x } else { y })
    }

    /// Where x > y.
    #[inline(always)]
    fn exceeds(self, other: Self) -> Self {
        self.with(other, |x, y| f64::from(x > y))
    }
}

impl Elementwise for f64 {
    #[inline(always)]
    fn number(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        f(self)
    }

    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        f(self, other)
    }

    #[inline(always)]
    fn select(self, first: Self, second: Self) -> Self {
        if self > 0.0 { first } else { second }
    }

    #[inline(always)]
    fn any(self) -> bool {
        self > 0.0
    }
}
