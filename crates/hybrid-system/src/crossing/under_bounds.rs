//! One guard for which the model gives bounds.

use super::enclosure_search::EnclosedGuard;
use super::first_crossing::FirstCrossing;
use super::guard_rounding::guard_rounding;
use super::guarded_flow::GuardedFlow;
use super::step_past_root::step_past_root;
use crate::error::Error;
use crate::guard::Guard;

/// The first crossing of one guard under the bounds that the model gives; `None` if the model gives none.
///
/// # Errors
/// [`Error::BadLimit`] if there are bounds and the horizon is infinite: halving an infinite interval does not end.
pub(crate) fn crossing_under_bounds<F>(
    flow: &F,
    horizon: f64,
    guard: Guard<F::Surface>,
) -> Result<Option<FirstCrossing>, Error>
where
    F: GuardedFlow,
{
    let Guard { surface, direction, .. } = guard;
    // The interval has length zero: the call only tests whether the model gives enclosures of this guard.
    let has_enclosures = || flow.enclosure(surface, 0, (0.0, 0.0)).is_some();
    if !horizon.is_finite() {
        let bounded = flow.quasi_polynomial(surface).is_some() || has_enclosures();
        let error =
            Error::BadLimit { what: "the horizon of a search under bounds", value: horizon };
        return if bounded { Err(error) } else { Ok(None) };
    }
    let value = |time: f64| flow.guard_at(surface, time);
    let moved = |found| match found {
        FirstCrossing::At { time, rising } => {
            let time = past_surface(value, time, rising).min(horizon);
            FirstCrossing::At { time, rising }
        }
        other => other,
    };
    let start = flow.start();
    let start_error = guard_rounding(start, start, |state| flow.guard_value(surface, state));
    if let Some(quasi_polynomial) = flow.quasi_polynomial(surface) {
        let found = quasi_polynomial.first_crossing_from(direction, horizon, start_error);
        return found.map(moved).map(Some);
    }
    if !has_enclosures() {
        return Ok(None);
    }
    let enclosure = |order, times| flow.enclosure(surface, order, times);
    let found = EnclosedGuard { value, enclosure }.first_crossing(direction, horizon, start_error);
    found.map(moved).map(Some)
}

/// The most ulps by which a crossing is moved, in steps of 1, 2, 4, … 2²⁷ ulps.
///
/// Rounding merges two roots that are about √ε apart, 2⁻²⁶ of the time or 2²⁶ ulps. If a crossing has to be moved
/// farther than two or four times this distance, the guard as the model evaluates it does not have this crossing.
const MOST_ULPS: u64 = (1 << 28) - 1;

/// The first time, from the time of a crossing on, at which `value` is no longer on the old side of the surface.
///
/// The search used the guard as a quasi-polynomial or by enclosures. `value` is the guard as the model evaluates it,
/// and the two may differ by rounding. The next arc starts from this time, so that the model's own value must decide.
///
/// Returns `crossing` itself if the value stays on the old side for [`MOST_ULPS`].
fn past_surface(value: impl Fn(f64) -> f64, crossing: f64, rising: bool) -> f64 {
    let past = |time: f64| {
        let value = value(time);
        (value < 0.0) != rising || value == 0.0
    };
    let last = f64::from_bits(crossing.to_bits().saturating_add(MOST_ULPS));
    let time = step_past_root(crossing, last, past);
    if time < last || past(time) { time } else { crossing }
}
