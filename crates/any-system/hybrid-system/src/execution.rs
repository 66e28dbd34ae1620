//! Executions: arcs and events in hybrid time, one after the other.

use crate::arc::{Arc, ArcEnd, Event};
use crate::chain::Chain;
use crate::condition::Passed;
use crate::crossing::{EventKind, NextEvent};
use crate::error::Error;
use crate::limits::{Limits, Stop};
use crate::point::Point;
use crate::residues::Residues;
use crate::state::StateVector;
use crate::system::HybridSystem;
use crate::time_sum::TimeSum;
use crate::zeno::History;

/// The most events of one arc that do not count. A million take about a second.
const MOST_PASSED: usize = 1_000_000;

/// An execution of a hybrid system, as an iterator over its arcs.
///
/// The iterator ends at a limit, at a terminal event, at a Zeno limit or a sliding surface after which the model
/// gives no mode, when no event can follow, or after an error. [`stop`](Self::stop) returns which.
#[derive(Debug, Clone)]
pub struct Execution<'a, T: HybridSystem> {
    pub(crate) system: &'a T,
    pub(crate) limits: Limits,
    pub(crate) stop: Option<Stop>,
    pub(crate) at: PointOf<T>,
    /// What events that do not count have left on the present arc.
    pub(crate) passed: Passed,
    /// The first steps of the next arc, where many motions are followed side by side.
    #[cfg(feature = "ode")]
    pub(crate) ahead: crate::ode::Ahead,
}

impl<'a, T: HybridSystem> Execution<'a, T> {
    /// Starts in `mode` from `state` at hybrid time (0, 0).
    pub fn new(system: &'a T, mode: T::Mode, state: T::State, limits: Limits) -> Self {
        let at = Point {
            mode,
            state,
            time: TimeSum::new(0.0),
            jump: 0,
            initial: true,
            at_start: true,
            history: History::new(),
            chain: Chain::new(),
            arrival: None,
            residues: Residues::new(),
        };
        Execution::of(system, limits, at)
    }

    /// The execution from a point.
    pub(crate) fn of(system: &'a T, limits: Limits, at: PointOf<T>) -> Self {
        Execution {
            system,
            limits,
            stop: None,
            at,
            passed: Passed::default(),
            #[cfg(feature = "ode")]
            ahead: crate::ode::Ahead::default(),
        }
    }

    /// The same execution from another start time t. The limit on time is a continuous time t, not a duration.
    #[must_use]
    pub fn starting_at(mut self, time: f64) -> Self {
        self.at.time = TimeSum::new(time);
        self
    }

    /// Why the execution ended; `None` while it continues.
    pub fn stop(&self) -> Option<Stop> {
        self.stop
    }

    /// The next arc. The state of the execution moves to the end of the arc. Events that do not count are passed on it.
    fn arc(&mut self) -> Result<AnArc<T>, Error> {
        self.passed = Passed::default();
        let start = self.at.time;
        let mut first: Option<AnArc<T>> = None;
        loop {
            let passed = self.passed.number;
            let piece = self.piece();
            #[cfg(feature = "ode")]
            self.ahead.clear();
            let piece = piece?;
            let mut arc = match first {
                Some(first) => Arc { end: piece.end, duration: piece.duration, ..first },
                None => piece,
            };
            if self.passed.number > 0 && arc.duration.is_finite() {
                arc.duration = self.at.time.since(start);
                if let ArcEnd::Zeno { limit, .. } = &mut arc.end {
                    limit.remainder = arc.duration;
                }
            }
            if self.passed.number == passed {
                return Ok(arc);
            }
            // The events that do not count are a budget too, or their arc might never end.
            if self.passed.number >= self.limits.steps.min(MOST_PASSED) {
                if let ArcEnd::Event(Event { certainty, .. }) = arc.end {
                    arc.end = ArcEnd::Unfinished { certainty };
                }
                self.stop = Some(Stop::Unfinished);
                return Ok(arc);
            }
            first = Some(arc);
        }
    }

    /// The arc up to the next event, whether it counts or not.
    fn piece(&mut self) -> Result<AnArc<T>, Error> {
        self.check()?;
        let horizon = self.at.time.up_to(self.limits.time);
        // Events before a limit on time, a clock or another event that comes before the Zeno limit are followed.
        if let Some(limit) = self.at.history.zeno_limit(false, &self.at.state)
            && limit.remainder <= horizon
            && let Some(arc) = self.arc_to_limit(limit, horizon)?
        {
            return Ok(arc);
        }
        let (found, leaving, clock) = match self.next_event(horizon) {
            // After many short bounces rounding hides the next one. If the durations form a geometric series, this is a
            // Zeno limit.
            Err(
                hidden @ (Error::UndecidedStart { .. }
                | Error::UndecidedSign { .. }
                | Error::Grazing { .. }),
            ) => {
                return match self.at.history.zeno_limit(true, &self.at.state) {
                    Some(limit) => self.hidden_arc(limit, horizon),
                    None => Err(hidden),
                };
            }
            found => found?,
        };
        match found {
            NextEvent::Crossing(crossing) => {
                // The `first_crossing` of a model may return any time.
                let rounding = crossing.time_rounding;
                if !(crossing.time >= 0.0)
                    || !(rounding >= 0.0)
                    || !(crossing.time_error >= rounding)
                {
                    let what = "the time of a crossing, its rounding or its error,";
                    return Err(Error::BadLimit { what, value: crossing.time });
                }
                if crossing.time > horizon + rounding {
                    let certainty = crossing.certainty;
                    return self.arc_without_event(horizon, None, certainty, leaving);
                }
                // A crossing that takes no time, or only the error of its own time, is at once as well.
                let at_once = crossing.kind == EventKind::AtStart
                    || crossing.kind == EventKind::Crossing
                        && crossing.time <= rounding.max(f64::EPSILON * self.at.time.value());
                if at_once && let Some(sliding) = self.sliding(crossing.surface) {
                    return Ok(self.sliding_arc(sliding));
                }
                self.event_arc(crossing, (horizon, clock), leaving)
            }
            NextEvent::None { state, certainty } => {
                self.arc_without_event(horizon, state, certainty, leaving)
            }
            // Going on with the same budgets would never end.
            NextEvent::Unfinished { time, .. } if !(time > 0.0) => {
                let Limits { intervals, steps, .. } = self.limits;
                Err(Error::BudgetTooSmall { horizon, intervals, steps })
            }
            NextEvent::Unfinished { time, state, certainty } => {
                let end = ArcEnd::Unfinished { certainty };
                let arc = self.new_arc(time, end);
                self.stop = Some(Stop::Unfinished);
                self.advance(time, state, leaving);
                Ok(arc)
            }
        }
    }

    fn check(&self) -> Result<(), Error> {
        if !(self.limits.time >= self.at.time.value()) {
            // The reader of the message may want a run backward.
            let what =
                "the limit on time, which is not before the start (backward: see `Backward`),";
            return Err(Error::BadLimit { what, value: self.limits.time });
        }
        if !self.at.time.value().is_finite() {
            let (what, value) = ("the time of the start", self.at.time.value());
            return Err(Error::BadLimit { what, value });
        }
        self.check_state(self.at.time.value(), &self.at.state)?;
        if self.at.initial { self.system.validate(self.at.mode, &self.at.state) } else { Ok(()) }
    }

    /// An error if a state is not finite.
    pub(crate) fn check_state(&self, time: f64, state: &T::State) -> Result<(), Error> {
        if state.is_finite() {
            return Ok(());
        }
        let (jumps, state) = (self.at.jump, state.components().to_vec());
        Err(Error::StateNotFinite { time, jumps, state })
    }
}

/// A point of an execution of a system.
pub(crate) type PointOf<T> =
    Point<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface, <T as HybridSystem>::State>;

/// An arc of a system.
pub(crate) type AnArc<T> =
    Arc<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface, <T as HybridSystem>::State>;

impl<T: HybridSystem> Iterator for Execution<'_, T> {
    type Item = Result<AnArc<T>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.stop.is_some() {
            return None;
        }
        if self.at.jump >= self.limits.events {
            self.stop = Some(Stop::EventLimit);
            return None;
        }
        let arc = self.arc();
        if arc.is_err() {
            self.stop = Some(Stop::Failed);
        }
        Some(arc)
    }
}
