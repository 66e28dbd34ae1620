//! The earliest event of all guards of a mode.

use super::candidate::Candidate;
use super::certainty::Certainty;
use super::guarded_flow::GuardedFlow;
use super::next_event::{Crossing, EventKind, NextEvent};
use super::one_guard::OneGuard;
use super::sampled::sampled_event;
use super::search_request::Search;
use super::under_bounds::event_under_bounds;
use crate::error::Error;
use crate::guard::{Role, Touch};
use smallvec::SmallVec;

/// Guards of one mode that are handled without allocating. Most models have fewer.
const FEW: usize = 8;

/// Rounding of the time itself, in ulps: the root lies between two neighbouring doubles, and the later one is returned.
const TIME_ULPS: f64 = 2.0;

/// The default search of [`HybridSystem::first_crossing`](crate::HybridSystem::first_crossing).
pub(crate) fn earliest_crossing<F: GuardedFlow>(
    flow: &F,
    search: &Search<F::Surface>,
) -> Result<NextEvent<F::Surface, F::State>, Error> {
    if !(search.horizon >= 0.0) {
        return Err(Error::BadLimit { what: "the horizon of a search", value: search.horizon });
    }
    let mut earliest: Option<Candidate> = None;
    // The search is complete up to this time.
    let mut until = search.horizon;
    let mut unfinished = false;
    let mut without_bounds = SmallVec::<[usize; FEW]>::new();
    let guards = flow.guards();
    for (index, &guard) in guards.iter().enumerate() {
        if guard.role == Role::Clock {
            continue;
        }
        let (time, error, touch, from) = match event_under_bounds(flow, guard, search, until)? {
            Some(OneGuard::Crossing { time, error, from }) => (time, error, None, from),
            Some(OneGuard::Touch { time, error, value }) => (time, error, Some(value), None),
            Some(OneGuard::BudgetEnded { time }) => {
                (until, unfinished) = (time, true);
                earliest = earliest.filter(|earliest| earliest.time <= time);
                continue;
            }
            Some(OneGuard::Quiet) => continue,
            None => {
                without_bounds.push(index);
                continue;
            }
        };
        let found =
            Candidate { time, error: error + TIME_ULPS * f64::EPSILON * time, index, touch, from };
        let found = found.or_same(earliest, flow);
        if earliest.is_none_or(|earliest| found.is_sooner_than(&earliest)) {
            // A guard that is searched later may come at the same instant: up to the sum of both errors later.
            until = until.min(time + 2.0 * found.error);
            earliest = Some(found);
        }
    }
    let mut certainty = Certainty::Certain;
    if let Some(&first) = without_bounds.first() {
        let surface = || format!("{:?}", guards[first].surface);
        let interval = search
            .sampling_interval
            .ok_or_else(|| Error::NoSamplingInterval { surface: surface() })?;
        // This holds even if a guard under bounds is crossed first: a crossing of a sampled guard before it may have
        // been missed.
        certainty = Certainty::Sampled { interval };
        let sampled = sampled_event(flow, search, (until, interval), &without_bounds)?;
        if let Some(time) = sampled.unfinished {
            (until, unfinished) = (time, true);
            earliest = earliest.filter(|earliest| earliest.time <= time);
        }
        if let Some(found) = sampled.first.map(|found| found.or_same(earliest, flow))
            && earliest.is_none_or(|earliest| found.is_sooner_than(&earliest))
        {
            earliest = Some(found);
        }
    }
    let Some(Candidate { time, error, index, touch, from }) = earliest else {
        return Ok(if unfinished {
            NextEvent::Unfinished { time: until, state: flow.state(until), certainty }
        } else {
            NextEvent::None { state: None, certainty }
        });
    };
    let surface = guards[index].surface;
    let kind = match touch {
        None => EventKind::Crossing,
        Some(_) if guards[index].touch == Touch::Event => EventKind::Touch,
        Some(value) => {
            return Err(Error::Grazing { surface: format!("{surface:?}"), time, value });
        }
    };
    let state = flow.state(time);
    // The computed trajectory is the model's own solution: its rounding is the only error.
    let (time_rounding, time_error) = (error, error);
    let crossing =
        Crossing { surface, time, time_rounding, time_error, state, kind, from, certainty };
    Ok(NextEvent::Crossing(crossing))
}
