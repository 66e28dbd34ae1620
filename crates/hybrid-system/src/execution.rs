//! Executions: arcs and events in hybrid time, one after the other.

use crate::arc::{Arc, ArcEnd, Event};
use crate::crossing::{Certainty, Crossing};
use crate::error::Error;
use crate::simultaneous::{also_at_surface, next_at_same_instant};
use crate::state::State;
use crate::system::{HybridSystem, Reset};
use crate::zeno::{History, ZenoLimit};

/// Limits of an execution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limits {
    /// Largest continuous time; may be infinite if the model solves its own crossings.
    pub time: f64,
    /// Largest number of events.
    pub events: usize,
    /// The interval at which guards without bounds are sampled.
    pub sampling_interval: Option<f64>,
}

impl Limits {
    /// Limits for models whose guards need no samples.
    pub const fn new(time: f64, events: usize) -> Self {
        Limits { time, events, sampling_interval: None }
    }

    /// The same with a sampling interval for guards without bounds.
    pub const fn sampled(time: f64, events: usize, interval: f64) -> Self {
        Limits { time, events, sampling_interval: Some(interval) }
    }
}

/// Why an execution ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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
    /// An error was returned.
    Failed,
}

/// An execution of a hybrid system, as an iterator over its arcs.
///
/// The iterator ends at a limit, at a terminal event, at a Zeno limit after which the model gives no mode, when no
/// event can follow, or after an error. [`stop`](Self::stop) returns which.
#[derive(Debug, Clone)]
pub struct Execution<'a, T: HybridSystem<N>, const N: usize> {
    system: &'a T,
    limits: Limits,
    mode: T::Mode,
    state: State<N>,
    time: f64,
    jump: usize,
    stop: Option<Stop>,
    history: History<N>,
    /// Number of events in a row between which no time passed.
    timeless: usize,
    /// Surfaces that the state reached at the same instant as the last crossed surface.
    pending: Vec<T::Surface>,
}

/// Most events in a row without time passing. A few are normal where several guards are crossed together. With more
/// events the resets lead back to each other. The execution then ends with [`Error::TimelessChain`].
const MOST_TIMELESS: usize = 1000;

impl<'a, T: HybridSystem<N>, const N: usize> Execution<'a, T, N> {
    /// Starts in `mode` from `state` at hybrid time (0, 0).
    pub fn new(system: &'a T, mode: T::Mode, state: State<N>, limits: Limits) -> Self {
        let history = History::new();
        Execution {
            system,
            limits,
            mode,
            state,
            time: 0.0,
            jump: 0,
            stop: None,
            history,
            timeless: 0,
            pending: Vec::new(),
        }
    }

    /// Why the execution ended; `None` while it continues.
    pub fn stop(&self) -> Option<Stop> {
        self.stop
    }

    /// The next arc. The state of the execution moves to the end of the arc.
    fn arc(&mut self) -> Result<Arc<T::Mode, T::Surface, N>, Error> {
        if !(self.limits.time >= 0.0) {
            return Err(Error::BadLimit { what: "the limit on time", value: self.limits.time });
        }
        self.check_state()?;
        if let Some(limit) = self.history.zeno_limit(self.time, self.jump, false) {
            return Ok(self.zeno_arc(limit));
        }
        // The time of an event at the limit may be rounded up beyond it.
        let horizon = (self.limits.time - self.time).max(0.0);
        let crossing = match self.at_same_instant(horizon) {
            Some(crossing) => Some(crossing),
            None => match self.search(horizon) {
                // After many short bounces rounding hides the next one. If the durations form a geometric series, this
                // is a Zeno limit.
                Err(
                    hidden @ (Error::UndecidedStart { .. }
                    | Error::UndecidedSign { .. }
                    | Error::Grazing { .. }),
                ) => {
                    let limit = self.history.zeno_limit(self.time, self.jump, true);
                    return limit.map(|limit| self.zeno_arc(limit)).ok_or(hidden);
                }
                other => other?,
            },
        };
        // The `first_crossing` of a model may return any time.
        if let Some(crossing) = crossing.filter(|crossing| !(crossing.time >= 0.0)) {
            return Err(Error::BadLimit { what: "the time of a crossing", value: crossing.time });
        }
        let mut arc = Arc {
            mode: self.mode,
            time: self.time,
            jump: self.jump,
            start: self.state,
            duration: horizon,
            end: if horizon.is_finite() { ArcEnd::TimeLimit } else { ArcEnd::Never },
        };
        match crossing.filter(|crossing| crossing.time <= horizon) {
            Some(crossing) => {
                arc.duration = crossing.time;
                if crossing.time > 0.0 {
                    self.pending =
                        also_at_surface(self.system, &arc, crossing.surface, &crossing.state);
                } else {
                    // This event is at the same instant as the last one: the other surfaces stay pending.
                    self.pending.retain(|&surface| surface != crossing.surface);
                }
                let time = self.time + crossing.time;
                let after = match self.system.reset(self.mode, crossing.surface, &crossing.state) {
                    Reset::Jump { mode, state } => Some((mode, state)),
                    Reset::Stop => None,
                };
                arc.end = ArcEnd::Event(Event {
                    surface: crossing.surface,
                    time,
                    jump: self.jump,
                    before: crossing.state,
                    after,
                    certainty: crossing.certainty,
                });
                self.timeless = if time > self.time { 0 } else { self.timeless + 1 };
                if self.timeless > MOST_TIMELESS {
                    return Err(Error::TimelessChain { time, events: self.timeless });
                }
                self.time = time;
                self.jump += 1;
                match after {
                    Some((mode, state)) => {
                        self.history.push(crossing.time, state);
                        (self.mode, self.state) = (mode, state);
                    }
                    None => self.stop = Some(Stop::Terminal),
                }
            }
            None if horizon.is_finite() => self.stop = Some(Stop::TimeLimit),
            None => self.stop = Some(Stop::NoFurtherEvent),
        }
        Ok(arc)
    }

    fn search(&self, horizon: f64) -> Result<Option<Crossing<T::Surface, N>>, Error> {
        let interval = self.limits.sampling_interval;
        self.system.first_crossing(self.mode, &self.state, horizon, interval)
    }

    /// The next event at the same instant as the last one.
    fn at_same_instant(&mut self, horizon: f64) -> Option<Crossing<T::Surface, N>> {
        if self.pending.is_empty() {
            return None;
        }
        let surface =
            next_at_same_instant(self.system, self.mode, &self.state, &self.pending, horizon);
        if surface.is_none() {
            self.pending.clear();
        }
        let (state, certainty) = (self.state, Certainty::Certain);
        surface.map(|surface| Crossing { surface, time: 0.0, state, certainty })
    }

    /// The arc that replaces infinitely many events up to their limit. The execution continues after it if the model
    /// gives a mode.
    fn zeno_arc(&mut self, limit: ZenoLimit<N>) -> Arc<T::Mode, T::Surface, N> {
        if limit.time > self.limits.time {
            self.stop = Some(Stop::TimeLimit);
            return Arc {
                mode: self.mode,
                time: self.time,
                jump: self.jump,
                start: self.state,
                duration: (self.limits.time - self.time).max(0.0),
                end: ArcEnd::TimeLimit,
            };
        }
        let after = self.system.rest(self.mode, &limit.state);
        let arc = Arc {
            mode: self.mode,
            time: self.time,
            jump: self.jump,
            start: self.state,
            duration: (limit.time - self.time).max(0.0),
            end: ArcEnd::Zeno { limit, after },
        };
        self.time = limit.time;
        self.jump += 1;
        self.history.clear();
        match after {
            Some((mode, state)) => (self.mode, self.state) = (mode, state),
            None => self.stop = Some(Stop::Zeno),
        }
        arc
    }

    fn check_state(&self) -> Result<(), Error> {
        if self.state.iter().all(|component| component.is_finite()) {
            return Ok(());
        }
        let (time, jumps) = (self.time, self.jump);
        Err(Error::StateNotFinite { time, jumps, state: self.state.iter().copied().collect() })
    }
}

impl<T: HybridSystem<N>, const N: usize> Iterator for Execution<'_, T, N> {
    type Item = Result<Arc<T::Mode, T::Surface, N>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.stop.is_some() {
            return None;
        }
        if self.jump >= self.limits.events {
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
