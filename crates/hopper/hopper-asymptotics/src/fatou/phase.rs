//! The phase of a point on the slow side of a fixed point: an integer of any size and a fraction.

use crate::fatou::quotient::nearest_quotient;
use num_bigint::{BigInt, BigUint};
use std::fmt;

/// A value of the Fatou coordinate Ψ: the number of hops `whole` + `fraction`.
///
/// At |δ| = 10⁻³⁰⁰ the integer has about a hundred digits. The fraction alone decides the fate (docs/theory.md,
/// Section 16).
#[derive(Debug, Clone, PartialEq)]
pub struct Phase {
    whole: BigInt,
    fraction: f64,
    error: f64,
}

impl Phase {
    /// The phase `whole` + `fraction`, known to within `error`. A fraction outside [0, 1) changes the integer.
    ///
    /// A fraction or error that is not finite gives the fraction 0 with an infinite error.
    pub fn new(whole: impl Into<BigInt>, fraction: f64, error: f64) -> Self {
        if !(fraction.is_finite() && error >= 0.0) {
            return Phase { whole: whole.into(), fraction: 0.0, error: f64::INFINITY };
        }
        let floor = fraction.floor();
        let mut whole = whole.into() + integer(floor);
        // Exact, except that a tiny negative fraction gives 1.
        let mut rest = fraction - floor;
        if rest >= 1.0 {
            whole += 1;
            rest = 0.0;
        }
        Phase { whole, fraction: rest, error }
    }

    /// The integer below or at the phase.
    pub fn whole(&self) -> &BigInt {
        &self.whole
    }

    /// The rest, in [0, 1): the place on the circle of fates.
    pub fn fraction(&self) -> f64 {
        self.fraction
    }

    /// Bound on the distance of the exact phase from this one. If it is not far below 1, the digits of the offset
    /// do not determine the fraction.
    pub fn error(&self) -> f64 {
        self.error
    }

    /// The number of whole hops between this phase and another one, without a sign: the nearest `f64`.
    ///
    /// ```
    /// use hopper_asymptotics::{BigInt, Phase};
    /// let (near, far) = (Phase::new(3, 0.9, 0.0), Phase::new(BigInt::from(10).pow(30), 0.1, 0.0));
    /// assert_eq!(near.whole_hops_to(&far), 1e30);
    /// assert_eq!(far.whole_hops_to(&near), 1e30);
    /// ```
    pub fn whole_hops_to(&self, other: &Phase) -> f64 {
        nearest_quotient((&self.whole - &other.whole).magnitude(), &BigUint::from(1u32))
    }

    /// The phase of the point `hops` hops later on the right, or earlier on the left: the same fraction.
    pub fn plus(&self, hops: impl Into<BigInt>) -> Self {
        Phase { whole: &self.whole + hops.into(), ..self.clone() }
    }

    /// The whole phase as mantissa · 2^exponent, the mantissa in [½, 1) in size; for phases beyond the largest `f64`.
    pub(crate) fn scaled(&self) -> (f64, i64) {
        let bits = self.whole.bits();
        if bits <= 60 {
            let value = small(&self.whole) + self.fraction;
            return split(value);
        }
        let exponent = bits - 60;
        let (mantissa, power) = split(small(&(&self.whole >> exponent)));
        (mantissa, power + exponent as i64)
    }
}

/// |value| < 2⁶³ as an `f64`.
fn small(value: &BigInt) -> f64 {
    i64::try_from(value).map_or(f64::NAN, |value| value as f64)
}

/// A finite number as mantissa · 2^exponent.
pub(crate) fn split(value: f64) -> (f64, i64) {
    if value == 0.0 {
        return (0.0, 0);
    }
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i64 - 1022;
    if exponent == -1022 {
        // A subnormal number.
        let (mantissa, power) = split(value * 2f64.powi(64));
        return (mantissa, power - 64);
    }
    (f64::from_bits(bits & !(0x7ff << 52) | 1022 << 52), exponent)
}

/// The integer with this value. An `f64` that is an integer is mantissa · 2^exponent.
fn integer(value: f64) -> BigInt {
    if value.abs() < 9e18 {
        return BigInt::from(value as i64);
    }
    let (mantissa, exponent) = split(value);
    let digits = (mantissa * 9_007_199_254_740_992.0) as i64;
    BigInt::from(digits) << (exponent - 53).max(0) as u64
}

impl fmt::Display for Phase {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let fraction = format!("{:.12}", self.fraction);
        // A fraction just below one is printed as nines.
        let digits = fraction.strip_prefix("0.").unwrap_or("999999999999");
        write!(out, "{}.{digits} ± {:.1e}", self.whole, self.error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_normalised() {
        let phase = Phase::new(5, -1.25, 0.0);
        assert_eq!((phase.whole(), phase.fraction()), (&BigInt::from(3), 0.75));
        let phase = Phase::new(0, -1e-30, 0.0);
        assert_eq!((phase.whole(), phase.fraction()), (&BigInt::from(0), 0.0));
        let phase = Phase::new(0, 1e22 + 0.0, 0.0);
        assert_eq!(phase.whole().to_string(), "10000000000000000000000");
        assert!(Phase::new(0, f64::NAN, 0.0).error().is_infinite());
        assert!(Phase::new(0, 0.5, f64::NAN).error().is_infinite());
        assert_eq!(Phase::new(7, 0.25, 1e-13).to_string(), "7.250000000000 ± 1.0e-13");
    }

    #[test]
    fn large_phases_have_their_size() {
        let phase = Phase::new(BigInt::from(3) << 1000u32, 0.5, 0.0);
        assert_eq!(phase.scaled(), (0.75, 1002));
        assert_eq!(Phase::new(3, 0.0, 0.0).scaled(), (0.75, 2));
        assert_eq!(Phase::new(-3, 0.0, 0.0).scaled(), (-0.75, 2));
    }
}
