//! The map on the left of a fixed point, to three orders.
//!
//! Proof: docs/theory.md, Theorem 36 and Theorem 68.

use crate::coefficients::{Coefficients, Form};
use crate::error::Error;
use crate::expansion_value::{ExpansionValue, UNDERFLOW};
use crate::local_map::LEFT_FACTOR;
use passive_hopper::MassRatio;

/// δ′ = δ − 10λ|δ|^{4/3} [1 + c₁|δ|^{1/3} + c₂|δ|^{2/3}] + O(|δ|^{7/3}), δ < 0.
///
/// The first landing has stretch 1 + x, x ≈ α*β|δ|^{1/3}, and speed V ≈ −α*. The spring pulls the lower mass off
/// again, for a flight of τ = 3x/α*. That flight ends at stretch 1 − 2x, with three times the first closing speed.
/// The hop therefore loses 1 + 3² = 10 times as much as on the right. To the next orders, with a = α* and
/// κ = M/(1+M):
///
/// ```text
///   c₁ = −β/a        c₂ = −β² (34/25 + 31/(80a²) − 9κ/10)
/// ```
///
/// c₁ is −ℓ₅ of the right side. For the derivation write both landings as series in t = τ − 2a: the first from the
/// exact local forms of `passive_hopper::LocalFlight`, the second from (h − V) D + S u = x S² with
/// h₂ = 3x/(2a) + …. The sum of the squared closing speeds is then
///
/// ```text
///   Γ₁² + Γ₂² = (5/2) a² t⁴ [1 + (9κ/10 − 107/75 − 283/(240a²)) t² + O(t³)]
///   t = −s [1 − s/(4a) + (4a² + 25) s²/(240a²) − …],   s = β|δ|^{1/3}
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeftExpansion {
    /// λ, in the [corrected](Form::Corrected) form. The leading coefficient is 10λ.
    pub lambda: f64,
    /// c₁, c₂ of the equation above.
    pub coefficients: [f64; 2],
}

/// The largest |δ| for which the error is proved (docs/theory.md, Theorem 68), and for which [`LeftExpansion`] has
/// values where λ is small.
///
/// A larger range would need a larger [`LeftExpansion::REMAINDER`].
pub const LEFT_RANGE: f64 = 1e-3;

/// Bound on the rounding error of a loss, in ulps of its leading term (docs/theory.md, Lemma 72): 17.2 units 2⁻⁵³ of
/// the leading term 10λ|δ|^{4/3}, 1.5 of the series, and 2 for the last sum and product.
const LOSS_ULPS: f64 = 12.0;

impl LeftExpansion {
    /// Exponent of the first neglected term of δ′.
    pub const NEGLECTED_EXPONENT: f64 = 7.0 / 3.0;

    /// Bound on |c₃ + c₄|δ|^{1/3} + …|, for all n ≥ 1, all M and |δ| ≤ [`LEFT_RANGE`] (docs/theory.md, Theorem 68). The
    /// proof gives 8.79; the rest of 9 covers the rounding of the bound.
    pub const REMAINDER: f64 = 9.0;

    /// The expansion about α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let local = Coefficients::new(n, mass_ratio, Form::Corrected)?;
        let (a, b, kappa) = (local.alpha_star, local.beta, mass_ratio.kappa());
        let c1 = -b / a;
        let c2 = -b * b * (34.0 / 25.0 + 31.0 / (80.0 * a * a) - 0.9 * kappa);
        Ok(LeftExpansion { lambda: local.lambda, coefficients: [c1, c2] })
    }

    /// The largest |δ| with a value: [`LEFT_RANGE`]/(1 + λ³).
    ///
    /// Up to it the leading loss 10λ|δ|^{4/3} is at most |δ|. The bound on the error holds further, up to
    /// [`LEFT_RANGE`], but there a hop with a large λ more than doubles its distance from α*_n, and the local map
    /// says little about an orbit.
    pub fn range(&self) -> f64 {
        LEFT_RANGE / (1.0 + self.lambda * self.lambda * self.lambda)
    }

    /// δ′ for −[`range`](Self::range) ≤ δ ≤ 0.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] elsewhere.
    pub fn displacement(&self, delta: f64) -> Result<ExpansionValue, Error> {
        let loss = self.loss(delta)?;
        // Half an ulp of δ′ for the rounding of the difference; the other half covers the rounding of the bound.
        let error = loss.error + f64::EPSILON * (delta - loss.value).abs();
        Ok(ExpansionValue { value: delta - loss.value, error, ..loss })
    }

    /// The loss δ − δ′ for −[`range`](Self::range) ≤ δ ≤ 0, without the cancellation of a difference.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] elsewhere.
    pub fn loss(&self, delta: f64) -> Result<ExpansionValue, Error> {
        let range = self.range();
        if !(-range..=0.0).contains(&delta) {
            return Err(Error::OutsideRange { value: delta, left: -range, right: 0.0 });
        }
        let size = delta.abs();
        let root = pxfm::f_cbrt(size);
        let leading = LEFT_FACTOR * self.lambda * size * root;
        let [c1, c2] = self.coefficients;
        let series = (c1 + c2 * root) * root;
        let rounding = LOSS_ULPS * f64::EPSILON * leading;
        let neglected = Self::REMAINDER * leading * size;
        Ok(ExpansionValue {
            value: leading * (1.0 + series),
            error: neglected + rounding + UNDERFLOW,
            neglected_exponent: Self::NEGLECTED_EXPONENT,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bound_holds_where_the_loss_is_subnormal() {
        let series = LeftExpansion::new(1, MassRatio::ONE).unwrap();
        let spacing = f64::from_bits(1);
        for (k, delta) in [(250, 3e-20), (252, 1e-18), (255, 2e-17), (260, 5e-18)] {
            let large = series.loss(-delta).unwrap().value;
            let small = series.loss(-delta * 2f64.powi(-3 * k)).unwrap();
            let exact = large * 2f64.powi(1074 - 4 * k);
            let off = (small.value / spacing - exact).abs();
            assert!(off > 0.0 && off <= small.error / spacing, "{k} {delta:e}: {exact} {small:?}");
        }
    }

    #[test]
    fn the_bound_holds_at_large_indices_up_to_the_range() {
        let ratio = MassRatio::ONE;
        for n in [100, 10_000] {
            let series = LeftExpansion::new(n, ratio).unwrap();
            let map = passive_hopper::LiftOffMap::new(ratio);
            for part in [1.0, 0.3, 0.01] {
                let delta = -part * series.range();
                let exact = map.reference_local_hop(n, delta).unwrap().unwrap().loss.unwrap();
                let found = series.loss(delta).unwrap();
                assert!(exact.error_of(found.value) <= found.error, "{n} {delta}: {found:?}");
            }
        }
    }
}
