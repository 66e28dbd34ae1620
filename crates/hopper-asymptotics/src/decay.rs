//! The algebraic approach to a fixed point from the right.

use crate::{Coefficients, Error, Form};
use passive_hopper::MassRatio;

/// δ_k^{−1/3} = λk/3 + (β/α* + 2λ/3) ln k + C + o(1).
///
/// From u = δ^{−1/3}: u' = u + λ/3 + (λℓ₅/3 + 2λ²/9)/u + …, ℓ₅ = β/α*. C depends on the start; it is
/// taken from δ₀ by summing the two terms as an integral.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decay {
    /// λ/3, by which u grows in a hop.
    pub rate: f64,
    /// β/α* + 2λ/3, the coefficient of the logarithm.
    pub logarithm: f64,
}

impl Decay {
    /// The law at α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let local = Coefficients::new(n, mass_ratio, Form::Corrected)?;
        let logarithm = local.beta / local.alpha_star + 2.0 * local.lambda / 3.0;
        Ok(Decay { rate: local.lambda / 3.0, logarithm })
    }

    /// The number of hops from `start` until the offset is under `end`, about.
    ///
    /// dk/du = 1/(rate (1 + logarithm/u)), integrated: k = [u − logarithm ln u]/rate between the
    /// ends. Relative error about (β/α* + 2λ/3)² δ₀^{1/3}; measured under 2 % from δ₀ λ³ ≤ 10⁻³.
    ///
    /// ```
    /// use hopper_asymptotics::Decay;
    /// use passive_hopper::{LiftOffMap, MassRatio};
    /// let predicted = Decay::new(1, MassRatio::ONE)?.hops(1e-5, 1e-9)?;
    /// let map = LiftOffMap::new(MassRatio::ONE);
    /// let (mut delta, mut hops) = (1e-5, 0);
    /// while delta > 1e-9 {
    ///     delta = map.hop_about(1, delta)?.next.expect("in the trap");
    ///     hops += 1;
    /// }
    /// assert!((predicted / f64::from(hops) - 1.0).abs() < 0.02);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::OutsideRange`] unless 0 < `end` ≤ `start`, with `start` λ³ at most 10⁻³.
    pub fn hops(&self, start: f64, end: f64) -> Result<f64, Error> {
        let lambda = 3.0 * self.rate;
        let largest = 1e-3 / (lambda * lambda * lambda);
        if !(start > 0.0 && start <= largest) {
            return Err(Error::OutsideRange { value: start, left: 0.0, right: largest });
        }
        if !(end > 0.0 && end <= start) {
            return Err(Error::OutsideRange { value: end, left: 0.0, right: start });
        }
        let (u0, u1) = (1.0 / pxfm::f_cbrt(start), 1.0 / pxfm::f_cbrt(end));
        Ok(((u1 - u0) - self.logarithm * pxfm::f_log(u1 / u0)) / self.rate)
    }
}
