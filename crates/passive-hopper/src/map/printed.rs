//! The map as the paper prints it: Eqs. (6)–(8), solved by Brent's method.
//!
//! It gives the same values as the stable form but subtracts nearly equal numbers; kept to show
//! the difference, and as an independent check.

use crate::error::Error;
use crate::landing::from_ground::TakeOff;
use crate::landing::from_ground::time_bracket;
use crate::map::lift_off_map::SUDDEN_LIFT_OFF_BUDGET;
use crate::model::mass_ratio::MassRatio;
use hybrid_system::bracketed_root;

/// State of the upper mass at a lift-off or landing, (y₁, ẏ₁).
type UpperState = (f64, f64);

/// f(α; M) by the printed equations; nothing if the hopper is grounded.
///
/// The time of flight is the only root of Eq. (8) on a bracket that theory gives.
///
/// # Errors
/// [`Error::LiftOffSpeed`] and [`Error::LiftOffSpeedTooLarge`] as in the stable form;
/// [`Error::Landing`] where rounding hides the sign change of Eq. (8) on the bracket.
pub fn printed_image(mass_ratio: MassRatio, alpha: f64) -> Result<Option<f64>, Error> {
    crate::map::lift_off_map::LiftOffMap::new(mass_ratio).landings(alpha)?; // the same checks of α
    let mut state = (1.0, alpha);
    for _ in 0..SUDDEN_LIFT_OFF_BUDGET {
        let time = flight_time(state)?;
        state = flight_map(mass_ratio, state, time);
        let (y, v) = state;
        if !(y > 1.0 || (y == 1.0 && v > 0.0)) {
            return Ok(contact_map(mass_ratio, state));
        }
    }
    let (y, velocity) = state;
    Err(Error::SuddenLiftOffBudget { sudden: SUDDEN_LIFT_OFF_BUDGET, excess: y - 1.0, velocity })
}

/// The first positive root of Eq. (8), τ²/2 + V sin τ + Y cos τ − V τ − Y = 0.
fn flight_time((y, v): UpperState) -> Result<f64, Error> {
    let start = TakeOff { excess: y - 1.0, velocity: v };
    let (left, right) = time_bracket(start);
    let equation = |t: f64| {
        let (sin, cos) = pxfm::f_sincos(t);
        t * t / 2.0 + v * sin + y * cos - v * t - y
    };
    bracketed_root(equation, left, right).map_err(|source| Error::Landing {
        excess: start.excess,
        velocity: start.velocity,
        source,
    })
}

/// F_f, Eq. (6): from lift-off to landing.
fn flight_map(mass_ratio: MassRatio, (y, v): UpperState, t: f64) -> UpperState {
    let m = mass_ratio.value();
    let (sin, cos) = pxfm::f_sincos(t);
    (
        (y + v * t - t * t / 2.0 + m * (v * sin + y * cos)) / (1.0 + m),
        (v - t + m * (v * cos - y * sin)) / (1.0 + m),
    )
}

/// F_c, Eq. (7): from landing to the gradual lift-off.
fn contact_map(mass_ratio: MassRatio, (y, v): UpperState) -> Option<f64> {
    let m = mass_ratio.value();
    let next_speed_squared = ((1.0 + m) * v * v + m * y * y + 2.0 * y - 2.0 - m) / (1.0 + m);
    (next_speed_squared > 0.0).then(|| next_speed_squared.sqrt())
}
