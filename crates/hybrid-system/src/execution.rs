//! Executions: arcs and events in hybrid time, one after the other.

use crate::arc::{Arc, ArcEnd, Event};
use crate::arrival::Arrival;
use crate::chain::Chain;
use crate::crossing::{Certainty, Crossing, EventKind, MOST_INTERVALS, NextEvent, Search};
use crate::error::Error;
use crate::guard::Role;
use crate::sliding::{AtOnce, Sliding, sliding_point};
use crate::start_rule::{LeavingGuards, Start, start_of_arc};
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem, Reset};
use crate::time_sum::TimeSum;
use crate::zeno::{History, ZenoLimit};

/// Limits of an execution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest continuous time t; may be infinite if the model solves its own crossings.
    pub time: f64,
    /// Largest number of events.
    pub events: usize,
    /// The interval at which guards without bounds are sampled.
    pub sampling_interval: Option<f64>,
    /// The most intervals that the search for one event tests under bounds.
    pub intervals: usize,
    /// The most steps of the integrated flow of one arc. After them the arc ends with
    /// [`ArcEnd::Unfinished`](crate::ArcEnd::Unfinished), and the execution can go on.
    pub steps: usize,
}

impl Limits {
    /// Limits for models whose guards need no samples.
    pub const fn new(time: f64, events: usize) -> Self {
        Limits {
            time,
            events,
            sampling_interval: None,
            intervals: MOST_INTERVALS,
            steps: usize::MAX,
        }
    }

    /// The same with a sampling interval for guards without bounds.
    pub const fn sampled(time: f64, events: usize, interval: f64) -> Self {
        let mut limits = Limits::new(time, events);
        limits.sampling_interval = Some(interval);
        limits
    }
}

/// Why an execution ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Stop {
    /// The limit on time was reached.
    TimeLimit,
    /// The limit on the number of events was reached.
    EventLimit,
    /// A reset ended the execution.
    Terminal,
    /// No event follows, and there is no limit on time.
    NoFurtherEvent,
    /// The events have a Zeno limit, and the model gives no mode after it.
    Zeno,
    /// The fields on both sides of a surface point at it, and the model gives no mode there.
    Sliding,
    /// A budget of the search for the next event ended. The execution can go on.
    Unfinished,
    /// An error was returned.
    Failed,
}

/// An execution of a hybrid system, as an iterator over its arcs.
///
/// The iterator ends at a limit, at a terminal event, at a Zeno limit or a sliding surface after which the model gives no
/// mode, when no event can follow, or after an error. [`stop`](Self::stop) returns which.
#[derive(Debug, Clone)]
pub struct Execution<'a, T: HybridSystem> {
    pub(crate) system: &'a T,
    pub(crate) limits: Limits,
    pub(crate) stop: Option<Stop>,
    pub(crate) at: Point<T::Mode, T::Surface, T::State>,
}

/// Everything that decides how an execution goes on.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Point<M, S, X> {
    pub(crate) mode: M,
    pub(crate) state: X,
    pub(crate) time: TimeSum,
    /// Number of events so far, j.
    pub(crate) jump: usize,
    /// False after the first arc.
    pub(crate) initial: bool,
    pub(crate) history: History<X>,
    /// The events since time has passed for the last time.
    pub(crate) chain: Chain<M, S>,
    /// The last crossing, if no time has passed since.
    pub(crate) arrival: Option<Arrival<M, S, X>>,
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
            history: History::new(),
            chain: Chain::new(),
            arrival: None,
        };
        Execution { system, limits, stop: None, at }
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

    /// The next arc. The state of the execution moves to the end of the arc.
    fn arc(&mut self) -> Result<AnArc<T>, Error> {
        self.check()?;
        if let Some(limit) = self.at.history.zeno_limit(false) {
            return Ok(self.zeno_arc(limit));
        }
        // The time of an event at the limit may be rounded up beyond it.
        let horizon = self.at.time.until(self.limits.time).max(0.0);
        let found = match self.next_event(horizon) {
            // After many short bounces rounding hides the next one. If the durations form a geometric series, this is a
            // Zeno limit.
            Err(
                hidden @ (Error::UndecidedStart { .. }
                | Error::UndecidedSign { .. }
                | Error::Grazing { .. }),
            ) => {
                let limit = self.at.history.zeno_limit(true);
                return limit.map(|limit| self.zeno_arc(limit)).ok_or(hidden);
            }
            found => found?,
        };
        match found {
            NextEvent::Crossing(crossing) => {
                // The `first_crossing` of a model may return any time.
                if !(crossing.time >= 0.0) || !(crossing.time_error >= 0.0) {
                    let what = "the time of a crossing, or its error,";
                    return Err(Error::BadLimit { what, value: crossing.time });
                }
                if crossing.time > horizon + crossing.time_error {
                    let certainty = crossing.certainty;
                    return Ok(self.arc_without_event(horizon, None, certainty));
                }
                // A crossing that takes no time, or only the error of its own time, is at once as well.
                let at_once = crossing.kind == EventKind::AtStart
                    || crossing.kind == EventKind::Crossing
                        && crossing.time
                            <= crossing.time_error.max(f64::EPSILON * self.at.time.value());
                if at_once && let Some(sliding) = self.sliding(crossing.surface) {
                    return Ok(self.sliding_arc(sliding));
                }
                self.event_arc(crossing, horizon)
            }
            NextEvent::None { state, certainty } => {
                Ok(self.arc_without_event(horizon, state, certainty))
            }
            NextEvent::Unfinished { time, state, certainty } => {
                let end = ArcEnd::Unfinished { certainty };
                let arc = self.new_arc(time, end);
                self.stop = Some(Stop::Unfinished);
                self.advance(time, state);
                Ok(arc)
            }
        }
    }

    /// The next event: at once, at a preset time, or the first crossing.
    fn next_event(&self, horizon: f64) -> Result<NextEvent<T::Surface, T::State>, Error> {
        let Point { mode, ref state, ref time, ref arrival, initial, .. } = self.at;
        let flow = FlowFrom { system: self.system, mode, start: state };
        let mut leaving = LeavingGuards::new();
        let start = start_of_arc(&flow, arrival.as_ref(), initial, horizon, &mut leaving)?;
        if let Start::Event { surface, certainty } = start {
            return Ok(NextEvent::Crossing(Crossing {
                surface,
                time: 0.0,
                time_error: 0.0,
                state: state.clone(),
                kind: EventKind::AtStart,
                certainty,
            }));
        }
        let clock = self.next_clock(horizon)?;
        let search = Search {
            horizon: clock.map_or(horizon, |clock| clock.until),
            sampling_interval: self.limits.sampling_interval,
            intervals: self.limits.intervals,
            steps: self.limits.steps,
            time: time.value(),
            leaving: &leaving,
        };
        let found = self.system.first_crossing(mode, state, &search)?;
        match (found, clock) {
            (
                NextEvent::None { state: end, certainty },
                Some(ClockEvent { surface, until, .. }),
            ) => Ok(NextEvent::Crossing(Crossing {
                surface,
                time: until,
                time_error: 0.0,
                state: end.unwrap_or_else(|| flow_to(&flow, until)),
                kind: EventKind::Clock,
                certainty,
            })),
            (found, _) => Ok(found),
        }
    }

    /// The clock with the earliest preset time, if that is within `horizon`.
    ///
    /// # Errors
    /// [`Error::BadLimit`] for a time that is not later than the present: the clock would never move on.
    fn next_clock(&self, horizon: f64) -> Result<Option<ClockEvent<T::Surface>>, Error> {
        let now = self.at.time.value();
        let guards = self.system.guards(self.at.mode).iter();
        let mut earliest: Option<ClockEvent<T::Surface>> = None;
        for guard in guards.filter(|guard| guard.role == Role::Clock) {
            // A clock whose time is now, and that has not had its event yet, must not be lost.
            let had_its_event = self.at.initial || self.at.chain.contains(guard.surface);
            let after = if had_its_event { now } else { now.next_down() };
            let Some(time) = self.system.next_time(self.at.mode, guard.surface, after) else {
                continue;
            };
            if !(time > after) {
                let what = "a time of a clock that is not later than the time before it";
                return Err(Error::BadLimit { what, value: time });
            }
            let until = self.at.time.until(time).max(0.0);
            if until <= horizon && earliest.is_none_or(|first| until < first.until) {
                earliest = Some(ClockEvent { surface: guard.surface, until, time });
            }
        }
        Ok(earliest)
    }

    /// An arc that ends in an event.
    fn event_arc(
        &mut self,
        crossing: Crossing<T::Surface, T::State>,
        horizon: f64,
    ) -> Result<AnArc<T>, Error> {
        let Crossing { surface, time: duration, time_error, state, kind, certainty } = crossing;
        let before = self.at.time.value();
        let mut time = self.at.time.plus(duration);
        // The sum of the rounded duration may miss the preset time by a rounding. The clock would then have the same time
        // once more.
        if kind == EventKind::Clock
            && let Some(clock) = self.next_clock(horizon)?
            && clock.surface == surface
        {
            time = TimeSum::new(clock.time);
        }
        let time_passes = time.value() > before;
        if time_passes {
            self.at.chain.clear();
        } else if time.since(self.at.time) > 0.0 && duration > time_error {
            self.at.chain.moves_on();
        }
        self.at.chain.push(self.at.mode, surface);
        self.at.chain.check(time.value())?;
        let after = match self.system.reset(self.at.mode, surface, &state) {
            Reset::Jump { mode, state: after } => {
                check_dimension("the state after a reset", &state, &after)?;
                Some((mode, after))
            }
            Reset::Stop => None,
        };
        let end = ArcEnd::Event(Event {
            surface,
            time: time.value(),
            time_error,
            at_time_limit: (horizon - duration).abs() <= time_error,
            jump: self.at.jump,
            before: state.clone(),
            after: after.clone(),
            kind,
            certainty,
        });
        let arc = self.new_arc(duration, end);
        match kind {
            EventKind::Crossing | EventKind::Touch => {
                let flow =
                    FlowFrom { system: self.system, mode: self.at.mode, start: &self.at.state };
                let arrival = Arrival::new(&flow, Some(surface), &state, (duration, time_error));
                self.at.arrival = Some(arrival);
            }
            EventKind::AtStart | EventKind::Clock => match &mut self.at.arrival {
                Some(arrival) if !time_passes => arrival.passed(surface),
                arrival => *arrival = None,
            },
        }
        self.at.time = time;
        self.at.jump += 1;
        self.at.initial = false;
        match after {
            Some((mode, state)) => {
                self.at.history.push(duration, time_error, time, state.clone());
                (self.at.mode, self.at.state) = (mode, state);
            }
            None => {
                self.at.state = state;
                self.stop = Some(Stop::Terminal);
            }
        }
        Ok(arc)
    }

    /// An arc up to the limit on time, or for ever.
    fn arc_without_event(
        &mut self,
        horizon: f64,
        end: Option<T::State>,
        certainty: Certainty,
    ) -> AnArc<T> {
        if !horizon.is_finite() {
            self.stop = Some(Stop::NoFurtherEvent);
            return self.new_arc(horizon, ArcEnd::Never { certainty });
        }
        let arc = self.new_arc(horizon, ArcEnd::TimeLimit { certainty });
        self.stop = Some(Stop::TimeLimit);
        let flow = FlowFrom { system: self.system, mode: self.at.mode, start: &self.at.state };
        let state = end.unwrap_or_else(|| flow_to(&flow, horizon));
        self.advance(horizon, state);
        arc
    }

    /// Moves on to a state without an event.
    fn advance(&mut self, duration: f64, state: T::State) {
        if duration > 0.0 {
            // A guard that reaches its surface just here, and passes through it after the limit, must not lose its event.
            let flow = FlowFrom { system: self.system, mode: self.at.mode, start: &self.at.state };
            self.at.arrival = Some(Arrival::new(&flow, None, &state, (duration, 0.0)));
            self.at.time = self.at.time.plus(duration);
            self.at.state = state;
            self.at.chain.clear();
            self.at.initial = false;
        }
    }

    /// An arc from the present state.
    fn new_arc(&self, duration: f64, end: ArcEnd<T::Mode, T::Surface, T::State>) -> AnArc<T> {
        Arc {
            mode: self.at.mode,
            time: self.at.time.value(),
            jump: self.at.jump,
            start: self.at.state.clone(),
            duration,
            end,
        }
    }

    /// The sliding point at which the execution is, if an event of `surface` at once leads back to the mode before.
    fn sliding(&self, surface: T::Surface) -> Option<Sliding<T::Mode, T::Surface, T::State>> {
        let last = self.at.chain.last();
        // A crossing of another surface says nothing about the distance from this one.
        let of_last = |arrival: &&Arrival<T::Mode, T::Surface, T::State>| {
            last.is_some_and(|(_, surface)| Some(surface) == arrival.surface())
        };
        let at = AtOnce {
            mode: self.at.mode,
            surface,
            state: &self.at.state,
            time: self.at.time.value(),
            last,
            before: self.at.arrival.as_ref().filter(of_last).map(Arrival::before),
        };
        sliding_point(self.system, &at)
    }

    /// The arc of no duration that ends on a sliding surface. The execution continues after it if the model gives a mode.
    fn sliding_arc(&mut self, sliding: Sliding<T::Mode, T::Surface, T::State>) -> AnArc<T> {
        let after = self.system.slide(&sliding);
        let arc = self.new_arc(0.0, ArcEnd::Sliding { sliding, after: after.clone() });
        self.at.jump += 1;
        self.at.initial = false;
        self.at.history.clear();
        match after {
            Some((mode, state)) => (self.at.mode, self.at.state) = (mode, state),
            None => self.stop = Some(Stop::Sliding),
        }
        arc
    }

    /// The arc that replaces infinitely many events up to their limit. The execution continues after it if the model
    /// gives a mode.
    fn zeno_arc(&mut self, limit: ZenoLimit<T::State>) -> AnArc<T> {
        let horizon = self.at.time.until(self.limits.time).max(0.0);
        if limit.remainder > horizon {
            self.stop = Some(Stop::TimeLimit);
            let certainty = Certainty::Exact;
            return self.new_arc(horizon, ArcEnd::TimeLimit { certainty });
        }
        let after = self.system.rest(self.at.mode, &limit.state);
        let (remainder, state) = (limit.remainder, limit.state.clone());
        let end = ArcEnd::Zeno { limit, after: after.clone() };
        let arc = self.new_arc(remainder, end);
        self.at.time = self.at.time.plus(remainder);
        self.at.jump += 1;
        self.at.initial = false;
        self.at.history.clear();
        self.at.chain.clear();
        self.at.arrival = None;
        match after {
            Some((mode, state)) => (self.at.mode, self.at.state) = (mode, state),
            None => {
                self.at.state = state;
                self.stop = Some(Stop::Zeno);
            }
        }
        arc
    }

    fn check(&self) -> Result<(), Error> {
        if !(self.limits.time >= self.at.time.value()) {
            return Err(Error::BadLimit { what: "the limit on time", value: self.limits.time });
        }
        if self.at.state.is_finite() {
            let initial = self.at.initial;
            return if initial {
                self.system.validate(self.at.mode, &self.at.state)
            } else {
                Ok(())
            };
        }
        Err(Error::StateNotFinite {
            time: self.at.time.value(),
            jumps: self.at.jump,
            state: self.at.state.components().to_vec(),
        })
    }
}

/// The next event of a clock.
#[derive(Debug, Clone, Copy)]
struct ClockEvent<S> {
    surface: S,
    /// Duration up to it.
    until: f64,
    /// Its time t.
    time: f64,
}

/// An arc of a system.
type AnArc<T> =
    Arc<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface, <T as HybridSystem>::State>;

/// The state at a time of a flow; the start itself at time zero.
fn flow_to<T: HybridSystem>(flow: &FlowFrom<T>, time: f64) -> T::State {
    if time == 0.0 { flow.start.clone() } else { flow.system.flow(flow.mode, flow.start, time) }
}

/// An error unless a vector has the dimension of the state.
fn check_dimension<X: StateVector>(what: &'static str, state: &X, other: &X) -> Result<(), Error> {
    let (expected, found) = (state.dimension(), other.dimension());
    if expected == found { Ok(()) } else { Err(Error::Dimension { what, expected, found }) }
}

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
