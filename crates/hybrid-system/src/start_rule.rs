//! What happens at the start of an arc on a surface or beyond it?
//!
//! The start is the initial state of an execution, or the state after a jump. For each guard:
//!
//! | value of the guard at the start | switch | observer |
//! |---|---|---|
//! | zero within its error, leaves to the side of the event | an event at once | no event |
//! | zero within its error, leaves to the side of the flow, or stays zero | no event | no event |
//! | zero within its error, the side is hidden by rounding | an error | an error |
//! | beyond the surface | an event at once; an error at the initial state | no event |
//! | on the side of the flow | no event | no event |
//!
//! A guard that counts both ways has no side beyond its surface. Where it leaves to is no event, with one exception, also
//! for observers: if the surface was reached at the same instant as the surface of the last event, and the reset of that
//! event lets the state pass through, that is an event. No crossing is lost between two resets.

use crate::crossing::{Certainty, Departure, GuardedFlow, Leaving, departure, guard_rounding};
use crate::error::Error;
use crate::guard::{Direction, Guard, Role};
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};
use smallvec::SmallVec;

/// Guards of one mode that are handled without allocating. Most models have fewer.
const FEW: usize = 8;

/// A list of guards on whose surfaces an arc starts.
pub(crate) type LeavingGuards<S> = SmallVec<[Leaving<S>; FEW]>;

/// A surface that was reached at the same instant as the surface of the last event.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Reached<S> {
    pub(crate) surface: S,
    /// The sign of the guard before.
    pub(crate) from: f64,
}

/// How an arc starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Start<S> {
    /// With an event at once.
    Event { surface: S, certainty: Certainty },
    /// The mode flows.
    Flows,
}

/// How the state came to the start of an arc by a crossing.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Arrival<S, X> {
    /// The surface that was crossed; `None` at a limit, where no event is.
    surface: Option<S>,
    /// The state before the reset.
    before: X,
    /// The state earlier by the error of the time of the crossing.
    earlier: X,
    /// The other surfaces that were reached at the same instant and that only count if the state passes through.
    reached: SmallVec<[Reached<S>; FEW]>,
}

/// The lookback from a crossing, in errors of its time. The error counts in both directions: two crossings whose times
/// differ by the sum of their errors may be at the same instant. A larger number would join events that are distinct.
const LOOKBACK: f64 = 2.0;

impl<S: Copy + PartialEq, X: StateVector> Arrival<S, X> {
    /// The arrival at `surface` in the state `before`, at the end of an arc of this duration.
    pub(crate) fn new<T>(
        arc: &FlowFrom<T>,
        surface: Option<S>,
        before: &X,
        (duration, time_error): (f64, f64),
    ) -> Self
    where
        T: HybridSystem<State = X, Surface = S>,
    {
        let lookback = LOOKBACK * time_error;
        let field = arc.vector_field(before);
        let earlier = match &field {
            Some(field) => {
                let mut earlier = before.clone();
                earlier.add_scaled(-lookback, field);
                earlier
            }
            None => arc.state((duration - lookback).max(0.0)),
        };
        let mut arrival =
            Arrival { surface, before: before.clone(), earlier, reached: SmallVec::new() };
        let both_ways = |guard: &&Guard<S>| {
            guard.role == Role::Observer
                || guard.role == Role::Switch && guard.direction == Direction::Either
        };
        for guard in
            arc.guards().iter().filter(both_ways).filter(|guard| Some(guard.surface) != surface)
        {
            let value = |state: &X| arc.guard_value(guard.surface, state);
            let rounding = guard_rounding(before, before, value);
            if !(value(before).abs() <= arrival.change(value) + rounding) {
                continue;
            }
            // The side from which the guard comes: by its rate, or by its value at the start of the arc.
            let rate = field
                .as_ref()
                .and_then(|f| crate::crossing::guard_rate(before, f, rounding, value));
            let from = rate.map_or_else(|| value(arc.start), |rate| -rate);
            if guard.direction.admits(from, -from) {
                arrival.reached.push(Reached { surface: guard.surface, from: from.signum() });
            }
        }
        arrival
    }

    /// The surface that was crossed.
    pub(crate) fn surface(&self) -> Option<S> {
        self.surface
    }

    /// The state before the reset.
    pub(crate) fn before(&self) -> &X {
        &self.before
    }

    /// The change of a guard within the error of the time of the crossing.
    fn change(&self, guard: impl Fn(&X) -> f64) -> f64 {
        (guard(&self.earlier) - guard(&self.before)).abs()
    }

    /// The error of a guard at `state` after the reset, by the error of the time of the crossing. The guard of the crossed
    /// surface is zero by construction, if the reset has not changed it.
    fn error_after(&self, surface: S, state: &X, guard: impl Fn(&X) -> f64) -> f64 {
        let value = guard(state);
        let change = self.change(&guard);
        if Some(surface) == self.surface && value == guard(&self.before) {
            change.max(value.abs())
        } else {
            change
        }
    }

    /// True if all components of its states are finite.
    #[cfg(feature = "serde")]
    pub(crate) fn is_finite(&self) -> bool {
        self.before.is_finite() && self.earlier.is_finite()
    }

    /// This surface is no longer one that was reached at the same instant: its event has happened.
    pub(crate) fn passed(&mut self, surface: S) {
        self.reached.retain(|reached| reached.surface != surface);
    }
}

/// The start of an arc: an event at once, or a flow. `leaving` becomes the list of the guards on whose surfaces it starts.
///
/// `arrival` is the crossing before the arc, at the same instant; `initial` is true at the start of an execution.
///
/// # Errors
/// [`Error::StartsBeyond`], [`Error::NotFinite`] for a guard without a value, and errors if rounding hides to which side a
/// guard leaves its surface.
pub(crate) fn start_of_arc<T: HybridSystem>(
    flow: &FlowFrom<T>,
    arrival: Option<&Arrival<T::Surface, T::State>>,
    initial: bool,
    horizon: f64,
    leaving: &mut LeavingGuards<T::Surface>,
) -> Result<Start<T::Surface>, Error> {
    leaving.clear();
    for guard in flow.guards().iter().filter(|guard| guard.role != Role::Clock) {
        let Guard { surface, direction, role, .. } = *guard;
        let value = |state: &T::State| flow.guard_value(surface, state);
        let now = value(flow.start);
        if !now.is_finite() {
            return Err(Error::NotFinite { at: 0.0, value: now });
        }
        let own = flow.guard_error(surface, flow.start).unwrap_or(0.0);
        let rounding = guard_rounding(flow.start, flow.start, value) + own;
        let by_time =
            arrival.map_or(0.0, |arrival| arrival.error_after(surface, flow.start, value));
        let error = rounding + by_time;
        let reached = arrival
            .and_then(|arrival| arrival.reached.iter().find(|reached| reached.surface == surface));
        let switch = role == Role::Switch;
        let (side, certainty, on_surface) = if now.abs() > error {
            (now.signum(), Certainty::Certain, false)
        } else {
            match departure(flow, surface, error, horizon)? {
                Departure::To { side, certainty } => (side, certainty, true),
                Departure::Stays => continue,
            }
        };
        let passes = reached.is_some_and(|reached| direction.admits(reached.from, side));
        if passes || switch && direction.is_beyond(side) {
            if initial && !on_surface {
                return Err(Error::StartsBeyond {
                    mode: format!("{:?}", flow.mode),
                    surface: format!("{surface:?}"),
                    value: now,
                    rounding: error,
                });
            }
            return Ok(Start::Event { surface, certainty });
        }
        if on_surface {
            leaving.push(Leaving { surface, side });
        }
    }
    Ok(Start::Flows)
}
