//! The time and the state of a crossing without the rounding of the interpolant, and the error of the time.

use super::integration::Integration;
use super::step::Step;
use super::tolerances::Tolerances;
use crate::crossing::{bracketed_root, change_by_components, step_to_sign};
use crate::error::Error;
use crate::state::StateVector;

/// The largest distances by which a crossing is moved when it is polished, in units of the step. The smallest distance
/// that shows a change of sign is used. The rounding of an interpolant is about 1e-14 of a step for a guard of ordinary
/// slope; a guard that is crossed slowly needs more. If the last value shows no change of sign, the crossing of the
/// interpolant is kept.
const POLISHING_REACHES: [f64; 4] = [1e-14, 1e-12, 1e-10, 1e-8];

/// The rate of a guard at a crossing is taken over this part of the step on both sides. Over a shorter part rounding
/// would show, over a longer one the bend of the guard.
const RATE_REACH: f64 = 1e-4;

/// A guard that differs from zero by this part of its error counts as clear of it: one quarter is left for the bend of
/// the guard between the crossing and that place.
const CLEAR: f64 = 0.75;

/// Doublings of the error of a time. With the last one it is longer than the step.
const DOUBLINGS: usize = 64;

/// How accurate a flow is: its tolerances, and the number of steps from the start.
#[derive(Clone, Copy)]
pub(super) struct Accuracy {
    pub(super) tolerances: Tolerances,
    pub(super) steps: usize,
}

impl Accuracy {
    /// An estimate of the error of a guard by the error of the flow: the change of the guard if each component changes by
    /// its tolerance on every step. Growth or decay of these errors along the flow is not known here.
    pub(super) fn guard_error<V: StateVector>(&self, state: &V, guard: impl Fn(&V) -> f64) -> f64 {
        let unit = |axis: usize| self.tolerances.of(axis, state.components()[axis].abs());
        change_by_components(state, |axis| self.steps as f64 * unit(axis), guard)
    }
}

/// A crossing without the rounding error of the interpolant, and its state.
///
/// A separate step from the start of the last step to `time` gives the state without that error. The difference between
/// the two states changes little around `time`. Therefore it is added to the interpolant, and the crossing is searched
/// again next to the old one. The rounding of the interpolant may hide the guard for a time `hidden` around the crossing:
/// the values with the correction show a change of sign there.
pub(super) fn polished<F, V: StateVector>(
    integration: &mut Integration<F, V>,
    step: &Step<V>,
    (time, hidden): (f64, f64),
    until: f64,
    guard: impl Fn(&V) -> f64,
) -> Result<(f64, V), Error>
where
    F: Fn(f64, &V) -> V,
{
    // Here the separate step would have length zero.
    if time <= step.from {
        return Ok((time, step.state(time)));
    }
    let mut correction = integration.directly_at(time)?;
    correction.add_scaled(-1.0, &step.state(time));
    let corrected = |time: f64| {
        let mut state = step.state(time);
        state.add_scaled(1.0, &correction);
        state
    };
    let along = |time: f64| guard(&corrected(time));
    let length = step.to - step.from;
    let reaches = POLISHING_REACHES.map(|fraction| fraction * length).into_iter();
    for reach in reaches.chain([hidden]) {
        let (left, right) = ((time - reach).max(step.from), (time + reach).min(step.to));
        let (before, after) = (along(left), along(right));
        if before.signum() != after.signum() {
            let root = bracketed_root(along, left, right)?;
            let time = step_to_sign(along, root, right, after).min(until);
            return Ok((time, corrected(time)));
        }
    }
    // The guard is crossed so slowly that the correction moves the crossing farther than the last reach.
    Ok((time, step.state(time)))
}

/// The error of the time of a crossing: the distance in time at which the guard differs from zero by more than its error.
///
/// For a guard that is crossed at the rate ġ it is the error over |ġ|. At a touch it is about the root of the error. It is
/// at most the length of the step: farther away the guard is not looked at. If the search has seen that rounding hides the
/// guard for the time `hidden` before the crossing, also on earlier steps, the error is no less.
pub(super) fn time_error<V: StateVector>(
    step: &Step<V>,
    (time, hidden): (f64, f64),
    state: &V,
    guard: impl Fn(&V) -> f64,
    accuracy: Accuracy,
) -> f64 {
    let error = accuracy.guard_error(state, &guard);
    let length = step.to - step.from;
    let along = |time: f64| {
        let inside = time.clamp(step.from, step.to);
        let value = guard(&step.state(inside));
        // Beyond an end of the step the guard goes on along its tangent. Its value at the end alone would never be clear
        // if the crossing is there.
        if inside == time { value } else { value + (time - inside) * rate(step, inside, &guard) }
    };
    let mut distance =
        (error / rate(step, time, &guard).abs()).max(f64::EPSILON * time).max(hidden);
    for _ in 0..DOUBLINGS {
        // The condition is true for NaN: then nothing is known on the step.
        if !(distance < length) {
            return length.max(hidden);
        }
        // A quarter less, for the bend of the guard.
        let clear = |moved: f64| along(moved).abs() >= CLEAR * error;
        let before_step = hidden > 0.0 && time - distance < step.from;
        if (before_step || clear(time - distance)) && clear(time + distance) {
            break;
        }
        distance *= 2.0;
    }
    distance
}

/// ġ at a time of the step, by a difference along the interpolant.
pub(super) fn rate<V: StateVector>(step: &Step<V>, time: f64, guard: impl Fn(&V) -> f64) -> f64 {
    let reach = RATE_REACH * (step.to - step.from);
    let (left, right) = ((time - reach).max(step.from), (time + reach).min(step.to));
    (guard(&step.state(right)) - guard(&step.state(left))) / (right - left)
}
