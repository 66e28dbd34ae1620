//! Whether a time is a period of a model, so that what follows from a state there follows again.

use crate::error::Error;
use crate::model::file::Model;
use crate::model::question::failed;
use equations::Formulas;
use hybrid_system::{GuardParts, Role};

/// How far numbers may differ at two times that are a period apart, as a part of their size: rounding of the times.
const SAME: f64 = 1e-11;

/// Points at which formulas are compared. Analytic functions that differ are the same at none of them but by chance.
const POINTS: usize = 24;

/// Multiples of these numbers fill a cube evenly: parts of roots of primes.
const STEPS: [f64; 4] = [
    0.414_213_562_373_095,
    0.732_050_807_568_877_2,
    0.236_067_977_499_789_7,
    0.645_751_311_064_590_6,
];

/// Points that fill the cube [−1, 1]ⁿ.
pub(crate) fn spread(points: usize, dimension: usize) -> impl Iterator<Item = Vec<f64>> {
    (1..=points).map(move |point| {
        let part = |at: usize| {
            let step = STEPS[at % STEPS.len()] * (1 + at / STEPS.len()) as f64;
            2.0 * (point as f64 * step).fract() - 1.0
        };
        (0..dimension).map(part).collect()
    })
}

/// Refuses a time that is no period of all that depends on the time: rates, guards, conditions and resets of all modes, and
/// clocks. A surface that changes nothing does not count, nor `own`, at which the map itself ends. `around` is a state.
///
/// # Errors
/// [`Error::Misuse`] with what differs.
pub(crate) fn check_period(
    model: &Model,
    period: f64,
    around: &[f64],
    own: Option<&str>,
    option: &str,
) -> Result<(), Error> {
    if model.equations.is_autonomous() {
        return Ok(());
    }
    let refused = |what: String| {
        Err(Error::Misuse(format!(
            "{option}: the equations use the time, and {period} is no period of {what}; give a period, or make the phase \
             a state"
        )))
    };
    for mode in model.equations.mode_parts(&[]).map_err(failed)? {
        if !same(&mode.field, period, around, 0) {
            return refused(format!("the rates of the mode {}", mode.name));
        }
        let counts = |guard: &&GuardParts| {
            let changes = guard.stops || guard.mode.is_some() || guard.state.is_some();
            changes && own != Some(guard.guard.surface.as_str())
        };
        for guard in mode.guards.iter().filter(counts) {
            let is_same = match guard.guard.role {
                Role::Clock => is_multiple(&guard.function, period, around),
                _ => same(&guard.function, period, around, 0),
            };
            let condition = guard.condition.as_ref();
            let is_same = is_same
                && condition.is_none_or(|condition| same(condition, period, around, 0))
                // The time is the last component behind an event.
                && guard.state.as_ref().is_none_or(|state| same(state, period, around, 1));
            if !is_same {
                return refused(format!("the surface {}", guard.guard.surface));
            }
        }
    }
    Ok(())
}

/// Whether formulas have the same values at times that are a period apart. The last `left_out` ones are not compared.
fn same(formulas: &Formulas, period: f64, around: &[f64], left_out: usize) -> bool {
    let dimension = formulas.names().states.len();
    if dimension <= around.len() {
        return true; // without the time
    }
    spread(POINTS, dimension).all(|point| {
        let mut state: Vec<f64> =
            around.iter().zip(&point).map(|(x, part)| x + part * (1.0 + x.abs())).collect();
        let time = 0.5 * period * (1.0 + point[around.len()]);
        let mut at = |time: f64| {
            state.truncate(around.len());
            state.push(time);
            formulas.values(0.0, &state)
        };
        // Where a formula has no value, as √x at x < 0, there is nothing to compare.
        let (Ok(one), Ok(other)) = (at(time), at(time + period)) else { return true };
        let compared = one.len().saturating_sub(left_out);
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= SAME * (1.0 + a.abs() + b.abs());
        one.iter().zip(&other).take(compared).all(near)
    })
}

/// Whether a time is a multiple of the period of a clock that begins within it.
fn is_multiple(times: &Formulas, period: f64, around: &[f64]) -> bool {
    let mut state = around.to_vec();
    state.resize(times.names().states.len(), 0.0);
    let Ok(times) = times.values(0.0, &state) else { return false };
    let &[first, own] = &times[..] else { return false };
    let parts = period / own;
    own > 0.0
        && first <= own * (1.0 + SAME)
        && (parts - parts.round()).abs() <= SAME * (1.0 + parts)
}
