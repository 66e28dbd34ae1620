//! Numbers as unevaluated sums of two `f64`: 106 bits. The constants that decide on which side of a branch a speed lies
//! have this form. It is also the first arithmetic after `f64` if a decision is inconclusive.

use crate::precision::real::{Extended, Real, extended_sine_remainders};
use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};
use std::sync::OnceLock;

/// A number `high + low` with |`low`| ≤ ½ ulp(`high`): about 106 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DoubleDouble {
    /// The nearest `f64`.
    pub(crate) high: f64,
    /// The number minus `high`.
    pub(crate) low: f64,
}

/// π to 161 bits, in three parts.
const PI_PARTS: [f64; 3] =
    [std::f64::consts::PI, 1.224_646_799_147_353_2e-16, -2.994_769_809_718_339_7e-33];

impl DoubleDouble {
    pub(crate) const ZERO: DoubleDouble = DoubleDouble { high: 0.0, low: 0.0 };
    pub(crate) const ONE: DoubleDouble = DoubleDouble { high: 1.0, low: 0.0 };

    /// `high + low`, renormalised, for |`high`| ≥ |`low`|.
    fn ordered_sum(high: f64, low: f64) -> Self {
        let sum = high + low;
        DoubleDouble { high: sum, low: low - (sum - high) }
    }

    /// The exact sum of two `f64`.
    pub(crate) fn exact_sum(a: f64, b: f64) -> Self {
        let sum = a + b;
        let b_rounded = sum - a;
        let low = (a - (sum - b_rounded)) + (b - b_rounded);
        DoubleDouble { high: sum, low }
    }

    /// The exact product of two `f64`, by Dekker's splitting (no fused multiply-add needed).
    ///
    /// Exact if no factor exceeds 2⁹⁹⁵ and the error term of the product does not underflow.
    pub(crate) fn exact_product(a: f64, b: f64) -> Self {
        let (a_high, a_low) = split(a);
        let (b_high, b_low) = split(b);
        let high = a * b;
        let low = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
        DoubleDouble { high, low }
    }

    /// n π, with a relative error below 2⁻¹⁰⁵.
    pub(crate) fn multiple_of_pi(n: f64) -> Self {
        let [a, b, c] = PI_PARTS;
        Self::exact_product(a, n) + Self::exact_product(b, n) + c * n
    }

    /// self².
    pub(crate) fn squared(self) -> Self {
        self * self
    }

    /// √self; 0 for a number that is not positive.
    pub(crate) fn sqrt(self) -> Self {
        if !(self.high > 0.0) {
            return Self::ZERO;
        }
        // One Newton step from the f64 root: r + (x − r²)/(2r).
        let root = self.high.sqrt();
        let rest = self - Self::exact_product(root, root);
        Self::ordered_sum(root, rest.high / (2.0 * root))
    }

    /// sin and cos, with an absolute error below 40 · 2⁻¹⁰⁶ for |self| ≤ 2⁴³ (docs/theory.md, Lemma 57); near zero the
    /// relative error of sin is as small.
    pub(crate) fn sin_cos(self) -> (Self, Self) {
        let multiple = (self.high / std::f64::consts::PI).round();
        // π has three parts. The largest product is subtracted first: that difference cancels without error.
        let [a, b, c] = PI_PARTS.map(|part| Self::exact_product(part, multiple));
        let rest = ((self - a) - b) - c;
        let square = rest.squared();
        let (mut sin, mut cos) = (Self::ZERO, Self::ZERO);
        for k in (0..TERMS).rev() {
            let inverse = inverse_factorials();
            sin = inverse[2 * k + 1] - sin * square;
            cos = inverse[2 * k] - cos * square;
        }
        let sign = if multiple % 2.0 == 0.0 { 1.0 } else { -1.0 };
        (sin * rest * sign, cos * sign)
    }

    /// Compares `value` with this number: `Less` if `value` is below it.
    pub(crate) fn compare(self, value: f64) -> Ordering {
        value.total_cmp(&self.high).then(0f64.total_cmp(&self.low))
    }

    /// `value` minus this number, rounded once.
    pub(crate) fn offset_of(self, value: f64) -> f64 {
        let difference = Self::exact_sum(value, -self.high);
        difference.high + (difference.low - self.low)
    }
}

/// Terms of the series of sin and cos on |x| ≤ π/2. The first term dropped is (π/2)³⁴/34!, below 2⁻¹⁰⁵.
const TERMS: usize = 17;

/// 1/k! for k < 40; the series need k < 2 [`TERMS`] = 34.
fn inverse_factorials() -> &'static [DoubleDouble; 40] {
    static TABLE: OnceLock<[DoubleDouble; 40]> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table = [DoubleDouble::ONE; 40];
        for k in 1..40 {
            table[k] = table[k - 1] / DoubleDouble::from(k as f64);
        }
        table
    })
}

impl From<f64> for DoubleDouble {
    fn from(high: f64) -> Self {
        DoubleDouble { high, low: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let high = Self::exact_sum(self.high, other.high);
        let low = Self::exact_sum(self.low, other.low);
        let partial = Self::ordered_sum(high.high, high.low + low.high);
        Self::ordered_sum(partial.high, partial.low + low.low)
    }
}

impl Add<f64> for DoubleDouble {
    type Output = Self;
    fn add(self, other: f64) -> Self {
        self + Self::from(other)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    fn neg(self) -> Self {
        DoubleDouble { high: -self.high, low: -self.low }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = Self::exact_product(self.high, other.high);
        let rest = self.high * other.low + self.low * other.high;
        Self::ordered_sum(product.high, product.low + rest)
    }
}

impl Mul<f64> for DoubleDouble {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        let product = Self::exact_product(self.high, factor);
        Self::ordered_sum(product.high, product.low + self.low * factor)
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    fn div(self, divisor: Self) -> Self {
        // Long division with three digits of 53 bits each: two digits alone would lose some of the 106 bits.
        let first = self.high / divisor.high;
        let rest = self - divisor * first;
        let second = rest.high / divisor.high;
        let rest = rest - divisor * second;
        let third = rest.high / divisor.high;
        Self::ordered_sum(first, second) + third
    }
}

/// a = high + low, each with at most 26 bits, so that their products are exact (Dekker).
fn split(a: f64) -> (f64, f64) {
    /// 2²⁷ + 1: half of the 53 bits go to each part. It overflows for |a| > 2⁹⁹⁶.
    const SPLITTER: f64 = 134_217_729.0;
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

impl Real for DoubleDouble {
    fn nearest(self) -> f64 {
        self.high
    }

    fn sin_cos(self) -> (Self, Self) {
        DoubleDouble::sin_cos(self)
    }

    fn sine_remainders(self, sin: Self, cos: Self) -> (Self, Self) {
        extended_sine_remainders(self, sin, cos)
    }

    /// Unchanged: no quotient overflows for the lift-off speeds that reach this arithmetic.
    fn at_most_largest(self) -> Self {
        self
    }
}

impl Extended for DoubleDouble {
    /// 2⁻¹⁰⁰ = 64u², u = 2⁻⁵³. An operation errs by at most 8u², a sine by 40u² (docs/theory.md, Lemmas 55 and 57). A
    /// smaller value would not cover the sines; a larger one sends more hops to 256 bits.
    const EPSILON: f64 = 7.888_609_052_210_118e-31;
    /// A flight takes some tens of microseconds.
    const SUDDEN_BUDGET: usize = 100_000;
    /// A number of 100 right bits is already as good as [`EPSILON`](Self::EPSILON).
    const STEPS_FROM_100_BITS: u32 = 0;

    fn over(self, divisor: u32) -> Self {
        self / DoubleDouble::from(f64::from(divisor))
    }

    fn sqrt(self) -> Self {
        DoubleDouble::sqrt(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::long::Long;
    use basin_of_attraction::SplitMix64;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn sums_and_products_are_exact(a in -1e6..1e6f64, b in -1e6..1e6f64) {
            let product = DoubleDouble::exact_product(a, b);
            prop_assert_eq!(product.high, a * b);
            prop_assert_eq!(product.low, a.mul_add(b, -product.high));
            let sum = DoubleDouble::exact_sum(a, b);
            prop_assert_eq!(sum.high, a + b);
        }

        #[test]
        fn reciprocals_multiply_to_one(a in 0.1..1e6f64, b in -1e-12..1e-12f64) {
            let x = DoubleDouble::exact_sum(a, b);
            let one = x * (DoubleDouble::ONE / x);
            prop_assert!(((one.high - 1.0) + one.low).abs() < 1e-30);
        }
    }

    proptest! {
        #[test]
        fn sines_are_on_the_circle_and_near_f64(x in -1e4..1e4f64, low in -1e-17..1e-17f64) {
            let (sin, cos) = (DoubleDouble::from(x) + low).sin_cos();
            let one = sin.squared() + cos.squared();
            prop_assert!(((one.high - 1.0) + one.low).abs() < 1e-30);
            prop_assert!((sin.high - pxfm::f_sin(x)).abs() < 2e-16);
            prop_assert!((cos.high - pxfm::f_cos(x)).abs() < 2e-16);
        }

        #[test]
        fn roots_square_back(x in 1e-6..1e6f64, low in -1e-17..1e-17f64) {
            let x = DoubleDouble::from(x) + low;
            let back = x.sqrt().squared() - x;
            prop_assert!(back.high.abs() < 1e-30 * x.high);
        }
    }

    #[test]
    fn comparison_sees_the_low_part() {
        let pi = DoubleDouble::multiple_of_pi(1.0);
        assert_eq!(pi.compare(std::f64::consts::PI), Ordering::Less);
        assert_eq!(pi.compare(std::f64::consts::PI.next_up()), Ordering::Greater);
    }

    /// |found − exact|/|exact| in units of u² = 2⁻¹⁰⁶.
    fn apart(found: DoubleDouble, exact: Long<4>) -> f64 {
        ((Long::<4>::from(found) - exact) / exact).nearest().abs() * 2f64.powi(106)
    }

    /// docs/theory.md, Lemmas 55 and 57: at most 4, 8, 8 and 5 units, and 40 for sines. The errors of 20 000 random
    /// numbers come to a third of these bounds at least, so that a bound is not far too wide.
    #[test]
    fn operations_err_by_less_than_their_bounds() {
        let generator = SplitMix64::from_state(13);
        let number = |k: u64| {
            let high = generator.uniform(2 * k) * 2f64.powi((k % 7) as i32 * 4 - 12);
            DoubleDouble::exact_sum(
                high,
                (generator.uniform(2 * k + 1) - 0.5) * high * 2f64.powi(-53),
            )
        };
        let mut largest = [0f64; 5];
        for k in 1..=20_000 {
            let (a, b) = (number(2 * k), number(2 * k + 1));
            let (long_a, long_b) = (Long::<4>::from(a), Long::<4>::from(b));
            let angle = a * (1.0 + (k % 50) as f64);
            let (sin, cos) = angle.sin_cos();
            let (long_sin, long_cos) = Long::<4>::from(angle).sin_cos();
            let absolute = |found: DoubleDouble, exact: Long<4>| {
                (Long::<4>::from(found) - exact).nearest().abs() * 2f64.powi(106)
            };
            let errors = [
                apart(a - b, long_a - long_b),
                apart(a * b, long_a * long_b),
                apart(a / b, long_a / long_b),
                apart(a.sqrt(), long_a.sqrt()),
                absolute(sin, long_sin).max(absolute(cos, long_cos)),
            ];
            for (most, error) in largest.iter_mut().zip(errors) {
                *most = most.max(error);
            }
        }
        for (most, bound) in largest.into_iter().zip([4.0, 8.0, 8.0, 5.0, 40.0]) {
            assert!(most <= bound, "{largest:?}");
        }
        assert!(largest[..4].iter().all(|&most| most > 1.0), "{largest:?}");
    }
}
