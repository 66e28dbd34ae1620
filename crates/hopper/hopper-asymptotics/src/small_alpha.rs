//! Small hops: the map about α*_0 = 0.
//!
//! Proof: docs/theory.md, Lemma 39 and Theorem 71.

use crate::error::Error;
use crate::expansion_value::{ExpansionValue, UNDERFLOW};
use passive_hopper::MassRatio;

/// The largest α for which the error is proved (docs/theory.md, Theorem 71), and for which [`small_hop_loss`] has a
/// value.
pub const SMALL_ALPHA_RANGE: f64 = 0.3;

/// Bound on |c₄ + c₆α² + …| in the factor 1 − (8/5)α² + c₄α⁴ + … of [`small_hop_loss`], for all M and 0 ≤ α ≤
/// [`SMALL_ALPHA_RANGE`] (docs/theory.md, Theorem 71). The proof gives 2.365; the rest of 2.4 covers the rounding
/// of the bound.
pub const SMALL_HOP_REMAINDER: f64 = 2.4;

/// Bound on the rounding error in ulps of the leading term (docs/theory.md, Lemma 72): 11 units 2⁻⁵³ of the leading
/// term, and 2.5 of the factor and the product.
const LOSS_ULPS: f64 = 7.0;

/// The loss α − f(α) = (32/9) μ α⁵ [1 − (8/5) α²] + O(α⁹) of a small hop.
///
/// With the flight time h and the closing speed Γ the loss is μΓ²/(α + α′), where
///
/// ```text
///   h = 2α (1 − 4α²/15 + …)      Γ = h³/3 (1 + O(h⁴))      μΓ² = (64/9) μ α⁶ (1 − (8/5) α² + …)
/// ```
///
/// Hops become smaller like α_k ~ (128 μk/9)^{−1/4} and never stop.
///
/// ```
/// use hopper_asymptotics::small_hop_loss;
/// use passive_hopper::{LiftOffMap, MassRatio};
/// let loss = small_hop_loss(MassRatio::ONE, 0.01)?;
/// let exact = LiftOffMap::new(MassRatio::ONE).hop(0.01)?.loss.expect("it hops again");
/// assert!((loss.value - exact).abs() <= loss.error && loss.error < 1e-7 * exact);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`Error::OutsideRange`] unless 0 ≤ α ≤ [`SMALL_ALPHA_RANGE`].
pub fn small_hop_loss(mass_ratio: MassRatio, alpha: f64) -> Result<ExpansionValue, Error> {
    if !(0.0..=SMALL_ALPHA_RANGE).contains(&alpha) {
        return Err(Error::OutsideRange { value: alpha, left: 0.0, right: SMALL_ALPHA_RANGE });
    }
    let square = alpha * alpha;
    let leading = 32.0 / 9.0 * mass_ratio.mu() * alpha * square * square;
    let relative = SMALL_HOP_REMAINDER * square * square + LOSS_ULPS * f64::EPSILON;
    let error = leading * relative + UNDERFLOW;
    Ok(ExpansionValue { value: leading * (1.0 - 1.6 * square), error, neglected_exponent: 9.0 })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// M, α and the loss (mpmath with 60 digits, from the equation of the landing), two of them where rounding
    /// dominates.
    #[test]
    fn losses_of_long_arithmetic_lie_within_the_bound() {
        for (m, alpha, exact) in [
            (0.001, 9.218369266853271e-8, 2.3621627619439477e-38),
            (0.001, 0.3, 7.503249106751793e-06),
            (0.001, 0.01, 3.547887412276996e-13),
            (1.0, 1.0806509538366222e-5, 1.3100102179545346e-25),
            (1.0, 0.3, 0.0018854672502226413),
            (1.0, 0.1, 8.748737637557536e-06),
            (1.0, 0.01, 8.88746687680828e-11),
        ] {
            let found = small_hop_loss(MassRatio::new(m).unwrap(), alpha).unwrap();
            let off = (found.value - exact).abs();
            // The digits of `exact` are rounded to half an ulp.
            assert!(off <= found.error && found.error < 3e-2 * exact, "{m} {alpha}: {found:?}");
            if (m, alpha) == (1.0, 0.01) {
                assert!(off > 0.95 * found.error, "{off:e} {found:?}");
            }
        }
    }

    #[test]
    fn the_bound_holds_where_the_loss_underflows() {
        for alpha in [1e-62, 1e-63, 1e-64, 3e-65, 1e-65, 1e-70, 1e-200, 5e-324] {
            let found = small_hop_loss(MassRatio::ONE, alpha).unwrap();
            // (8/9) α⁵ in spacings of the subnormal numbers, to a relative 10⁻¹⁵.
            let fifth_root_of_spacing = pxfm::f_exp2(-1074.0 / 5.0);
            let exact = 8.0 / 9.0 * (alpha / fifth_root_of_spacing).powi(5);
            let spacing = f64::from_bits(1);
            let off = (found.value / spacing - exact).abs();
            assert!(off <= found.error / spacing + 1e-13 * exact, "{alpha:e}: {exact} {found:?}");
            assert!(found.error > 0.0);
        }
    }
}
