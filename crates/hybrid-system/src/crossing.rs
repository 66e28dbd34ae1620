//! The first crossing of a guard along a flow, and how sure it is.

use crate::{Error, FirstCrossing, Guard, HybridSystem, Signal, State, bracketed_root};

/// How sure it is that a crossing is the first one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Certainty {
    /// The model solved for it.
    Exact,
    /// Bracketed under a bound: no earlier crossing can exist.
    Certain,
    /// Looked for at an interval; two crossings inside one interval would have been missed.
    Sampled {
        /// The interval.
        interval: f64,
    },
}

/// A guard crossed at a time after the start of an arc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing<S, const N: usize> {
    /// The surface that is crossed.
    pub surface: S,
    /// Time since the start of the arc.
    pub time: f64,
    /// The state on the surface, before any reset. A model that solves its crossings may know it
    /// better than the flow at the rounded time does.
    pub state: State<N>,
    /// How sure it is that this is the first crossing.
    pub certainty: Certainty,
}

/// The search under bounds of [`HybridSystem::first_crossing`]; nothing unless the horizon is finite and all
/// guards are signals.
pub(crate) fn certain_crossing<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
) -> Option<Result<Option<Crossing<T::Surface, N>>, Error>>
where
    T: HybridSystem<N> + ?Sized,
{
    let guards = system.guards(mode);
    if !horizon.is_finite() || guards.is_empty() {
        return None;
    }
    let signals: Option<Vec<(Guard<T::Surface>, Signal)>> = guards
        .iter()
        .map(|&guard| Some((guard, system.guard_signal(mode, guard.surface, start)?)))
        .collect();
    Some(earliest(system, mode, start, horizon, &signals?))
}

/// The earliest of the signals' crossings; of equal ones that of the guard listed first.
fn earliest<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    signals: &[(Guard<T::Surface>, Signal)],
) -> Result<Option<Crossing<T::Surface, N>>, Error>
where
    T: HybridSystem<N> + ?Sized,
{
    let mut best: Option<(f64, T::Surface)> = None;
    let mut grazing: Option<(f64, f64, T::Surface)> = None;
    for (guard, signal) in signals {
        match signal.first_crossing(guard.direction, horizon)? {
            FirstCrossing::At { time } if best.is_none_or(|(first, _)| time < first) => {
                best = Some((time, guard.surface));
            }
            FirstCrossing::Grazing { time, value }
                if grazing.is_none_or(|(first, ..)| time < first) =>
            {
                grazing = Some((time, value, guard.surface));
            }
            _ => {}
        }
    }
    if let Some((time, value, surface)) = grazing
        && best.is_none_or(|(first, _)| time <= first)
    {
        return Err(Error::Grazing { surface: format!("{surface:?}"), time, value });
    }
    Ok(best.map(|(time, surface)| {
        let state = system.flow(mode, start, time);
        Crossing { surface, time, state, certainty: Certainty::Certain }
    }))
}

/// The provided search of [`HybridSystem::first_crossing`].
pub(crate) fn sampled_crossing<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    interval: Option<f64>,
) -> Result<Option<Crossing<T::Surface, N>>, Error>
where
    T: HybridSystem<N> + ?Sized,
{
    let guards = system.guards(mode);
    let Some(first) = guards.first() else { return Ok(None) };
    let interval = interval
        .ok_or_else(|| Error::NoSamplingInterval { surface: format!("{:?}", first.surface) })?;
    if !(interval > 0.0) || !horizon.is_finite() || horizon + interval == horizon {
        return Err(Error::BadSamplingInterval { interval, horizon });
    }

    let mut watches: Vec<Watch<T::Surface>> = guards
        .iter()
        .map(|&guard| Watch::new(guard, system.guard_value(guard.surface, start)))
        .collect();
    let mut index = 0u64;
    loop {
        index += 1;
        let time = (index as f64 * interval).min(horizon);
        let sample = system.flow(mode, start, time);
        let mut earliest: Option<(f64, T::Surface)> = None;
        for watch in &mut watches {
            let value = system.guard_value(watch.guard.surface, &sample);
            if !value.is_finite() {
                return Err(Error::NotFinite { at: time, value });
            }
            let Some(bracket) = watch.advance(time, value, interval)? else { continue };
            let surface = watch.guard.surface;
            let along = |t: f64| system.guard_value(surface, &system.flow(mode, start, t));
            let at = bracketed_root(along, bracket.0, bracket.1)?;
            let at = beyond(along, at, bracket.1, value);
            if earliest.is_none_or(|(best, _)| at < best) {
                earliest = Some((at, surface));
            }
        }
        if let Some((time, surface)) = earliest {
            let state = system.flow(mode, start, time);
            let certainty = Certainty::Sampled { interval };
            return Ok(Some(Crossing { surface, time, state, certainty }));
        }
        if time >= horizon {
            return Ok(None);
        }
    }
}

/// The first time from `root` on at which the guard has the sign it has at `right`: an execution
/// that goes on from there does not cross again.
fn beyond(along: impl Fn(f64) -> f64, root: f64, right: f64, at_right: f64) -> f64 {
    let mut time = root;
    let mut step = 1u64;
    while time < right && along(time).signum() != at_right.signum() || along(time) == 0.0 {
        // 1, 2, 4, … ulps: rounding hides the sign for a few at most.
        let next = f64::from_bits(time.to_bits().saturating_add(step)).min(right);
        if next <= time {
            break;
        }
        time = next;
        step *= 2;
    }
    time
}

/// One guard along one arc: the last time at which it was not zero, and its value there.
struct Watch<S> {
    guard: Guard<S>,
    last_nonzero: Option<(f64, f64)>,
    first_zero: Option<f64>,
}

impl<S: Copy + std::fmt::Debug> Watch<S> {
    fn new(guard: Guard<S>, at_start: f64) -> Self {
        let last_nonzero = (at_start != 0.0).then_some((0.0, at_start));
        Watch { guard, last_nonzero, first_zero: None }
    }

    /// Takes the next sample; a bracket if the guard has been crossed in its direction.
    fn advance(
        &mut self,
        time: f64,
        value: f64,
        interval: f64,
    ) -> Result<Option<(f64, f64)>, Error> {
        if value == 0.0 {
            self.first_zero.get_or_insert(time);
            return Ok(None);
        }
        let zero = self.first_zero.take();
        match self.last_nonzero.replace((time, value)) {
            None if self.guard.direction.leads_to(value) => Err(Error::UndecidedStart {
                surface: format!("{:?}", self.guard.surface),
                interval,
            }),
            Some((since, before)) if self.guard.direction.admits(before, value) => {
                // A sample that hit zero is the first root: the bracket shrinks to it.
                Ok(Some((zero.unwrap_or(since), time)))
            }
            _ => Ok(None),
        }
    }
}
