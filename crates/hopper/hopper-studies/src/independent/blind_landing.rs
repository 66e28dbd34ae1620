//! The first landing of a gradual lift-off, by searches that know nothing about landings.

use crate::error::Error;
use hybrid_system::{Execution, Limits, Searched};
use interval_arithmetic::bracketed_root;
use passive_hopper::{Hopper, HopperState, MassRatio, Phase};

/// Interval of time at which the height of the lower mass is sampled. It oscillates with the period 2π; this is a 125th
/// of it. A longer interval would miss short dips below the ground.
const SPACING: f64 = 0.05;

/// Time of flight, and height of the upper mass at the landing.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BlindLanding {
    pub(crate) time: f64,
    /// y₁ − 1 at the landing: positive if the lower mass is pulled off again.
    pub(crate) excess: f64,
}

/// The landing by the printed Eqs. 6 and 8. The first change of sign of Eq. 8 is searched by samples and refined.
pub(crate) fn printed_landing(alpha: f64, mass_ratio: MassRatio) -> Result<BlindLanding, Error> {
    // Eq. 8 is −(1+M) y₂: negative in flight.
    let equation = |t: f64| {
        let (sin, cos) = pxfm::f_sincos(t);
        t * t / 2.0 + alpha * sin + cos - alpha * t - 1.0
    };
    let mut left = SPACING;
    // At τ = 2α + 4, τ²/2 − ατ exceeds all other terms.
    let samples = ((2.0 * alpha + 4.0) / SPACING) as u32;
    for k in 2..=samples {
        let right = SPACING * f64::from(k);
        if equation(right) >= 0.0 {
            let time = bracketed_root(equation, left, right)?;
            let (sin, cos) = pxfm::f_sincos(time);
            let m = mass_ratio.value();
            let height =
                (1.0 + alpha * time - time * time / 2.0 + m * (alpha * sin + cos)) / (1.0 + m);
            return Ok(BlindLanding { time, excess: height - 1.0 });
        }
        left = right;
    }
    Err(Error::CheckFailed(format!("no landing was found after the lift-off with speed {alpha}")))
}

/// y₁ − 1 at the landing by an execution of the hybrid system, which samples its guards.
pub(crate) fn sampled_excess(alpha: f64, mass_ratio: MassRatio) -> Result<f64, Error> {
    let hopper = Searched(Hopper::new(mass_ratio));
    let limits = Limits::sampled(2.0 * alpha + 4.0, 1, SPACING);
    let start = HopperState::lift_off(alpha).into();
    let mut execution = Execution::new(&hopper, Phase::Flight, start, limits);
    let arc = execution.next().transpose()?;
    arc.and_then(|arc| Some(arc.event()?.before[0] - 1.0)).ok_or_else(|| {
        Error::CheckFailed(format!("no landing was found after the lift-off with speed {alpha}"))
    })
}
