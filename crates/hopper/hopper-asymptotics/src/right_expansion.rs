//! The map on the right of a fixed point, to five orders.
//!
//! Proof: docs/theory.md, Theorem 35 and Theorem 67.

use crate::coefficients::{Coefficients, Form};
use crate::error::Error;
use crate::expansion_value::{ExpansionValue, UNDERFLOW};
use passive_hopper::MassRatio;

/// δ′ = δ − λδ^{4/3} [1 + ℓ₅δ^{1/3} + ℓ₆δ^{2/3} + ℓ₇δ + ℓ₈δ^{4/3}] + O(δ³), δ > 0.
///
/// With a = α*, β³ = 12a²/(1+a²):
///
/// ```text
///   ℓ₅ = β/a     ℓ₆ = −β² (4a² − 25)/(40a²)     ℓ₇ = −(24a² − 43)/(12a (1+a²))
///   ℓ₈ = β [25200a⁴β³μ + 144a⁴β³ − 29400a²β³ − 403200a² + 83825β³]/(403200a⁴)
/// ```
///
/// ```
/// use hopper_asymptotics::RightExpansion;
/// use passive_hopper::{LiftOffMap, MassRatio};
/// let series = RightExpansion::new(1, MassRatio::ONE)?.displacement(1e-3)?;
/// let exact = LiftOffMap::new(MassRatio::ONE).hop_near_fixed_point(1, 1e-3)?.next.expect("it hops again");
/// assert!((series.value - exact).abs() <= series.error && series.error < 2e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RightExpansion {
    /// λ, in the [corrected](Form::Corrected) form.
    pub lambda: f64,
    /// ℓ₅, ℓ₆, ℓ₇, ℓ₈ of the equation above.
    pub coefficients: [f64; 4],
}

/// The largest δ for which the error is proved (docs/theory.md, Theorem 67), and for which [`RightExpansion`] has
/// values.
///
/// A larger range would need a larger [`RightExpansion::REMAINDER`].
pub const RIGHT_RANGE: f64 = 0.1;

/// Bound on the rounding error of a loss, in ulps of its leading term (docs/theory.md, Lemma 72): 16.2 units 2⁻⁵³ of
/// the leading term λδ^{4/3}, 5 of the series, and 2 for the last sum and product, times the largest series, 1.15.
const LOSS_ULPS: f64 = 14.0;

impl RightExpansion {
    /// Exponent of the first neglected term of δ′.
    pub const NEGLECTED_EXPONENT: f64 = 3.0;

    /// Bound on |ℓ₉ + ℓ₁₀δ^{1/3} + …|, for all n ≥ 1, all M and 0 ≤ δ ≤ [`RIGHT_RANGE`] (docs/theory.md, Theorem
    /// 67). The proof gives 0.445; the rest of 0.5 covers the rounding of the bound.
    pub const REMAINDER: f64 = 0.5;

    /// The expansion about α*_n.
    ///
    /// # Errors
    /// [`Error::Index`] for n = 0.
    pub fn new(n: u64, mass_ratio: MassRatio) -> Result<Self, Error> {
        let local = Coefficients::new(n, mass_ratio, Form::Corrected)?;
        let (a, b, mu) = (local.alpha_star, local.beta, mass_ratio.mu());
        // The equations above, divided by powers of a² so that no number grows with n.
        let square = a * a;
        let cube = b * b * b;
        let l5 = b / a;
        let l6 = -b * b * (4.0 - 25.0 / square) / 40.0;
        let l7 = -(24.0 - 43.0 / square) / (12.0 * a * (1.0 + 1.0 / square));
        let bracket = cube * (25_200.0 * mu + 144.0) - (29_400.0 * cube + 403_200.0) / square
            + 83_825.0 * cube / (square * square);
        let l8 = b * bracket / 403_200.0;
        Ok(RightExpansion { lambda: local.lambda, coefficients: [l5, l6, l7, l8] })
    }

    /// δ′ for 0 ≤ δ ≤ [`RIGHT_RANGE`].
    ///
    /// # Errors
    /// [`Error::OutsideRange`] elsewhere.
    pub fn displacement(&self, delta: f64) -> Result<ExpansionValue, Error> {
        let loss = self.loss(delta)?;
        // Half an ulp of δ′ for the rounding of the difference; the other half covers the rounding of the bound.
        let error = loss.error + f64::EPSILON * (delta - loss.value).abs();
        Ok(ExpansionValue { value: delta - loss.value, error, ..loss })
    }

    /// The loss δ − δ′ for 0 ≤ δ ≤ [`RIGHT_RANGE`], without the cancellation of a difference.
    ///
    /// # Errors
    /// [`Error::OutsideRange`] elsewhere.
    pub fn loss(&self, delta: f64) -> Result<ExpansionValue, Error> {
        if !(0.0..=RIGHT_RANGE).contains(&delta) {
            return Err(Error::OutsideRange { value: delta, left: 0.0, right: RIGHT_RANGE });
        }
        let root = pxfm::f_cbrt(delta);
        let leading = self.lambda * delta * root;
        // Horner: ((ℓ₈ v + ℓ₇) v + …) v with v = δ^{1/3}.
        let series = self.coefficients.iter().rev().fold(0.0, |sum, l| (sum + l) * root);
        let rounding = LOSS_ULPS * f64::EPSILON * leading;
        let error = Self::REMAINDER * self.lambda * delta * delta * delta + rounding + UNDERFLOW;
        let neglected_exponent = Self::NEGLECTED_EXPONENT;
        Ok(ExpansionValue { value: leading * (1.0 + series), error, neglected_exponent })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At δ·8^{−k} the loss is 16^{−k} of that at δ, to 10⁻²⁰. So its exact value is known where it is subnormal.
    #[test]
    fn the_bound_holds_where_the_loss_is_subnormal() {
        let series = RightExpansion::new(1, MassRatio::ONE).unwrap();
        let spacing = f64::from_bits(1);
        for (k, delta) in [(250, 3e-20), (252, 1e-18), (255, 2e-17), (258, 1e-18), (260, 5e-18)] {
            let large = series.loss(delta).unwrap().value;
            let small = series.loss(delta * 2f64.powi(-3 * k)).unwrap();
            assert!(small.value < f64::MIN_POSITIVE && small.error > 0.0, "{small:?}");
            // Both in spacings of the subnormal numbers, where the exact loss has all its digits.
            let exact = large * 2f64.powi(1074 - 4 * k);
            let off = (small.value / spacing - exact).abs();
            assert!(off <= small.error / spacing, "{k} {delta:e}: {exact} {small:?}");
            assert!(off > 0.0, "{k} {delta:e}");
        }
    }

    /// With a large λ the loss is far larger than δ, and the rounding of δ′ is that of the loss.
    #[test]
    fn the_bound_of_the_displacement_counts_the_rounding_of_large_losses() {
        let series = RightExpansion::new(1 << 40, MassRatio::ONE).unwrap();
        let found = series.displacement(0.1).unwrap();
        assert!(found.value.abs() > 1e9 && found.error > f64::EPSILON * found.value.abs());
    }
}
