//! Lift-off maps as functions, so that a claim can be tested on any of them.

use crate::error::Error;
use passive_hopper::{LiftOffMap, MassRatio, printed_image};

/// A lift-off map: α′ = f(α; M), `None` if the hopper is grounded.
pub(crate) trait Map: Fn(f64, MassRatio) -> Result<Option<f64>, Error> + Sync {}

impl<F: Fn(f64, MassRatio) -> Result<Option<f64>, Error> + Sync> Map for F {}

/// The map by the paper's Eqs. 6–8. The mass ratio M stands in Eqs. 6 and 7 alone and not as μ.
pub(crate) fn printed(alpha: f64, mass_ratio: MassRatio) -> Result<Option<f64>, Error> {
    Ok(printed_image(mass_ratio, alpha)?)
}

/// The map in its stable form.
pub(crate) fn stable(alpha: f64, mass_ratio: MassRatio) -> Result<Option<f64>, Error> {
    Ok(LiftOffMap::new(mass_ratio).image(alpha)?)
}

/// Bound on the rounding of α′² by the printed equations on a contact part, relative to α².
///
/// The time τ ≤ 2α + π comes with 2ετ. In contact and in flight ÿ₁ is the same at y₂ = 0, so that e is stationary
/// at the landing and the error of τ plays no part. In Eq. 6, P = y₁ + V τ − τ²/2 has terms up to 1 + 2α², and s is
/// at most 1 + α. The weights 1/(1+M) and M/(1+M) stand before them, and |V′| ≤ 1 + 3α. So y₁ is wrong by at most
/// 8ε(1+α²)(1−κ) + 4ε(1+α)κ, and ẏ₁ by 12ε(1+α). In Eq. 7, e has the derivatives 2κy₁ + 2(1−κ) and 2ẏ₁ with
/// |y₁| ≤ 1 + α, and κ(1−κ) ≤ ¼: together 4εα³ + 64ε(1+α²), the second term with room for the sums of Eq. 7. For small
/// α the terms of Eq. 7 are some 1 and cancel: this is the second term without its α².
pub(crate) fn printed_rounding(alpha: f64) -> f64 {
    f64::EPSILON * (4.0 * alpha + 64.0 + 64.0 / (alpha * alpha))
}
