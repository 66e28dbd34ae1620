//! The map as the paper prints it: Eqs. (6)–(8), solved by Brent's method.
//!
//! The printed form gives the same values as the stable form. But it subtracts nearly equal numbers and loses
//! digits where their difference is small. It serves to show this loss, and as a check of the stable form. The
//! check is independent except for the bracket of each landing, which is that of the stable form
//! (`printed_bracket.rs`). Its decisions (sudden or not, grounded or not) are the signs of plain `f64`: next to a
//! change of branch they may be wrong.

use crate::error::Error;
use crate::landing::flight_ends::TakeOff;
use crate::landing::printed_bracket::time_bracket;
use crate::map::lift_off_map::check_speed;
use crate::map::limits::SUDDEN_LIFT_OFF_BUDGET;
use crate::model::mass_ratio::MassRatio;
use interval_arithmetic::bracketed_root;

/// State of the upper mass at a lift-off or landing, (y₁, ẏ₁).
type UpperState = (f64, f64);

/// f(α; M) by the printed equations; `None` if the hopper is grounded.
///
/// The time of flight is the only root of Eq. (8) in a bracket that docs/theory.md, Theorem 7 and Theorem 12, gives.
///
/// # Errors
/// [`Error::LiftOffSpeed`], [`Error::LiftOffSpeedTooLarge`] and [`Error::SuddenLiftOffBudget`] as in the stable form;
/// [`Error::Landing`] if rounding hides the sign change of Eq. (8) on the bracket.
pub fn printed_image(mass_ratio: MassRatio, alpha: f64) -> Result<Option<f64>, Error> {
    check_speed(alpha)?;
    let mut state = (1.0, alpha);
    for _ in 0..SUDDEN_LIFT_OFF_BUDGET {
        let time = flight_time(state)?;
        state = flight_map(mass_ratio, state, time);
        let (y, v) = state;
        // y₁ > 1 pulls the lower mass off again; so does y₁ = 1 if the upper mass moves up.
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

/// F_c, Eq. (7): from the landing to the gradual lift-off; `None` if the hopper is grounded.
fn contact_map(mass_ratio: MassRatio, (y, v): UpperState) -> Option<f64> {
    let m = mass_ratio.value();
    let next_speed_squared = ((1.0 + m) * v * v + m * y * y + 2.0 * y - 2.0 - m) / (1.0 + m);
    (next_speed_squared > 0.0).then(|| next_speed_squared.sqrt())
}
