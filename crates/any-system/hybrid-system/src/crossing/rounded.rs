//! Numbers with a bound on their rounding error.

/// The smallest positive double. The rounding error of a product that underflows is at most half of it.
const SMALLEST: f64 = f64::from_bits(1);

/// A number and a bound on its distance from the exact one.
///
/// Each operation adds ε times its result, twice its own rounding error. The other half covers the roundings of the
/// bound itself.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Rounded {
    /// The computed number.
    pub(crate) value: f64,
    /// Bound on its error.
    pub(crate) error: f64,
}

impl Rounded {
    /// A number without error.
    pub(crate) const fn exact(value: f64) -> Self {
        Rounded { value, error: 0.0 }
    }

    /// True for an exact zero.
    fn vanishes(self) -> bool {
        self.value == 0.0 && self.error == 0.0
    }

    /// The largest size of the exact number.
    pub(crate) fn size(self) -> f64 {
        self.value.abs() + self.error
    }

    /// This number times a power of two, which is exact unless it underflows.
    pub(crate) fn shifted(self, power: f64) -> Self {
        let value = self.value * power;
        let error = self.error * power;
        let underflow = value.abs() < f64::MIN_POSITIVE && self.value != 0.0
            || error < f64::MIN_POSITIVE && self.error > 0.0;
        Rounded { value, error: if underflow { error + SMALLEST } else { error } }
    }
}

impl std::ops::Add for Rounded {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        if other.vanishes() {
            return self;
        }
        if self.vanishes() {
            return other;
        }
        let value = self.value + other.value;
        Rounded { value, error: self.error + other.error + f64::EPSILON * value.abs() }
    }
}

impl std::ops::Neg for Rounded {
    type Output = Self;
    fn neg(self) -> Self {
        Rounded { value: -self.value, error: self.error }
    }
}

impl std::ops::Mul for Rounded {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.vanishes() || other.vanishes() {
            return Rounded::default();
        }
        let value = self.value * other.value;
        let inherited = self.error * other.size() + self.value.abs() * other.error;
        Rounded { value, error: inherited + f64::EPSILON * value.abs() + SMALLEST }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Integers divided by 2³⁰ have exact sums and products in 128 bits.
        #[test]
        fn errors_are_bounds(a in -1i64 << 40..1i64 << 40, b in -1i64 << 40..1i64 << 40, c in -1i64 << 40..1i64 << 40) {
            let number = |k: i64| Rounded::exact(k as f64);
            let computed = number(a) * number(b) + number(c);
            let exact = i128::from(a) * i128::from(b) + i128::from(c);
            let difference = (exact - computed.value as i128).abs();
            prop_assert!(difference as f64 <= computed.error);
            // The bound is not far above the roundings: two operations, each at most ε of the largest number.
            prop_assert!(computed.error <= 4.0 * f64::EPSILON * ((a as f64 * b as f64).abs() + (c as f64).abs()) + 1e-300);
        }
    }

    #[test]
    fn zero_and_powers_of_two_are_exact() {
        let half = Rounded::exact(0.5);
        assert_eq!(Rounded::exact(3.0).shifted(0.25), Rounded::exact(0.75));
        assert_eq!(Rounded::default() * half, Rounded::default());
        assert_eq!(Rounded::default() + half, half);
        assert!(Rounded::exact(1e-300).shifted(f64::MIN_POSITIVE).error > 0.0);
    }
}
