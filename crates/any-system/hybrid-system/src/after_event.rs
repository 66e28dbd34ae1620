//! What the start of the next arc must know about the event before it.

use crate::arrival::{Arrival, DurationOfArc, PLACES};
use crate::crossing::{EventKind, GuardedFlow, LeavingGuards};
use crate::execution::Execution;
use crate::guard::Direction;
use crate::next_event::flow_to;
use crate::solution::Place;
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};

/// The rate of a guard at its crossing is taken over this part of its flight, along the flow behind it. Over a shorter
/// part rounding would show, over a longer one the bend.
const NEXT_PART: f64 = 0.01;

/// A flight whose duration is wrong by so much of itself is lost. A larger number would take the next flights for what
/// they were without the error; a smaller one would give up a limit that is still known.
const LARGEST_PART: f64 = 0.25;

/// How far before and behind an event a guard is looked at, in errors of its time. There a guard that is continuous has
/// moved by as many times its value at the event.
const LOOK: f64 = 64.0;

/// The least of it that still counts as such a move: an eighth, for rates that change. A jump moves by nothing on one of
/// both sides, and a pole by less than its value on one.
const LEAST_MOVE: f64 = 8.0;

/// The state before an event, and mode and state after it, if the run goes on.
type BothSides<'x, T> = (&'x <T as HybridSystem>::State, Option<&'x Place<T>>);

impl<T: HybridSystem> Execution<'_, T> {
    /// Keeps what the start of the next arc must know about the event at the end of this one.
    pub(crate) fn remember(
        &mut self,
        (kind, surface): (EventKind, T::Surface),
        (state, after): BothSides<'_, T>,
        (length, leaving): (DurationOfArc, LeavingGuards<T::Surface>),
        time_passes: bool,
    ) {
        let passed = (kind == EventKind::Crossing).then_some(surface);
        self.forget_residues(passed, state, length.duration);
        let flow = FlowFrom { system: self.system, mode: self.at.mode, start: &self.at.state };
        let duration = length.duration;
        let arrival = |surface, length| Arrival::new(&flow, surface, state, (length, leaving));
        let guard = flow.guards().iter().find(|guard| guard.surface == surface);
        match kind {
            EventKind::Crossing => {
                let mut arrival = arrival(Some(surface), length);
                let residue = self.residue(surface, (state, after), length);
                if let (Some(guard), Some(value)) = (guard, residue) {
                    self.at.residues.push(guard, value, arrival.from());
                }
                // What a contact that jumps does after its event is told by the motion.
                let passes = guard.is_some_and(|guard| guard.direction == Direction::Either);
                if passes && residue.is_none() {
                    arrival.note_guard_jumps();
                }
                self.at.arrival = Some(arrival);
            }
            EventKind::Touch => {
                self.at.arrival = Some(arrival(Some(surface), length).by_touch());
            }
            // A guard that is on its surface at the preset time, before it has passed through it, must not lose its
            // event.
            EventKind::Clock if duration > 0.0 => {
                self.at.arrival = Some(arrival(
                    None,
                    DurationOfArc::given(duration, self.at.history.since_event),
                ));
            }
            EventKind::AtStart | EventKind::Clock => match &mut self.at.arrival {
                Some(arrival) if !time_passes => {
                    // The flow has moved the state beyond this surface, too, by rounding.
                    if let (Some(from), Some(guard)) = (arrival.came_from(surface), guard) {
                        self.at.residues.push(guard, flow.guard_value(surface, state), from);
                    }
                    arrival.passed(surface);
                }
                arrival => *arrival = None,
            },
        }
    }

    /// The value of a guard at its event, if that is the error of the event. A guard that jumps there, or has a pole, and whose
    /// flow goes on beyond its surface after the event, has left its surface.
    fn residue(
        &self,
        surface: T::Surface,
        (state, after): BothSides<'_, T>,
        length: DurationOfArc,
    ) -> Option<f64> {
        let flow = self.flow();
        let value = flow.guard_value(surface, state);
        // The usual case.
        if value.abs() <= LOOK * f64::EPSILON * state.largest() {
            return Some(value);
        }
        let look = self.look_time(length.time_error, length.duration);
        let [before, behind] = [-look, look].map(|time| {
            let beside = self.beside(state, (length.duration, time));
            flow.guard_value(surface, &beside)
        });
        let change = (before - value).abs().min((behind - value).abs());
        let is_far =
            LEAST_MOVE * value.abs() > change && value.abs() > flow.rounding_at(surface, state);
        let goes_on = || {
            after.is_none_or(|(mode, after)| {
                let next = FlowFrom { system: self.system, mode: *mode, start: after };
                let moved = match next.vector_field(after) {
                    Some(rate) => moved(after, &rate, look),
                    None => flow_to(&next, look),
                };
                next.guard_value(surface, &moved) * value > 0.0
            })
        };
        (!(is_far && goes_on())).then_some(value)
    }

    /// How far before and behind an event a guard is looked at.
    pub(crate) fn look_time(&self, time_error: f64, duration: f64) -> f64 {
        LOOK * time_error.max(f64::EPSILON * duration)
    }

    /// The state of the present flow beside that at a duration, so much later or earlier.
    pub(crate) fn beside(&self, state: &T::State, (duration, time): (f64, f64)) -> T::State {
        match self.system.vector_field(self.at.mode, state) {
            Some(rate) => moved(state, &rate, time),
            None => flow_to(&self.flow(), (duration + time).max(0.0)),
        }
    }

    /// Forgets the residues of earlier events that the state has left, at the end of an arc of this duration.
    pub(crate) fn forget_residues(
        &mut self,
        passed: Option<T::Surface>,
        state: &T::State,
        duration: f64,
    ) {
        let flow = FlowFrom { system: self.system, mode: self.at.mode, start: &self.at.state };
        let value = |surface| flow.guard_value(surface, state);
        let inside = |surface| match duration > 0.0 {
            true => PLACES.map(|part| flow.guard_value(surface, &flow.state(part * duration))),
            false => [0.0; 3],
        };
        let rounding = |surface| flow.rounding_at(surface, state);
        self.at.residues.keep(passed, value, rounding, inside);
    }

    /// Forgets what guards were on states of another dimension.
    pub(crate) fn forget_guards(&mut self) {
        self.at.history.clear();
        self.at.residues.clear();
        self.at.arrival = None;
    }

    /// The error of the time of an event by the rounding of the state at which a stop or an observer has divided its
    /// flight: near a Zeno limit the velocity is small, and the height as rounded. Zero for a flight that is not
    /// divided. A flight of which rounding hides a part that counts is lost, with all that would have come behind it.
    pub(crate) fn error_by_division(
        &self,
        surface: T::Surface,
        before: &T::State,
        duration: f64,
    ) -> f64 {
        let divided = self.at.history.since_event;
        if divided == 0.0 {
            return 0.0;
        }
        let flow = FlowFrom { system: self.system, mode: self.at.mode, start: before };
        let (flight, value) = (divided + duration, flow.guard_value(surface, before));
        let rate =
            (flow.guard_at(surface, NEXT_PART * flight) - value).abs() / (NEXT_PART * flight);
        // 0/0 for a guard that is zero all the time: the comparison drops NaN.
        let error = flow.rounding_at(surface, &self.at.state) / rate;
        if error < LARGEST_PART * flight {
            return error;
        }
        flight.max(self.at.history.durations.expected())
    }
}

/// A state moved by a rate over a time.
fn moved<X: StateVector>(state: &X, rate: &X, time: f64) -> X {
    let mut moved = state.clone();
    moved.add_scaled(time, rate);
    moved
}
