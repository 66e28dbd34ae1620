//! Numbers as unevaluated sums of two `f64`, for the constants that decide which side of a branch
//! a speed lies on.

use std::cmp::Ordering;

/// A number `high + low` with |`low`| ≤ ½ ulp(`high`): about 106 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoubleDouble {
    /// The nearest `f64`.
    pub high: f64,
    /// What is left.
    pub low: f64,
}

/// π to 106 bits.
pub(crate) const PI: DoubleDouble =
    DoubleDouble { high: std::f64::consts::PI, low: 1.224_646_799_147_353_2e-16 };

impl DoubleDouble {
    /// `high + low`, renormalised.
    fn sum(high: f64, low: f64) -> Self {
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
    /// Exact while neither the factors exceed 2⁹⁹⁵ nor the product's error term underflows.
    pub(crate) fn exact_product(a: f64, b: f64) -> Self {
        let (a_high, a_low) = split(a);
        let (b_high, b_low) = split(b);
        let high = a * b;
        let low = ((a_high * b_high - high) + a_high * b_low + a_low * b_high) + a_low * b_low;
        DoubleDouble { high, low }
    }

    /// Sum, with a relative error near 2⁻¹⁰⁴ when there is no cancellation.
    pub(crate) fn plus(self, other: Self) -> Self {
        let high = Self::exact_sum(self.high, other.high);
        let low = Self::exact_sum(self.low, other.low);
        let partial = Self::sum(high.high, high.low + low.high);
        Self::sum(partial.high, partial.low + low.low)
    }

    /// Product with an `f64`.
    pub(crate) fn times(self, factor: f64) -> Self {
        let product = Self::exact_product(self.high, factor);
        Self::sum(product.high, product.low + self.low * factor)
    }

    /// Product.
    pub(crate) fn times_wide(self, other: Self) -> Self {
        let product = Self::exact_product(self.high, other.high);
        Self::sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }

    /// 1/self.
    pub(crate) fn reciprocal(self) -> Self {
        let guess = 1.0 / self.high;
        // One Newton step: g (2 − x g) = g + g (1 − x g).
        let rest = DoubleDouble { high: 1.0, low: 0.0 }.plus(self.times(-guess));
        Self::sum(guess, guess * rest.high).plus(DoubleDouble { high: guess * rest.low, low: 0.0 })
    }

    /// Compares `value` with this number: `Less` if `value` is below it.
    pub fn compare(self, value: f64) -> Ordering {
        value.total_cmp(&self.high).then(0f64.total_cmp(&self.low))
    }

    /// `value` minus this number, rounded once.
    pub fn offset_of(self, value: f64) -> f64 {
        let difference = Self::exact_sum(value, -self.high);
        difference.high + (difference.low - self.low)
    }
}

fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

#[cfg(test)]
mod tests {
    use super::*;
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
            let one = x.times_wide(x.reciprocal());
            prop_assert!(((one.high - 1.0) + one.low).abs() < 1e-30);
        }
    }

    #[test]
    fn comparison_sees_the_low_part() {
        assert_eq!(PI.compare(std::f64::consts::PI), Ordering::Less);
        assert_eq!(PI.compare(std::f64::consts::PI.next_up()), Ordering::Greater);
    }
}
