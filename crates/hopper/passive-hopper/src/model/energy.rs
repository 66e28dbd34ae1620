//! The energy of both masses and the spring.
//!
//! Proof that nothing else changes it: docs/theory.md, Lemma 2.

use crate::model::mass_ratio::MassRatio;
use crate::model::state::HopperState;

/// Total energy in units of m₁m₂g²/k:
/// E = ½(1+M)(ẏ₁² + Mẏ₂²) + ½M s² + y₁ + M y₂.
///
/// Constant in flight and in contact; a landing takes ½M(1+M)ẏ₂², a lift-off takes none.
pub fn energy(mass_ratio: MassRatio, state: &HopperState) -> f64 {
    let m = mass_ratio.value();
    let (v1, v2) = (state.upper_velocity, state.lower_velocity);
    let s = state.stretch();
    0.5 * (1.0 + m) * (v1 * v1 + m * v2 * v2)
        + 0.5 * m * s * s
        + state.upper_position
        + m * state.lower_position
}

/// The energy that a plastic landing takes, ½M(1+M)ẏ₂², with the lower mass arriving at `lower_velocity` = ẏ₂.
pub fn landing_loss(mass_ratio: MassRatio, lower_velocity: f64) -> f64 {
    let m = mass_ratio.value();
    0.5 * m * (1.0 + m) * lower_velocity * lower_velocity
}
