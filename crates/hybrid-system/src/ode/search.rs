//! The first crossing of all guards of a mode along an integrated flow.

use super::followed_guard::{FollowedGuard, StepOutcome};
use super::integration::Integration;
use super::step::Step;
use super::tolerances::Tolerances;
use crate::crossing::{
    Certainty, Crossing, EventKind, NextEvent, Search, bracketed_root, sooner, step_to_sign,
};
use crate::error::Error;
use crate::guard::{Guard, Role};
use crate::state::State;
use crate::system::HybridSystem;

/// The largest distances by which a crossing is moved when it is polished, in units of the step. The smallest distance
/// that shows a change of sign is used. The rounding of an interpolant is about 1e-14 of a step for a guard of ordinary
/// slope; a guard that is crossed slowly needs more. If the last value shows no change of sign, the crossing of the
/// interpolant is kept.
const POLISHING_REACHES: [f64; 4] = [1e-14, 1e-12, 1e-10, 1e-8];

/// Guards of one mode that are followed without allocating. With more guards each search allocates once.
const GUARDS_ON_STACK: usize = 8;

/// The first step after rounding has hidden a start, relative to the time up to which it was hidden. Another try is
/// made only if that time is less than this part of the last first step. So first steps shrink by a factor of 4 at
/// least, and the tries end. A value near 1 would repeat steps that differ too little to show more. A smaller one
/// would give up where a somewhat shorter step shows the crossing.
const SHORTER_FIRST_STEP: f64 = 0.5;

/// Follows `field` from `start` until a guard of `mode` is crossed, or to `horizon`.
pub(super) fn search<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    request: &Search<T::Surface>,
    field: impl Fn(f64, &State<N>) -> State<N>,
    tolerances: Tolerances,
) -> Result<NextEvent<T::Surface, State<N>>, Error>
where
    T: HybridSystem<State = State<N>> + ?Sized,
{
    let horizon = request.horizon;
    if !(horizon >= 0.0) {
        return Err(Error::BadLimit { what: "the horizon of a search", value: horizon });
    }
    let searched = |guard: &Guard<T::Surface>| guard.role != Role::Clock;
    if !system.guards(mode).iter().any(searched) || horizon == 0.0 {
        return Ok(NextEvent::None { state: None, certainty: Certainty::Interpolated });
    }
    let mut first_step = f64::INFINITY;
    loop {
        let integration = Integration::new(&field, start, tolerances)?.starting_with(first_step);
        let rate = field(0.0, start);
        match search_once(system, mode, start, horizon, &rate, integration)? {
            SearchOutcome::Finished(crossing) => {
                let none = NextEvent::None { state: None, certainty: Certainty::Interpolated };
                return Ok(crossing.map_or(none, NextEvent::Crossing));
            }
            // The rounding of an interpolant grows with the length of its step. A shorter first step therefore shows
            // more, as long as the hidden time becomes shorter with it.
            SearchOutcome::HiddenByRounding { until, .. }
                if until < SHORTER_FIRST_STEP * first_step =>
            {
                first_step = SHORTER_FIRST_STEP * until;
            }
            // The hidden time does not become shorter: the rounding of the state itself hides the crossing.
            SearchOutcome::HiddenByRounding { until, surface } => {
                let surface = format!("{surface:?}");
                return Err(Error::UndecidedStart { surface, interval: until });
            }
        }
    }
}

/// The result of a search with one choice of the first step.
enum SearchOutcome<S, X> {
    /// The first crossing; `None` if there is none up to the horizon.
    Finished(Option<Crossing<S, X>>),
    /// Rounding hides how this guard leaves its start, up to this time.
    HiddenByRounding { until: f64, surface: S },
}

fn search_once<T, F, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    rate: &State<N>,
    mut integration: Integration<F, N>,
) -> Result<SearchOutcome<T::Surface, State<N>>, Error>
where
    T: HybridSystem<State = State<N>> + ?Sized,
    F: Fn(f64, &State<N>) -> State<N>,
{
    let guards = system.guards(mode);
    let value = |surface| move |state: &State<N>| -> f64 { system.guard_value(surface, state) };
    let mut on_stack: [Option<FollowedGuard>; GUARDS_ON_STACK] = [const { None }; GUARDS_ON_STACK];
    let mut on_heap = Vec::new();
    let followed = if guards.len() <= GUARDS_ON_STACK {
        &mut on_stack[..guards.len()]
    } else {
        on_heap.resize_with(guards.len(), || None);
        &mut on_heap[..]
    };
    for (followed, guard) in followed.iter_mut().zip(guards) {
        if guard.role != Role::Clock {
            *followed =
                Some(FollowedGuard::new(guard.direction, start, rate, value(guard.surface))?);
        }
    }
    while integration.interval().1 < horizon {
        integration.step()?;
        // In the common case neither the stages of the interpolant nor the polynomial of a guard are computed.
        let all_stay_away = followed.iter().zip(guards).all(|(followed, guard)| {
            let values = integration.samples().map(|state| value(guard.surface)(&state));
            followed.as_ref().is_none_or(|followed| followed.stays_away(values))
        });
        if all_stay_away {
            continue;
        }
        let step = integration.last_step();
        let until = step.to.min(horizon);
        let mut first: Option<(f64, T::Surface)> = None;
        let mut grazing: Option<(f64, f64, T::Surface)> = None;
        for (followed, guard) in followed.iter_mut().zip(guards) {
            let Some(followed) = followed else { continue };
            match followed.crossing(&step, until, value(guard.surface))? {
                StepOutcome::Crossing { time }
                    if first.is_none_or(|(best, _)| sooner(time, best)) =>
                {
                    first = Some((time, guard.surface));
                }
                StepOutcome::Grazing { time, value }
                    if grazing.is_none_or(|(best, ..)| time < best) =>
                {
                    grazing = Some((time, value, guard.surface));
                }
                StepOutcome::HiddenByRounding { until } => {
                    return Ok(SearchOutcome::HiddenByRounding { until, surface: guard.surface });
                }
                // A later crossing, a later grazing, or none.
                _ => {}
            }
        }
        // A grazing after the first crossing never happens: the reset comes before it.
        if let Some((time, value, surface)) = grazing
            && first.is_none_or(|(best, _)| time <= best)
        {
            return Err(Error::Grazing { surface: format!("{surface:?}"), time, value });
        }
        if let Some((time, surface)) = first {
            let value = value(surface);
            let (time, state) = polished(&mut integration, &step, time, until, value)?;
            return Ok(SearchOutcome::Finished(Some(Crossing {
                surface,
                time,
                // A few times the local error: the tolerance over the rate is not known here yet.
                time_error: 8.0 * f64::EPSILON * time,
                state,
                kind: EventKind::Crossing,
                certainty: Certainty::Interpolated,
            })));
        }
    }
    Ok(SearchOutcome::Finished(None))
}

/// A crossing without the rounding error of the interpolant, and its state.
///
/// A separate step from the start of the last step to `time` gives the state without that error. The difference between
/// the two states changes little around `time`. Therefore it is added to the interpolant, and the crossing is searched
/// again next to the old one.
fn polished<F, const N: usize>(
    integration: &mut Integration<F, N>,
    step: &Step<N>,
    time: f64,
    until: f64,
    guard: impl Fn(&State<N>) -> f64,
) -> Result<(f64, State<N>), Error>
where
    F: Fn(f64, &State<N>) -> State<N>,
{
    // Here the separate step would have length zero.
    if time <= step.from {
        return Ok((time, step.state(time)));
    }
    let correction = integration.directly_at(time)? - step.state(time);
    let corrected = |time: f64| step.state(time) + correction;
    let along = |time: f64| guard(&corrected(time));
    for fraction in POLISHING_REACHES {
        let reach = fraction * (step.to - step.from);
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
