//! Numbers of some states side by side.

use crate::algebra::{Algebra, Arithmetic, of_number};
use crate::constant::Constant;
use crate::elementwise::Elementwise;
use crate::function::Function;
use crate::node::{Binary, Unary};
use std::array::from_fn;

/// States that are computed side by side: eight `f64` fill a register of 512 bits, or two or four smaller ones. Each
/// part of a formula is then looked up once for all of them.
pub(crate) const WIDTH: usize = 8;

/// States at which values of formulas are computed side by side, without a series: a part is looked up once for all of them, and four operations need not
/// wait for each other. Newton's method for z³ = 1 takes 0.6 of the time of eight. A step of a flow does more for each part, and gains nothing.
pub(crate) const MANY: usize = 32;

/// A number for each of some states.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(align(64))]
pub(crate) struct Lanes<const N: usize = WIDTH>(pub(crate) [f64; N]);

impl<const N: usize> Elementwise for Lanes<N> {
    #[inline(always)]
    fn number(value: f64) -> Self {
        Lanes([value; N])
    }

    #[inline(always)]
    fn each(self, f: impl Fn(f64) -> f64) -> Self {
        // Written with `from_fn`, some settings of the compiler do not inline it: the loop would then have narrow vectors.
        let mut all = self;
        all.0.iter_mut().for_each(|x| *x = f(*x));
        all
    }

    #[inline(always)]
    fn with(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let mut all = self;
        all.0.iter_mut().zip(&other.0).for_each(|(x, y)| *x = f(*x, *y));
        all
    }

    #[inline(always)]
    fn select(self, first: Self, second: Self) -> Self {
        Lanes(from_fn(|lane| if self.0[lane] > 0.0 { first.0[lane] } else { second.0[lane] }))
    }

    #[inline(always)]
    fn any(self) -> bool {
        self.0.iter().fold(false, |any, condition| any | (*condition > 0.0))
    }
}

impl<const N: usize> Arithmetic for Lanes<N> {
    #[inline(always)]
    fn one() -> Self {
        Lanes([1.0; N])
    }

    #[inline(always)]
    fn negative(x: &Self) -> Self {
        x.each(|x| -x)
    }

    #[inline(always)]
    fn sum(x: &Self, y: &Self) -> Self {
        x.with(*y, |x, y| x + y)
    }

    #[inline(always)]
    fn difference(x: &Self, y: &Self) -> Self {
        x.with(*y, |x, y| x - y)
    }

    #[inline(always)]
    fn product(x: &Self, y: &Self) -> Self {
        x.with(*y, |x, y| x * y)
    }

    #[inline(always)]
    fn quotient(x: &Self, y: &Self) -> Self {
        x.with(*y, |x, y| x / y)
    }

    #[inline(always)]
    fn square(x: &Self) -> Self {
        x.each(|x| x * x)
    }

    #[inline(always)]
    fn convolution(x: &[Self], y: &[Self]) -> Self {
        let add = |sum: Self, x: &Self, y: &Self| {
            Lanes(from_fn(|lane| sum.0[lane] + x.0[lane] * y.0[lane]))
        };
        let ((x, x_left), (y_left, y)) = (x.as_chunks::<4>(), y.as_rchunks::<4>());
        let mut sums = [Self::zero(); 4];
        for (x, y) in x.iter().zip(y.iter().rev()) {
            sums = from_fn(|k| add(sums[k], &x[k], &y[3 - k]));
        }
        let [a, b, c, d] = sums;
        let sum = Lanes(from_fn(|lane| (a.0[lane] + c.0[lane]) + (b.0[lane] + d.0[lane])));
        x_left.iter().zip(y_left.iter().rev()).fold(sum, |sum, (x, y)| add(sum, x, y))
    }

    #[inline(always)]
    fn times(x: &Self, k: f64) -> Self {
        x.each(|x| x * k)
    }

    #[inline(always)]
    fn zero() -> Self {
        Lanes([0.0; N])
    }

    #[inline(always)]
    fn is_valid(&self) -> bool {
        self.0.iter().fold(true, |all, x| all & x.is_finite())
    }
}

impl<const N: usize> Algebra for Lanes<N> {
    #[inline(always)]
    fn constant(constant: &Constant) -> Self {
        Lanes([constant.value(); N])
    }

    #[inline(always)]
    fn unary(function: Unary, x: &Self) -> Self {
        match function {
            // These are instructions of the processor for all lanes.
            Unary::Negative => Self::negative(x),
            Unary::SquareRoot => x.each(f64::sqrt),
            _ => x.each(of_number(function)),
        }
    }

    #[inline(always)]
    fn binary(function: Binary, x: &Self, y: &Self) -> Self {
        match function {
            Binary::Sum => Self::sum(x, y),
            Binary::Difference => Self::difference(x, y),
            Binary::Product => Self::product(x, y),
            Binary::Quotient => Self::quotient(x, y),
            _ => x.with(*y, |x, y| f64::binary(function, &x, &y)),
        }
    }

    #[inline(always)]
    fn call(function: &Function, x: &Self) -> Self {
        x.each(|x| function.value(x))
    }
}
