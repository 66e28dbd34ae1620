//! How the state came to the start of an arc: by a crossing, whose time has an error.

mod beyond_jump;
mod side_before;

use crate::crossing::{GuardedFlow, Leaving, LeavingGuards};
use crate::guard::{Direction, Guard, Role};
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};
use smallvec::SmallVec;

/// Surfaces that are reached together without allocating.
const FEW: usize = 4;

/// The lookback from a crossing, in roundings of its time. The rounding counts in both directions: two crossings
/// whose times differ by the sum of their roundings may be at the same instant. A larger number would join events
/// that are distinct.
const LOOKBACK: f64 = 2.0;

/// Each further look back is so many times longer, up to the start of the arc: some ten looks. A smaller number
/// would take more looks; a larger one could pass over a short stay on the other side.
const LONGER: f64 = 8.0;

/// Parts of an arc at which a guard is looked at that has left its surface. A periodic motion is back at one of
/// them, and not at all of them.
pub(crate) const PLACES: [f64; 3] = [0.5, 0.3, 0.8];

/// The part of an arc over which its field is straight enough to look back along it: the bend of 10⁻⁶ of an arc is
/// 10⁻¹² of it.
const NEAR: f64 = 1e-6;

/// The duration of an arc, with its errors.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DurationOfArc {
    pub(crate) duration: f64,
    /// Time from the last event to the start of the arc, if stops are in between.
    pub(crate) since_event: f64,
    /// By rounding.
    pub(crate) time_rounding: f64,
    /// From the true duration.
    pub(crate) time_error: f64,
    /// True if the model itself has solved for the crossing.
    pub(crate) solved: bool,
    /// The side from which the crossed guard comes, if the search knows it.
    pub(crate) from: Option<f64>,
}

impl DurationOfArc {
    /// A duration that a clock or a limit gives.
    pub(crate) fn given(duration: f64, since_event: f64) -> Self {
        DurationOfArc {
            duration,
            since_event,
            time_rounding: 0.0,
            time_error: 0.0,
            solved: false,
            from: None,
        }
    }
}

/// A surface that was reached at the instant of an event of another one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
struct Reached<S> {
    surface: S,
    /// The side from which its guard came, ±1.
    from: f64,
    /// True as soon as it has had its own event.
    has_passed: bool,
}

/// The end of the last arc, as long as no time has passed since.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Arrival<M, S, X> {
    /// The surface that was crossed; `None` at a limit, where no event is.
    surface: Option<S>,
    /// True if the guard has touched the surface, and not crossed it.
    touched: bool,
    /// True if the guard has jumped over its surface, or has a pole there: its value is no error.
    guard_jumps: bool,
    /// The side from which the guard of this surface came, ±1; 0 if there is none.
    from: f64,
    /// The state before the reset.
    before: X,
    /// Mode, start and duration of the arc.
    mode: M,
    start: X,
    duration: f64,
    /// Time from the last event to the start of the arc.
    since_event: f64,
    /// The error of the duration by rounding.
    time_rounding: f64,
    /// The distance of the duration from that of the true trajectory.
    time_error: f64,
    /// True if the model itself has solved for the crossing: then the signs of other guards at its end are rounding.
    solved: bool,
    /// The guards on whose surfaces the arc started.
    leaving: LeavingGuards<S>,
    /// Other surfaces that were reached at the same instant.
    reached: SmallVec<[Reached<S>; FEW]>,
    /// True after a Zeno limit: no flow of one mode has led to it.
    after_zeno: bool,
}

impl<M: Copy, S: Copy + PartialEq, X: StateVector> Arrival<M, S, X> {
    /// The arrival at `surface` in the state `before`, at the end of an arc of this duration.
    pub(crate) fn new<T>(
        arc: &FlowFrom<T>,
        surface: Option<S>,
        before: &X,
        (length, leaving): (DurationOfArc, LeavingGuards<S>),
    ) -> Self
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let DurationOfArc { duration, since_event, time_rounding, time_error, solved, from } =
            length;
        let mut arrival = Arrival {
            surface,
            touched: false,
            guard_jumps: false,
            from: 0.0,
            before: before.clone(),
            mode: arc.mode,
            start: arc.start.clone(),
            duration,
            since_event,
            time_rounding,
            time_error,
            solved,
            leaving,
            reached: SmallVec::new(),
            after_zeno: false,
        };
        let crossed = arc.guards().iter().find(|guard| Some(guard.surface) == surface);
        arrival.from = match crossed.map(|guard| guard.direction) {
            Some(Direction::Rising) => -1.0,
            Some(Direction::Falling) => 1.0,
            Some(Direction::Either) => from.unwrap_or(0.0),
            None => 0.0,
        };
        let is_other =
            |guard: &&Guard<S>| guard.role != Role::Clock && Some(guard.surface) != surface;
        for guard in arc.guards().iter().filter(is_other) {
            let from = if solved {
                arrival.side_by_rounding(arc, guard.surface)
            } else {
                arrival.side_before(arc, guard)
            };
            if let Some(from) = from.filter(|from| guard.direction.admits(*from, -from)) {
                let (surface, from) = (guard.surface, from.signum());
                arrival.reached.push(Reached { surface, from, has_passed: false });
            }
        }
        arrival
    }

    /// The arrival at a Zeno limit in this state. These surfaces have been passed within its error, each from a side.
    pub(crate) fn at_zeno(mode: M, state: &X, time_error: f64, passed: Vec<(S, f64)>) -> Self {
        let reached = |(surface, from)| Reached { surface, from, has_passed: false };
        Arrival {
            surface: None,
            touched: false,
            guard_jumps: false,
            from: 0.0,
            before: state.clone(),
            mode,
            start: state.clone(),
            duration: 0.0,
            since_event: 0.0,
            time_rounding: 0.0,
            time_error,
            solved: false,
            leaving: LeavingGuards::new(),
            reached: passed.into_iter().map(reached).collect(),
            after_zeno: true,
        }
    }

    /// True if the same flow goes on: the event has changed neither the mode nor the state.
    pub(crate) fn continues<T>(&self, next: &FlowFrom<T>) -> bool
    where
        M: PartialEq,
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        !self.after_zeno && self.mode == next.mode && self.before == *next.start
    }

    /// The side to which the guard of this surface has passed, ±1, if it was crossed.
    pub(crate) fn passed_to(&self, surface: S) -> Option<f64> {
        if Some(surface) == self.surface {
            return (!self.touched && self.from != 0.0).then_some(-self.from);
        }
        let reached = self.reached.iter().find(|reached| reached.surface == surface);
        reached.filter(|reached| reached.has_passed).map(|reached| -reached.from)
    }

    /// A guard that was leaving its surface when the arc began, if rounding still hides whether it has: by the time at
    /// which it was first seen, or by its value `now`, at the end. Signs of rounding are no further zeros.
    pub(crate) fn still_leaves<T>(
        &self,
        next: &FlowFrom<T>,
        surface: S,
        now: f64,
    ) -> Option<Leaving<S>>
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let left = self.leaving.iter().find(|left| left.surface == surface && !left.ahead)?;
        if left.hidden > self.duration {
            return Some(Leaving { hidden: left.hidden - self.duration, ..*left });
        }
        let is_other = left.side != 0.0 && now * left.side <= 0.0;
        let is_hidden = || now.abs() <= next.rounding_at(surface, next.start);
        let arc = FlowFrom { system: next.system, mode: self.mode, start: &self.start };
        (is_other && is_hidden() && self.has_stayed(&arc, surface))
            .then_some(Leaving { hidden: 0.0, ..*left })
    }

    /// The side from which the crossed guard came, ±1; 0 if nothing was crossed.
    pub(crate) fn from(&self) -> f64 {
        self.from
    }

    /// True if the zero of a guard, whose value at the start of `next` is `now`, is still ahead, although rounding
    /// may hide it: the flow has come next to the surface, and the reset has not moved the guard.
    pub(crate) fn is_ahead<T>(
        &self,
        next: &FlowFrom<T>,
        surface: S,
        (now, rounding): (f64, f64),
    ) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let before = next.guard_value(surface, &self.before);
        // A contact at which the bounces have ended is no event that is still to come.
        let has_led = || {
            next.guards().iter().any(|guard| guard.surface == surface && guard.role.bounds_flow())
        };
        if self.solved
            || self.after_zeno && has_led()
            || Some(surface) == self.surface
            || !(before * now > 0.0)
            || (now - before).abs() > rounding
        {
            return false;
        }
        let arc = FlowFrom { system: next.system, mode: self.mode, start: &self.start };
        if !arc.guards().iter().any(|guard| guard.surface == surface) {
            return false;
        }
        // A guard that has left its surface to the other side, and has not come there yet, has had its zero.
        let left = self.leaving.iter().find(|leaving| leaving.surface == surface && !leaving.ahead);
        left.is_none_or(|left| left.side * now > 0.0 || self.has_left(&arc, surface, left.side))
    }

    /// The rounding of the time of the arrival, and its distance from the true time.
    pub(crate) fn errors(&self) -> (f64, f64) {
        (self.time_rounding, self.time_error)
    }

    /// Notes that the guard jumps at the surface, or has a pole there.
    pub(crate) fn note_guard_jumps(&mut self) {
        self.guard_jumps = true;
    }

    /// The arrival at a touch in place of a crossing.
    pub(crate) fn by_touch(mut self) -> Self {
        self.touched = true;
        self
    }

    /// True if the guard of this surface has touched it, and the reset has not changed the guard: it goes back to
    /// the side from which it came, although its rate at the time of the touch may still lead to the surface.
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

    /// The duration of the arc; infinite after a Zeno limit, whose arcs are shorter than any.
    pub(crate) fn duration(&self) -> f64 {
        if self.after_zeno { f64::INFINITY } else { self.duration }
    }

    /// The time since the event before, stops in between included.
    pub(crate) fn flight(&self) -> f64 {
        self.since_event + self.duration
    }

    /// The largest component at the start of the arc. On this scale the error of the arrival is small: an arc that
    /// ends near the origin is wrong by rounding of the numbers that it began with.
    pub(crate) fn size(&self) -> f64 {
        self.start.largest()
    }

    /// The state before the reset; `None` after a Zeno limit.
    pub(crate) fn before(&self) -> Option<&X> {
        (!self.after_zeno).then_some(&self.before)
    }

    /// True if a surface was reached at the same instant, and has not had its event.
    pub(crate) fn has_pending(&self) -> bool {
        self.reached.iter().any(|reached| !reached.has_passed)
    }

    /// The sign that the guard of this surface had before, if the surface was reached at the same instant.
    pub(crate) fn came_from(&self, surface: S) -> Option<f64> {
        let mut ahead = self.reached.iter().filter(|reached| !reached.has_passed);
        ahead.find(|reached| reached.surface == surface).map(|reached| reached.from)
    }

    /// The error of a guard after the reset, at the start of `next`, by the error of the time of the crossing. The
    /// guard of the crossed surface is zero by construction, if the reset has not changed it.
    pub(crate) fn error_after<T>(&self, next: &FlowFrom<T>, surface: S) -> f64
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let value = next.guard_value(surface, next.start);
        let (_, change) = self.earlier(next.system, surface);
        let same = || value == next.guard_value(surface, &self.before);
        let on_surface = Some(surface) == self.surface && !self.guard_jumps;
        if on_surface && same() && !self.is_beyond_jump(next) {
            change.max(value.abs())
        } else {
            change
        }
    }

    /// The value of a guard before the rounding of the time of the crossing, and the change within it.
    ///
    /// The smaller one of the changes over two neighbouring stretches of time counts: a jump is in one of them
    /// only, and its height is no error.
    fn earlier<T>(&self, system: &T, surface: S) -> (f64, f64)
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let lookback = LOOKBACK * self.time_rounding;
        let value = |state: &X| system.guard_value(surface, state);
        let now = value(&self.before);
        if lookback == 0.0 {
            return (now, 0.0);
        }
        let at = |lookback: f64| value(&self.state_before(system, lookback));
        let (earlier, change) = (at(lookback), |a: f64, b: f64| (a - b).abs());
        // In a shorter arc there is no second stretch.
        if self.duration < 2.0 * lookback {
            return (earlier, change(earlier, now));
        }
        (earlier, change(earlier, now).min(change(at(2.0 * lookback), earlier)))
    }

    /// The state a moment before the end of the arc, along its field, or by its flow.
    fn state_before<T>(&self, system: &T, lookback: f64) -> X
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        if lookback < NEAR * self.duration
            && let Some(field) = system.vector_field(self.mode, &self.before)
        {
            let mut earlier = self.before.clone();
            earlier.add_scaled(-lookback, &field);
            return earlier;
        }
        system.flow(self.mode, &self.start, (self.duration - lookback).max(0.0))
    }

    /// A surface that was reached at the same instant has had its event.
    pub(crate) fn passed(&mut self, surface: S) {
        for reached in self.reached.iter_mut().filter(|reached| reached.surface == surface) {
            reached.has_passed = true;
        }
    }
}

#[cfg(feature = "serde")]
impl<M, S, X: StateVector> Arrival<M, S, X> {
    /// Its states.
    pub(crate) fn states(&self) -> [&X; 2] {
        [&self.before, &self.start]
    }
}
