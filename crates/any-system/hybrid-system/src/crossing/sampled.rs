//! Guards known by their values only: a change of sign between two samples.

use super::candidate::Candidate;
use super::clear_distance::clear_distance;
use super::guard_rounding::{rounding_beside_zero, rounding_of_state};
use super::guarded_flow::GuardedFlow;
use super::search_request::Search;
use crate::error::Error;
use crate::guard::{Guard, Touch};
use crate::looked::Looked;
use interval_arithmetic::root_beyond;
use smallvec::SmallVec;
use std::fmt::Debug;

/// Most samples of one search, unless the budget of steps is smaller: a limit for a search that would take days. At
/// some 30 ns for a flow in closed form these samples take half a minute. The search then ends unfinished, and can
/// go on. A smaller number would end searches that a user is willing to wait for.
const MOST_SAMPLES: u64 = 1_000_000_000;

/// The rounding of a guard's own arithmetic is measured this far from a zero, in units of the sampling interval:
/// far enough that a jump at the zero does not count, and near enough that the guard has terms of the same size.
const BESIDE: f64 = 1e-4;

/// Guards without a value that are kept without allocating.
const FEW: usize = 4;

/// Most halvings of the first sampling interval, down to 2⁻⁵² of it. They look for a time in a flight that starts
/// on the surface and ends before the first sample. A larger number would find shorter flights. A guard of ordinary
/// rate and bend is hidden by rounding in a flight that short.
const MOST_HALVINGS: u32 = 52;

/// The result of a search by samples.
pub(crate) struct SampledEvent {
    /// The first event.
    pub(crate) first: Option<Candidate>,
    /// The time at which the budget of samples ended, if it did.
    pub(crate) unfinished: Option<f64>,
}

/// The first event of the guards with these indices, up to `until`.
///
/// # Errors
/// [`Error::BadSamplingInterval`] if the samples would not advance to the end; [`Error::NotFinite`] for a guard that is
/// not finite at a sample, unless another one has its event before; [`Error::UndecidedStart`] as for
/// [`SampledGuard::advance`], and for a flight before the first sample that rounding hides.
pub(crate) fn sampled_event<F: GuardedFlow>(
    flow: &F,
    search: &Search<F::Surface>,
    (until, interval): (f64, f64),
    indices: &[usize],
) -> Result<SampledEvent, Error> {
    // The last condition: samples at an interval below an ulp of the end would never reach it.
    if !(interval > 0.0) || !until.is_finite() || until + interval == until {
        return Err(Error::BadSamplingInterval { interval, horizon: until });
    }
    let guards = flow.guards();
    let mut sampled: Vec<SampledGuard<F::Surface>> = indices
        .iter()
        .map(|&index| {
            let guard = guards[index];
            let value = flow.guard_value(guard.surface, flow.start());
            if !value.is_finite() {
                return Err(Error::NotFinite { at: 0.0, value });
            }
            let known = search.side(guard.surface);
            let side = known.unwrap_or(value).signum();
            // A guard that stays at a zero has the value of that zero as long as it does.
            let stays = known.map_or(value == 0.0, |side| side == 0.0);
            let level = if stays { value } else { 0.0 };
            Ok(SampledGuard {
                guard,
                side: (!stays).then_some(side),
                level,
                leaves: known.filter(|side| *side != 0.0).map(|_| value.abs()),
                hidden: search.hidden(guard.surface),
                since: 0.0,
                zero: None,
            })
        })
        .collect::<Result<_, _>>()?;
    let budget = u64::try_from(search.steps).unwrap_or(u64::MAX).min(MOST_SAMPLES);
    let mut time = 0.0;
    for sample in 1..=budget {
        // A product instead of a sum: rounding does not accumulate over many samples.
        time = (sample as f64 * interval).min(until);
        let state = flow.state(time);
        let mut first: Option<Candidate> = None;
        let mut undefined = SmallVec::<[(F::Surface, f64, f64); FEW]>::new();
        for (guard, &index) in sampled.iter_mut().zip(indices) {
            let surface = guard.guard.surface;
            let value = flow.guard_value(surface, &state);
            if !value.is_finite() {
                undefined.push((surface, value, guard.side.unwrap_or(0.0)));
                continue;
            }
            if time < guard.hidden {
                continue;
            }
            let rounding = || flow.rounding_at(surface, &state);
            let found = match guard.advance(time, value, rounding, interval)? {
                Sample::Quiet => continue,
                Sample::Touch { time } => {
                    Candidate { time, error: interval, index, touch: Some(0.0), from: None }
                }
                Sample::Crossing { left, right, side } => {
                    let (time, error) = crossing(flow, surface, (left, right), side, interval)?;
                    Candidate { time, error, index, touch: None, from: Some(side) }
                }
                Sample::ThroughZeros { since, zero, beyond, side } => {
                    let time = end_of_zeros(flow, surface, zero, beyond);
                    Candidate { time, error: time - since, index, touch: None, from: Some(side) }
                }
            };
            if first.is_none_or(|first| found.is_sooner_than(&first)) {
                first = Some(found);
            }
        }
        // A guard need not be defined behind an event.
        let is_defined_before = |surface, side| {
            first.is_some_and(|first| flow.guard_at(surface, first.time) * side > 0.0)
        };
        let without =
            undefined.iter().find(|(surface, _, side)| !is_defined_before(*surface, *side));
        if let Some((_, value, _)) = without {
            return Err(Error::NotFinite { at: time, value: *value });
        }
        // A guard that is zero at the end has no later sample. It has reached its surface there.
        if time >= until && first.is_none() {
            for (guard, &index) in sampled.iter().zip(indices) {
                if let (Some(side), Some((zero, _))) = (guard.side, guard.zero)
                    && zero > 0.0
                    && guard.leaves.is_none()
                    && guard.guard.direction.admits(side, -side)
                {
                    let error = 2.0 * f64::EPSILON * zero;
                    first =
                        Some(Candidate { time: zero, error, index, touch: None, from: Some(side) });
                    break;
                }
            }
        }
        if first.is_some() || time >= until {
            return Ok(SampledEvent { first, unfinished: None });
        }
    }
    Ok(SampledEvent { first: None, unfinished: Some(time) })
}

/// The crossing between two times, coming from `side`, with its error.
fn crossing<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    (left, right): (f64, f64),
    side: f64,
    interval: f64,
) -> Result<(f64, f64), Error> {
    let value = |time: f64| flow.guard_at(surface, time);
    let Some(((left, at_left), (right, at_right))) = bracket(flow, surface, (left, right), side)
    else {
        let looked = Looked::Sampled;
        return Err(Error::UndecidedStart { surface: format!("{surface:?}"), interval, looked });
    };
    let time = root_beyond(&value, (left, at_left), (right, at_right))?;
    let guard = |state: &F::State| flow.guard_value(surface, state);
    let reach = BESIDE * (right - left);
    let beside = [flow.state((time - reach).max(left)), flow.state((time + reach).min(right))];
    let stated = flow.guard_error(surface, &flow.state(time));
    let own = rounding_beside_zero(stated, [&beside[0], &beside[1]], &guard);
    let clear_at = |moved: f64| {
        let state = flow.state(moved);
        let rounding = own + rounding_of_state(&state, &state, &guard);
        // An end of the bracket is farther away than the zero, whatever its rounding.
        moved <= left || flow.guard_value(surface, &state).abs() > rounding
    };
    let clear = |distance: f64| clear_at(time - distance) && clear_at(time + distance);
    Ok((time, clear_distance(f64::EPSILON * time, right - left, clear)))
}

/// Two times with their values: on `side` at the first, and no longer at the second.
///
/// A guard that leaves its zero at the start may not have the sign of its side there yet. If it has come back
/// before the first sample, a time on its side lies in between. Halving from the sample towards the start finds
/// such a time for every flight of one hump: the halved times t/2ᵏ have one in the second half of the flight. A
/// side counts only where it is clear of rounding; `None` if there is no such time.
fn bracket<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    (left, right): (f64, f64),
    side: f64,
) -> Option<((f64, f64), (f64, f64))> {
    let value = |time: f64| flow.guard_at(surface, time);
    let (at_left, mut end) = (value(left), (right, value(right)));
    if at_left * side > 0.0 {
        return Some(((left, at_left), end));
    }
    let mut time = right;
    for _ in 0..MOST_HALVINGS {
        time = left + 0.5 * (time - left);
        let state = flow.state(time);
        let here = flow.guard_value(surface, &state);
        if here * side > flow.rounding_at(surface, &state) {
            return Some(((time, here), end));
        }
        // A time that rounding hides is no end of a bracket: the flight may be higher before it.
        if here * side <= 0.0 {
            end = (time, here);
        }
    }
    None
}

/// The end of a stretch of zeros: between the sample `zero` and the sample `beyond`, by halving.
fn end_of_zeros<F: GuardedFlow>(
    flow: &F,
    surface: F::Surface,
    mut zero: f64,
    mut beyond: f64,
) -> f64 {
    loop {
        let middle = zero + 0.5 * (beyond - zero);
        if !(middle > zero && middle < beyond) {
            return beyond;
        }
        match flow.guard_at(surface, middle) {
            0.0 => zero = middle,
            _ => beyond = middle,
        }
    }
}

/// What a sample shows.
enum Sample {
    /// No event.
    Quiet,
    /// The guard was zero at a sample, and came back to the side from which it came.
    Touch { time: f64 },
    /// The guard is crossed between two times, coming from `side`.
    Crossing { left: f64, right: f64, side: f64 },
    /// The guard was on its side at `since`, is exactly zero at several samples, the last of them `zero`, and is on the
    /// other side at `beyond`.
    ThroughZeros { since: f64, zero: f64, beyond: f64, side: f64 },
}

/// One guard, sampled from the start of an arc.
struct SampledGuard<S> {
    guard: Guard<S>,
    /// The side of the surface, ±1; `None` as long as the guard is zero since the start.
    side: Option<f64>,
    /// The value that counts as zero as long as `side` is `None`.
    level: f64,
    /// As long as no sample has shown that the guard has left its surface to this side: the size of its value at the
    /// start, which counts as zero.
    leaves: Option<f64>,
    /// Until then its signs are rounding.
    hidden: f64,
    /// The last sample at which the guard was on that side.
    since: f64,
    /// The first and the last of the samples since then, at all of which the guard is exactly zero.
    zero: Option<(f64, f64)>,
}

impl<S: Copy + Debug> SampledGuard<S> {
    /// Takes the next sample.
    ///
    /// | before | now | meaning |
    /// |---|---|---|
    /// | any | 0 | undecided until the next value that is not zero |
    /// | 0 since the start | 0 within rounding | the same |
    /// | a side that it leaves to, not seen yet | 0 within rounding | the same |
    /// | 0 since the start | beyond the surface of a switch | error: crossed at once, or gone and come back between two samples |
    /// | 0 since the start | before the surface | left the start, no crossing |
    /// | one side, with zeros in between | the same side | touch |
    /// | one side | other side, admitted | crossing |
    /// | one side, with several zeros in between | other side, admitted | crossing where the zeros end |
    fn advance(
        &mut self,
        time: f64,
        value: f64,
        rounding: impl Fn() -> f64,
        interval: f64,
    ) -> Result<Sample, Error> {
        let at_start = self.side.is_none();
        let value = if at_start { value - self.level } else { value };
        if value == 0.0 || at_start && value.abs() <= rounding() {
            self.zero = Some((self.zero.map_or(time, |zero| zero.0), time));
            return Ok(Sample::Quiet);
        }
        let now = value.signum();
        // Rounding of a sample just behind the start.
        if let Some(start) = self.leaves
            && self.side != Some(now)
            && value.abs() <= start.max(rounding())
        {
            return Ok(Sample::Quiet);
        }
        self.leaves = None;
        let (zero, since) = (self.zero.take(), std::mem::replace(&mut self.since, time));
        let Guard { surface, direction, touch, role } = self.guard;
        match self.side.replace(now) {
            None if role.bounds_flow() && direction.is_beyond(value) => {
                let (surface, looked) = (format!("{surface:?}"), Looked::Sampled);
                Err(Error::UndecidedStart { surface, interval, looked })
            }
            Some(side)
                if direction.admits(side, now) && zero.is_some_and(|zero| zero.0 < zero.1) =>
            {
                let last = zero.map_or(since, |zero| zero.1);
                Ok(Sample::ThroughZeros { since, zero: last, beyond: time, side })
            }
            // A sample that is exactly zero is the first root. With this sample as right end the bracket returns
            // it; the root finder could return a later one otherwise.
            Some(side) if direction.admits(side, now) => {
                Ok(Sample::Crossing { left: since, right: zero.map_or(time, |zero| zero.0), side })
            }
            Some(side) if side == now && touch != Touch::Ignore => {
                Ok(zero.map_or(Sample::Quiet, |zero| Sample::Touch { time: zero.0 }))
            }
            _ => Ok(Sample::Quiet),
        }
    }
}
