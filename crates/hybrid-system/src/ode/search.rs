//! The first crossing of all guards of a mode along an integrated flow.

use super::step::Step;
use super::watch::{Ahead, Watch};
use super::{Integration, Tolerances};
use crate::crossing::{beyond, sooner};
use crate::{Certainty, Crossing, Error, HybridSystem, State, bracketed_root};

/// Shares of the step that a crossing may move by; the least that shows a change of sign.
const NEAR: [f64; 4] = [1e-14, 1e-12, 1e-10, 1e-8];

/// Guards of one mode that are followed without allocating.
const GUARDS: usize = 8;

/// Follows `field` from `start` until a guard of `mode` is crossed, or to `horizon`.
pub(super) fn search<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    field: impl Fn(f64, &State<N>) -> State<N>,
    tolerances: Tolerances,
) -> Result<Option<Crossing<T::Surface, N>>, Error>
where
    T: HybridSystem<N> + ?Sized,
{
    if !(horizon >= 0.0) {
        return Err(Error::BadLimit { what: "the horizon of a search", value: horizon });
    }
    if system.guards(mode).is_empty() || horizon == 0.0 {
        return Ok(None);
    }
    let mut first_step = f64::INFINITY;
    loop {
        let integration = Integration::new(&field, start, tolerances)?.starting_with(first_step);
        match attempt(system, mode, start, horizon, &field(0.0, start), integration)? {
            Attempt::Done(crossing) => return Ok(crossing),
            // A shorter first step is rounded less, unless it is the state itself that hides the crossing.
            Attempt::Hidden { until, .. } if until < 0.5 * first_step => first_step = 0.5 * until,
            Attempt::Hidden { until, surface } => {
                let surface = format!("{surface:?}");
                return Err(Error::UndecidedStart { surface, interval: until });
            }
        }
    }
}

/// What a search led to.
enum Attempt<S, const N: usize> {
    /// The first crossing, if there is one.
    Done(Option<Crossing<S, N>>),
    /// A guard left a start at zero to one side and was on the other at this time; rounding hides the rest.
    Hidden { until: f64, surface: S },
}

fn attempt<T, F, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    rate: &State<N>,
    mut integration: Integration<F, N>,
) -> Result<Attempt<T::Surface, N>, Error>
where
    T: HybridSystem<N> + ?Sized,
    F: Fn(f64, &State<N>) -> State<N>,
{
    let guards = system.guards(mode);
    let value = |surface| move |state: &State<N>| -> f64 { system.guard_value(surface, state) };
    let mut few: [Option<Watch>; GUARDS] = [const { None }; GUARDS];
    let mut many = Vec::new();
    let watches = if guards.len() <= GUARDS {
        &mut few[..guards.len()]
    } else {
        many.resize_with(guards.len(), || None);
        &mut many[..]
    };
    for (watch, guard) in watches.iter_mut().zip(guards) {
        *watch = Some(Watch::new(guard.direction, start, rate, value(guard.surface))?);
    }
    while integration.interval().1 < horizon {
        integration.step()?;
        let away = watches.iter().zip(guards).all(|(watch, guard)| {
            let values = integration.samples().map(|state| value(guard.surface)(&state));
            watch.as_ref().is_some_and(|watch| watch.stays(values))
        });
        if away {
            continue;
        }
        let step = integration.last_step();
        let until = step.to.min(horizon);
        let mut first: Option<(f64, T::Surface)> = None;
        let mut touch: Option<(f64, f64, T::Surface)> = None;
        for (watch, guard) in watches.iter_mut().zip(guards) {
            let Some(watch) = watch else { continue };
            match watch.crossing(&step, until, value(guard.surface))? {
                Ahead::At { time } if first.is_none_or(|(best, _)| sooner(time, best)) => {
                    first = Some((time, guard.surface));
                }
                Ahead::Grazing { time, value } if touch.is_none_or(|(best, ..)| time < best) => {
                    touch = Some((time, value, guard.surface));
                }
                Ahead::Hidden { until } => {
                    return Ok(Attempt::Hidden { until, surface: guard.surface });
                }
                _ => {}
            }
        }
        if let Some((time, value, surface)) = touch
            && first.is_none_or(|(best, _)| time <= best)
        {
            return Err(Error::Grazing { surface: format!("{surface:?}"), time, value });
        }
        if let Some((time, surface)) = first {
            let value = value(surface);
            let (time, state) = polished(&mut integration, &step, time, until, value)?;
            let certainty = Certainty::Interpolated;
            return Ok(Attempt::Done(Some(Crossing { surface, time, state, certainty })));
        }
    }
    Ok(Attempt::Done(None))
}

/// A crossing without the rounding of the interpolant: its time on the step moved to where a step that ends
/// there leads, and the state then.
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
    if time <= step.from {
        return Ok((time, step.state(time)));
    }
    let off = integration.directly_at(time)? - step.state(time);
    let moved = |time: f64| step.state(time) + off;
    let along = |time: f64| guard(&moved(time));
    for share in NEAR {
        let reach = share * (step.to - step.from);
        let (left, right) = ((time - reach).max(step.from), (time + reach).min(step.to));
        let (before, after) = (along(left), along(right));
        if before.signum() != after.signum() {
            let time = beyond(along, bracketed_root(along, left, right)?, right, after).min(until);
            return Ok((time, moved(time)));
        }
    }
    // Crossed so slowly that the difference matters: it stays where the interpolant has it.
    Ok((time, step.state(time)))
}
