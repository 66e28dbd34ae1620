//! Both masses against time, and the units of a hopper with masses in kilograms.

use crate::json::Json;
use crate::refusal::Refusal;
use hopper_figures::{Motion, Sample};
use passive_hopper::{MassRatio, Phase, PhysicalHopper};

/// Hops of a motion: a page shows some dozen.
const MOST_HOPS: usize = 200;

/// Numbers of a sample: time, hop, 1 in flight and 0 on the ground, y₁, ẏ₁, y₂, ẏ₂.
const NUMBERS: usize = 7;

/// The samples of a motion over some hops: 1 or 0 for a hopper that is grounded at the end, then seven numbers for
/// each sample: time, hop, 1 in flight and 0 on the ground, y₁, ẏ₁, y₂, ẏ₂. A sudden lift-off is a landing after
/// which the phase is flight again.
///
/// # Errors
/// The refusals of [`Motion::new`], and of more than 200 hops.
pub fn motion(mass_ratio: f64, alpha: f64, hops: usize) -> Result<Vec<f64>, Refusal> {
    if hops > MOST_HOPS {
        return Err(Refusal::new(format!("a motion has up to {MOST_HOPS} hops here, not {hops}")));
    }
    let motion = Motion::new(MassRatio::new(mass_ratio)?, alpha, hops)?;
    let mut all = Vec::with_capacity(1 + NUMBERS * motion.samples.len());
    all.push(f64::from(u8::from(motion.grounded)));
    all.extend(motion.samples.iter().flat_map(numbers));
    Ok(all)
}

fn numbers(sample: &Sample) -> [f64; NUMBERS] {
    let flies = f64::from(u8::from(sample.phase == Phase::Flight));
    let state = &sample.state;
    [
        sample.time,
        sample.hop as f64,
        flies,
        state.upper_position,
        state.upper_velocity,
        state.lower_position,
        state.lower_velocity,
    ]
}

/// The units of a hopper with a total mass in kilograms, a spring in N/m and gravity in m/s², as JSON.
///
/// # Errors
/// The refusals of [`PhysicalHopper::new`].
pub fn units(mass_ratio: f64, mass: f64, stiffness: f64, gravity: f64) -> Result<String, Refusal> {
    Ok(units_json(mass_ratio, mass, stiffness, gravity)?.finish())
}

pub(crate) fn units_json(
    mass_ratio: f64,
    mass: f64,
    stiffness: f64,
    gravity: f64,
) -> Result<Json, Refusal> {
    let ratio = MassRatio::new(mass_ratio)?;
    // κ is the lower mass's part of both, also for 1/M.
    let (upper, lower) = (mass * ratio.inverted().kappa(), mass * ratio.kappa());
    let hopper = PhysicalHopper::new(upper, lower, stiffness, gravity)?;
    Ok(Json::object()
        .number("upperMass", upper)
        .number("lowerMass", lower)
        .number("length", hopper.length_unit())
        .number("time", hopper.time_unit())
        .number("speed", hopper.speed_unit())
        .number("energy", hopper.energy_unit()))
}
