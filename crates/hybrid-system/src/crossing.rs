//! The first crossing of a guard along a flow, and how sure it is.

use crate::enclosure::Enclosed;
use crate::{Error, FirstCrossing, Guard, HybridSystem, State, bracketed_root};

/// How sure it is that a crossing is the first one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Certainty {
    /// The model solved for it.
    Exact,
    /// Bracketed under a bound: no earlier crossing can exist.
    Certain,
    /// Found along an integrated flow, on polynomials through the guard's values on the integrator's
    /// interpolant: none of theirs was missed where its values at eighths of a step do not keep away from zero. The
    /// flow itself is as exact as its tolerances.
    Interpolated,
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

/// The provided search of [`HybridSystem::first_crossing`].
pub(crate) fn earliest_crossing<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    interval: Option<f64>,
) -> Result<Option<Crossing<T::Surface, N>>, Error>
where
    T: HybridSystem<N> + ?Sized,
{
    let mut best: Option<(f64, usize)> = None;
    let mut grazing: Option<(f64, f64, usize)> = None;
    let mut unbounded = Vec::new();
    let guards = system.guards(mode);
    for (index, &guard) in guards.iter().enumerate() {
        match certain_crossing(system, mode, start, horizon, guard)? {
            Some(FirstCrossing::At { time, .. })
                if best.is_none_or(|best| sooner(time, best.0)) =>
            {
                best = Some((time, index));
            }
            Some(FirstCrossing::Grazing { time, value })
                if grazing.is_none_or(|(first, ..)| time < first) =>
            {
                grazing = Some((time, value, index));
            }
            Some(_) => {}
            None => unbounded.push(index),
        }
    }
    let mut certainty = Certainty::Certain;
    if let Some(&first) = unbounded.first() {
        let surface = || format!("{:?}", guards[first].surface);
        let interval = interval.ok_or_else(|| Error::NoSamplingInterval { surface: surface() })?;
        certainty = Certainty::Sampled { interval };
        let until = best.map_or(horizon, |(time, _)| time);
        let sampled = sampled_crossing(system, mode, start, until, interval, &unbounded)?;
        if let Some(found) = sampled
            && best.is_none_or(|best| found < best)
        {
            best = Some(found);
        }
    }
    if let Some((time, value, index)) = grazing
        && best.is_none_or(|(first, _)| time <= first)
    {
        let surface = format!("{:?}", guards[index].surface);
        return Err(Error::Grazing { surface, time, value });
    }
    Ok(best.map(|(time, index)| {
        let state = system.flow(mode, start, time);
        Crossing { surface: guards[index].surface, time, state, certainty }
    }))
}

/// Whether a time comes before another by more than a few ulps: of those at the same instant the guard listed first
/// wins.
pub(crate) fn sooner(time: f64, than: f64) -> bool {
    time < than * (1.0 - 4.0 * f64::EPSILON)
}

/// The first crossing of one guard for which the model gives bounds, up to a finite horizon.
fn certain_crossing<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    guard: Guard<T::Surface>,
) -> Result<Option<FirstCrossing>, Error>
where
    T: HybridSystem<N> + ?Sized,
{
    let Guard { surface, direction } = guard;
    if !horizon.is_finite() {
        let bounded = system.guard_quasi_polynomial(mode, surface, start).is_some()
            || system.guard_enclosure(mode, surface, start, 0, (0.0, 0.0)).is_some();
        let error =
            Error::BadLimit { what: "the horizon of a search under bounds", value: horizon };
        return if bounded { Err(error) } else { Ok(None) };
    }
    let value = |time: f64| system.guard_value(surface, &system.flow(mode, start, time));
    let behind = |found| match found {
        FirstCrossing::At { time, rising } => {
            FirstCrossing::At { time: behind(value, time, rising).min(horizon), rising }
        }
        other => other,
    };
    let error = rounding_at(start, &start.abs(), |state| system.guard_value(surface, state));
    if let Some(signal) = system.guard_quasi_polynomial(mode, surface, start) {
        return signal.first_crossing_from(direction, horizon, error).map(behind).map(Some);
    }
    let enclosure = |order, times| system.guard_enclosure(mode, surface, start, order, times);
    if enclosure(0, (0.0, 0.0)).is_none() {
        return Ok(None);
    }
    Enclosed { value, enclosure }.first_crossing(direction, horizon, error).map(behind).map(Some)
}

/// Ulps of its time that a crossing may be moved by: the square root of one, as between two roots so close that
/// they are hardly seen.
const MOST_ULPS: u64 = 1 << 27;

/// The first time from that of a crossing on at which the guard as the model has it is not before its surface
/// any more: a search that goes on from there does not find the crossing again.
fn behind(value: impl Fn(f64) -> f64, crossing: f64, rising: bool) -> f64 {
    let (mut time, mut step) = (crossing, 1u64);
    while (value(time) < 0.0) == rising && value(time) != 0.0 {
        if step > MOST_ULPS {
            return crossing;
        }
        time = f64::from_bits(time.to_bits() + step);
        step *= 2;
    }
    time
}

/// How much a rounding of each component, relative to its `size`, changes a guard: what a guard that is zero
/// may show instead.
pub(crate) fn rounding_at<const N: usize>(
    state: &State<N>,
    size: &State<N>,
    guard: impl Fn(&State<N>) -> f64,
) -> f64 {
    let value = guard(state);
    let change = |axis: usize| {
        let mut moved = *state;
        moved[axis] += 2.0 * f64::EPSILON * size[axis];
        (guard(&moved) - value).abs()
    };
    let sum: f64 = (0..N).map(change).sum();
    if sum.is_finite() { 2.0 * sum } else { 0.0 }
}

/// The first crossing, and the place in the list, of the guards `watched`, by samples.
fn sampled_crossing<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    horizon: f64,
    interval: f64,
    watched: &[usize],
) -> Result<Option<(f64, usize)>, Error>
where
    T: HybridSystem<N> + ?Sized,
{
    if !(interval > 0.0) || !horizon.is_finite() || horizon + interval == horizon {
        return Err(Error::BadSamplingInterval { interval, horizon });
    }
    let guards = system.guards(mode);
    let mut watches: Vec<Watch<T::Surface>> = watched
        .iter()
        .map(|&index| {
            let value = system.guard_value(guards[index].surface, start);
            if !value.is_finite() {
                return Err(Error::NotFinite { at: 0.0, value });
            }
            Ok(Watch::new(guards[index], value))
        })
        .collect::<Result<_, _>>()?;
    let mut sample = 0u64;
    loop {
        sample += 1;
        let time = (sample as f64 * interval).min(horizon);
        let state = system.flow(mode, start, time);
        let mut earliest: Option<(f64, usize)> = None;
        for (watch, &index) in watches.iter_mut().zip(watched) {
            let surface = watch.guard.surface;
            let value = system.guard_value(surface, &state);
            if !value.is_finite() {
                return Err(Error::NotFinite { at: time, value });
            }
            let Some(bracket) = watch.advance(time, value, interval)? else { continue };
            let along = |t: f64| system.guard_value(surface, &system.flow(mode, start, t));
            let at = bracketed_root(along, bracket.0, bracket.1)?;
            let at = beyond(along, at, bracket.1, value);
            if earliest.is_none_or(|(best, _)| sooner(at, best)) {
                earliest = Some((at, index));
            }
        }
        if earliest.is_some() || time >= horizon {
            return Ok(earliest);
        }
    }
}

/// The first time from `root` on at which the guard has the sign it has at `right`: an execution
/// that goes on from there does not cross again.
pub(crate) fn beyond(along: impl Fn(f64) -> f64, root: f64, right: f64, at_right: f64) -> f64 {
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
