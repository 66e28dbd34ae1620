//! How the state came to the start of an arc: by a crossing, whose time has an error.

use crate::crossing::{GuardedFlow, guard_rate};
use crate::guard::{Direction, Guard, Role};
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};
use smallvec::SmallVec;

/// Surfaces that are reached together without allocating.
const FEW: usize = 4;

/// The lookback from a crossing, in errors of its time. The error counts in both directions: two crossings whose times
/// differ by the sum of their errors may be at the same instant. A larger number would join events that are distinct.
const LOOKBACK: f64 = 2.0;

/// The end of the last arc, as long as no time has passed since.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Arrival<M, S, X> {
    /// The surface that was crossed; `None` at a limit, where no event is.
    surface: Option<S>,
    /// True if the guard has touched the surface, and not crossed it.
    touched: bool,
    /// The state before the reset.
    before: X,
    /// Mode, start and duration of the arc.
    mode: M,
    start: X,
    duration: f64,
    /// The error of the duration.
    time_error: f64,
    /// Other surfaces that were reached at the same instant, with the sides from which the guards came. Only surfaces that
    /// have no side beyond are listed: for the others the state after the reset decides.
    reached: SmallVec<[(S, f64); FEW]>,
}

impl<M: Copy, S: Copy + PartialEq, X: StateVector> Arrival<M, S, X> {
    /// The arrival at `surface` in the state `before`, at the end of an arc of this duration.
    pub(crate) fn new<T>(
        arc: &FlowFrom<T>,
        surface: Option<S>,
        before: &X,
        (duration, time_error): (f64, f64),
    ) -> Self
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let mut arrival = Arrival {
            surface,
            touched: false,
            before: before.clone(),
            mode: arc.mode,
            start: arc.start.clone(),
            duration,
            time_error,
            reached: SmallVec::new(),
        };
        let both_ways = |guard: &&Guard<S>| {
            guard.role == Role::Observer
                || guard.role == Role::Switch && guard.direction == Direction::Either
        };
        let others = arc.guards().iter().filter(both_ways);
        for guard in others.filter(|guard| Some(guard.surface) != surface) {
            let value = |state: &X| arc.guard_value(guard.surface, state);
            let rounding = arc.rounding_at(guard.surface, before);
            if !(value(before).abs() <= arrival.change(arc.system, guard.surface) + rounding)
                || arrival.has_stayed(arc, guard.surface)
            {
                continue;
            }
            // The side from which the guard comes: by its rate, or by its value at the start of the arc.
            let rate = arc
                .vector_field(before)
                .and_then(|field| guard_rate(before, &field, rounding, value));
            let from = rate.map_or_else(|| value(arc.start), |rate| -rate);
            if guard.direction.admits(from, -from) {
                arrival.reached.push((guard.surface, from.signum()));
            }
        }
        arrival
    }

    /// The same for a touch.
    pub(crate) fn by_touch(mut self) -> Self {
        self.touched = true;
        self
    }

    /// True if the guard of this surface has touched it, and the reset has not changed the guard: it goes back to the side
    /// from which it came, although its rate at the time of the touch may still lead to the surface.
    pub(crate) fn has_touched<T>(&self, next: &FlowFrom<T>, surface: S) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let value = |state: &X| next.guard_value(surface, state);
        self.touched && Some(surface) == self.surface && value(next.start) == value(&self.before)
    }

    /// The surface that was crossed.
    pub(crate) fn surface(&self) -> Option<S> {
        self.surface
    }

    /// The duration of the arc.
    pub(crate) fn duration(&self) -> f64 {
        self.duration
    }

    /// The largest component at the start of the arc. On this scale the error of the arrival is small: an arc that ends near
    /// the origin is wrong by rounding of the numbers that it began with.
    pub(crate) fn size(&self) -> f64 {
        self.start.largest()
    }

    /// The state before the reset.
    pub(crate) fn before(&self) -> &X {
        &self.before
    }

    /// The sign that the guard of this surface had before, if the surface was reached at the same instant and has no side
    /// beyond.
    pub(crate) fn came_from(&self, surface: S) -> Option<f64> {
        self.reached.iter().find(|reached| reached.0 == surface).map(|reached| reached.1)
    }

    /// The error of a guard after the reset, at the start of `next`, by the error of the time of the crossing. The guard of
    /// the crossed surface is zero by construction, if the reset has not changed it.
    pub(crate) fn error_after<T>(&self, next: &FlowFrom<T>, surface: S) -> f64
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let value = next.guard_value(surface, next.start);
        let change = self.change(next.system, surface);
        if Some(surface) == self.surface && value == next.guard_value(surface, &self.before) {
            change.max(value.abs())
        } else {
            change
        }
    }

    /// True if a guard was on its surface at the start of the arc, and has not left it up to the end, as far as rounding
    /// shows: the arc was too short. Its event has been before this arc, or is still to come.
    fn has_stayed<T>(&self, arc: &FlowFrom<T>, surface: S) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let is_zero =
            |state: &X| arc.guard_value(surface, state).abs() <= arc.rounding_at(surface, state);
        is_zero(arc.start) && is_zero(&arc.state(0.5 * self.duration))
    }

    /// The change of a guard within the error of the time of the crossing.
    fn change<T>(&self, system: &T, surface: S) -> f64
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let lookback = LOOKBACK * self.time_error;
        if lookback == 0.0 {
            return 0.0;
        }
        let earlier = match system.vector_field(self.mode, &self.before) {
            Some(field) => {
                let mut earlier = self.before.clone();
                earlier.add_scaled(-lookback, &field);
                earlier
            }
            None => system.flow(self.mode, &self.start, (self.duration - lookback).max(0.0)),
        };
        let value = |state: &X| system.guard_value(surface, state);
        (value(&earlier) - value(&self.before)).abs()
    }

    /// This surface is no longer one that was reached at the same instant: its event has happened.
    pub(crate) fn passed(&mut self, surface: S) {
        self.reached.retain(|reached| reached.0 != surface);
    }
}

#[cfg(feature = "serde")]
impl<M, S, X: StateVector> Arrival<M, S, X> {
    /// True if all components of its states are finite.
    pub(crate) fn is_finite(&self) -> bool {
        self.before.is_finite() && self.start.is_finite()
    }
}
