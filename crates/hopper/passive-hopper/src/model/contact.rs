//! The contact phase: the upper mass oscillates harmonically about y₁ = −1/M, until the spring pulls the lower mass
//! upwards with a force equal to its weight.

use crate::error::Error;
use crate::model::mass_ratio::MassRatio;
use crate::model::state::HopperState;

/// The state after `time` of contact, from `start` (with y₂ = ẏ₂ = 0).
pub fn contact_flow(mass_ratio: MassRatio, start: &HopperState, time: f64) -> HopperState {
    let nu = mass_ratio.contact_frequency();
    let rest = 1.0 / mass_ratio.value();
    let (sin, cos) = pxfm::f_sincos(nu * time);
    let (x, v) = (start.upper_position + rest, start.upper_velocity);
    // y₁ − y₁(0) = −x (1 − cos) + (v/ν) sin. The plain form x cos + (v/ν) sin − 1/M would lose the digits of y₁ for
    // small M, where x is about 1/M.
    let sin_half = pxfm::f_sin(0.5 * nu * time);
    HopperState {
        upper_position: start.upper_position - x * 2.0 * sin_half * sin_half + v * (sin / nu),
        upper_velocity: v * cos - x * nu * sin,
        lower_position: 0.0,
        lower_velocity: 0.0,
    }
}

/// e = V² + x (2 + κ x), the square of the next gradual lift-off speed, for stretch 1 + x and velocity V on the
/// ground. This is the energy, shifted and scaled so that a gradual lift-off has e = α² (docs/theory.md, Lemma 2).
pub fn lift_off_energy(mass_ratio: MassRatio, excess: f64, velocity: f64) -> f64 {
    velocity * velocity + excess * (2.0 + mass_ratio.kappa() * excess)
}

/// Time of contact until the gradual lift-off, from stretch 1 + `excess` and `velocity`; `None` if the hopper stays
/// on the ground for ever.
///
/// A start at or beyond y₁ = 1 that moves up lifts off at once.
///
/// With a = y₁ + 1/M, c = 1 + 1/M, b = V/ν, q = √e/ν: a cos θ + b sin θ = c first rises at
/// tan ½θ = (c − a)/(b + q) = (b − q)/(a + c) (docs/theory.md, Lemma 3). The first form is used for b ≥ 0 and the
/// second for b < 0. The other form would subtract nearly equal numbers, or divide zero by zero.
///
/// # Errors
/// [`Error::NotFinite`] unless both numbers, and the energy computed from them, are finite.
pub fn contact_time(
    mass_ratio: MassRatio,
    excess: f64,
    velocity: f64,
) -> Result<Option<f64>, Error> {
    let energy = lift_off_energy(mass_ratio, excess, velocity);
    for (name, value) in
        [("the excess", excess), ("the velocity", velocity), ("the energy", energy)]
    {
        if !value.is_finite() {
            return Err(Error::NotFinite { name, value });
        }
    }
    if excess > 0.0 || (excess == 0.0 && velocity > 0.0) {
        return Ok(Some(0.0));
    }
    if !(energy > 0.0) {
        return Ok(None);
    }
    let nu = mass_ratio.contact_frequency();
    let (b, q) = (velocity / nu, energy.sqrt() / nu);
    let half_angle = if velocity >= 0.0 {
        pxfm::f_atan2(-excess, b + q)
    } else {
        let sum = 2.0 + excess + 2.0 / mass_ratio.value(); // a + c
        let angle = pxfm::f_atan2(b - q, sum);
        // tan ½θ has the period π in ½θ, and the first rise comes at a positive angle.
        if angle < 0.0 { angle + std::f64::consts::PI } else { angle }
    };
    Ok(Some(2.0 * half_angle / nu))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lift_off_time_and_speed_match_the_flow(m in 0.01..100f64, excess in -80.0..0f64, v in -20.0..20f64) {
            let ratio = MassRatio::new(m).unwrap();
            let start = HopperState { upper_position: 1.0 + excess, upper_velocity: v, ..HopperState::RELAXED };
            let energy = lift_off_energy(ratio, excess, v);
            match contact_time(ratio, excess, v).unwrap() {
                None => prop_assert!(energy <= 0.0),
                Some(time) => {
                    let end = contact_flow(ratio, &start, time);
                    let scale = 100.0 + 1.0 / m;
                    prop_assert!((end.upper_position - 1.0).abs() < 1e-12 * scale, "{end:?}");
                    prop_assert!((end.upper_velocity - energy.sqrt()).abs() < 1e-6 * scale);
                    // No earlier lift-off.
                    for k in 1..200 {
                        let early = contact_flow(ratio, &start, time * f64::from(k) / 200.0);
                        prop_assert!(early.upper_position < 1.0 + 1e-12 * scale);
                    }
                }
            }
        }
    }
}
