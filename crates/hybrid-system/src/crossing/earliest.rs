//! The earliest crossing of all guards of a mode.

use super::certainty::Certainty;
use super::first_crossing::FirstCrossing;
use super::guarded_flow::GuardedFlow;
use super::next_event::{Crossing, EventKind, NextEvent};
use super::same_instant::sooner;
use super::sampled::sampled_crossing;
use super::search_request::Search;
use super::under_bounds::crossing_under_bounds;
use crate::error::Error;
use crate::guard::Role;

/// The error of a crossing in closed form, in ulps of its time. `bracketed_root` stops at a bracket of two ulps, and the
/// step past the root adds one or two.
const TIME_ULPS: f64 = 4.0;

/// The default search of [`HybridSystem::first_crossing`](crate::HybridSystem::first_crossing).
pub(crate) fn earliest_crossing<F: GuardedFlow>(
    flow: &F,
    search: &Search<F::Surface>,
) -> Result<NextEvent<F::Surface, F::State>, Error> {
    let horizon = search.horizon;
    // Times with the index of their guard in the list.
    let mut earliest: Option<(f64, usize)> = None;
    let mut grazing: Option<(f64, f64, usize)> = None;
    let mut without_bounds = Vec::new();
    let guards = flow.guards();
    for (index, &guard) in guards.iter().enumerate() {
        if guard.role == Role::Clock {
            continue;
        }
        match crossing_under_bounds(flow, horizon, guard)? {
            Some(FirstCrossing::At { time, .. })
                if earliest.is_none_or(|earliest| sooner(time, earliest.0)) =>
            {
                earliest = Some((time, index));
            }
            Some(FirstCrossing::Grazing { time, value })
                if grazing.is_none_or(|(first, ..)| time < first) =>
            {
                grazing = Some((time, value, index));
            }
            // A later crossing, a later grazing, or none.
            Some(_) => {}
            None => without_bounds.push(index),
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
        let until = earliest.map_or(horizon, |(time, _)| time);
        let sampled = sampled_crossing(flow, until, interval, &without_bounds)?;
        if let Some(found) = sampled
            && earliest.is_none_or(|earliest| found < earliest)
        {
            earliest = Some(found);
        }
    }
    // A grazing after the earliest crossing never happens: the reset comes before it.
    if let Some((time, value, index)) = grazing
        && earliest.is_none_or(|(first, _)| time <= first)
    {
        let surface = format!("{:?}", guards[index].surface);
        return Err(Error::Grazing { surface, time, value });
    }
    Ok(match earliest {
        Some((time, index)) => NextEvent::Crossing(Crossing {
            surface: guards[index].surface,
            time,
            time_error: TIME_ULPS * f64::EPSILON * time,
            state: flow.state(time),
            kind: EventKind::Crossing,
            certainty,
        }),
        None => NextEvent::None { state: None, certainty },
    })
}
