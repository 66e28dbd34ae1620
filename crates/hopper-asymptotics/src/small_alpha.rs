//! Small hops: the map about α*_0 = 0.

use crate::error::Error;
use crate::expansion_value::ExpansionValue;
use passive_hopper::MassRatio;

/// The largest α for which the error was measured, and for which [`small_hop_loss`] has a value.
pub const SMALL_ALPHA_RANGE: f64 = 0.3;

/// Bound on |c₄ + c₆α² + …| in the factor 1 − (8/5)α² + c₄α⁴ + …. The largest measured value, against the exact map for
/// all μ (at most ¼) and α up to [`SMALL_ALPHA_RANGE`], is 4.3.
const NEGLECTED: f64 = 5.0;

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
    // Sixteen ulps cover the roundings of μ, of the five factors α and of the series.
    let error = leading * (NEGLECTED * square * square + 16.0 * f64::EPSILON);
    Ok(ExpansionValue { value: leading * (1.0 - 1.6 * square), error, neglected_exponent: 9.0 })
}
