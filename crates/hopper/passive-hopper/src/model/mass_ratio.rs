//! The only parameter of the dynamics.

use crate::error::Error;

/// The mass ratio M = m₂/m₁, lower mass over upper mass.
///
/// Valid from 2⁻¹⁰²² to 2¹⁰²², so that M and 1/M are both ordinary numbers.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
pub struct MassRatio(f64);

impl MassRatio {
    /// M = 1, at which the traps of the fixed points are smallest.
    pub const ONE: MassRatio = MassRatio(1.0);

    /// A mass ratio with the value `value`.
    ///
    /// # Errors
    /// [`Error::MassRatio`] unless `value` and 1/`value` are positive, finite and not subnormal.
    pub fn new(value: f64) -> Result<Self, Error> {
        if (f64::MIN_POSITIVE..=1.0 / f64::MIN_POSITIVE).contains(&value) {
            Ok(MassRatio(value))
        } else {
            Err(Error::MassRatio { value })
        }
    }

    /// The value M.
    pub fn value(self) -> f64 {
        self.0
    }

    /// μ = M/(1+M)² ∈ (0, ¼]. As long as no landing is sudden, the map depends on M only through μ.
    pub fn mu(self) -> f64 {
        self.kappa() / (1.0 + self.0)
    }

    /// κ = M/(1+M) = m₂/(m₁ + m₂).
    pub fn kappa(self) -> f64 {
        self.0 / (1.0 + self.0)
    }

    /// ν = √κ, the angular frequency of the contact phase in units of the angular frequency of the flight.
    pub fn contact_frequency(self) -> f64 {
        self.kappa().sqrt()
    }

    /// 1/M: the hopper with its masses exchanged.
    pub fn inverted(self) -> Self {
        MassRatio(1.0 / self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_name_the_invalid_value() {
        for value in [0.0, -1.0, f64::INFINITY, f64::NAN, 1e-310, 1e308, -0.0] {
            let error = MassRatio::new(value).unwrap_err();
            assert!(error.to_string().contains(&format!("{value:?}")), "{error}");
        }
    }

    #[test]
    fn extremes_have_finite_inverses_and_mu() {
        for value in [f64::MIN_POSITIVE, 1.0 / f64::MIN_POSITIVE, 1e-300, 1e300] {
            let ratio = MassRatio::new(value).unwrap();
            assert!(MassRatio::new(ratio.inverted().value()).is_ok());
            assert!(ratio.mu() > 0.0 && ratio.mu() <= 0.25);
        }
        assert_eq!(MassRatio::ONE.mu(), 0.25);
    }
}
