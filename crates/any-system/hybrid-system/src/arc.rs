//! Arcs and events: the pieces of an execution.

use crate::crossing::{Certainty, EventKind};
use crate::error::Error;
use crate::guard::Direction;
use crate::sliding::Sliding;
use crate::state::StateVector;
use crate::system::HybridSystem;
use crate::zeno::ZenoLimit;

/// A jump between two arcs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Event<M, S, X> {
    /// The surface that was crossed.
    pub surface: S,
    /// Continuous time t of the event.
    pub time: f64,
    /// How far the event may be from the zero of the guard along the computed trajectory, by rounding: see
    /// [`Crossing::time_rounding`](crate::Crossing::time_rounding).
    #[cfg_attr(feature = "serde", serde(with = "crate::infinite"))]
    pub time_rounding: f64,
    /// The error of the duration of the arc before the event: a bound for closed forms, an estimate from the tolerances
    /// for integrated flows. Errors of earlier events are not contained.
    #[cfg_attr(feature = "serde", serde(with = "crate::infinite"))]
    pub time_error: f64,
    /// True if the limit on time lies within `time_error` of the event.
    pub at_time_limit: bool,
    /// Number of jumps before this one, j.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::count::read_count"))]
    pub jump: usize,
    /// The state before the jump, x⁻.
    pub before: X,
    /// Mode and state after the jump, (m⁺, x⁺); `None` if the execution ends here.
    pub after: Option<(M, X)>,
    /// A crossing, a touch, an event at once, or a preset time.
    pub kind: EventKind,
    /// How the guard has changed its sign, `Rising` or `Falling`; `None` for a touch and for a preset time.
    pub direction: Option<Direction>,
    /// How certain it is that no event came before.
    pub certainty: Certainty,
}

/// How an arc ends.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum ArcEnd<M, S, X> {
    /// The arc ends in an event.
    Event(Event<M, S, X>),
    /// The arc ends in a Zeno limit. It replaces infinitely many arcs, each shorter than the one before.
    Zeno {
        /// Time and state of the limit.
        limit: ZenoLimit<X>,
        /// Mode and state after the limit; `None` if the model gives none.
        after: Option<(M, X)>,
    },
    /// The arc ends on a surface at which the fields on both sides point.
    Sliding {
        /// The point, with the fields.
        sliding: Sliding<M, S, X>,
        /// Mode and state in which the execution continues; `None` if the model gives none.
        after: Option<(M, X)>,
    },
    /// The arc reaches the limit on time, without an event.
    TimeLimit {
        /// How certain it is that there was no event.
        certainty: Certainty,
    },
    /// The arc does not end: no event follows, and there is no limit on time.
    Never {
        /// How certain it is that there is no event.
        certainty: Certainty,
    },
    /// A budget of the search ended, without an event so far. The execution can go on.
    Unfinished {
        /// How certain it is that there was no event.
        certainty: Certainty,
    },
}

/// A piece of continuous motion in one mode, between two events.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Arc<M, S, X> {
    /// The mode.
    pub mode: M,
    /// Continuous time t at which the arc starts.
    pub time: f64,
    /// Number of jumps before the arc, j; (t, j) is the hybrid time.
    #[cfg_attr(feature = "serde", serde(deserialize_with = "crate::count::read_count"))]
    pub jump: usize,
    /// The state at the start.
    pub start: X,
    /// Duration; infinite if the arc [never](ArcEnd::Never) ends.
    #[cfg_attr(feature = "serde", serde(with = "crate::infinite"))]
    pub duration: f64,
    /// How it ends.
    pub end: ArcEnd<M, S, X>,
}

impl<M: Copy, S: Copy, X: StateVector> Arc<M, S, X> {
    /// The same arc with its states in another type, such as a [`State<N>`](crate::State) for a `DVector`.
    pub fn with_states<Y>(&self, convert: impl Fn(&X) -> Y) -> Arc<M, S, Y> {
        let pair = |after: &Option<(M, X)>| after.as_ref().map(|(mode, x)| (*mode, convert(x)));
        let end = match &self.end {
            ArcEnd::Event(event) => ArcEnd::Event(Event {
                surface: event.surface,
                time: event.time,
                time_rounding: event.time_rounding,
                time_error: event.time_error,
                at_time_limit: event.at_time_limit,
                jump: event.jump,
                before: convert(&event.before),
                after: pair(&event.after),
                kind: event.kind,
                direction: event.direction,
                certainty: event.certainty,
            }),
            ArcEnd::Zeno { limit, after } => {
                ArcEnd::Zeno { limit: limit.with_state(&convert), after: pair(after) }
            }
            ArcEnd::Sliding { sliding, after } => {
                ArcEnd::Sliding { sliding: sliding.with_states(&convert), after: pair(after) }
            }
            ArcEnd::TimeLimit { certainty } => ArcEnd::TimeLimit { certainty: *certainty },
            ArcEnd::Never { certainty } => ArcEnd::Never { certainty: *certainty },
            ArcEnd::Unfinished { certainty } => ArcEnd::Unfinished { certainty: *certainty },
        };
        let Arc { mode, time, jump, duration, .. } = *self;
        Arc { mode, time, jump, start: convert(&self.start), duration, end }
    }

    /// The state at `elapsed` time after the start of the arc, by the flow of `system`.
    ///
    /// # Errors
    /// [`Error::StateNotFinite`] where the flow is not defined.
    pub fn state<T>(&self, system: &T, elapsed: f64) -> Result<X, Error>
    where
        T: HybridSystem<State = X, Mode = M, Surface = S>,
    {
        let state = system.flow(self.mode, &self.start, elapsed);
        if state.is_finite() {
            return Ok(state);
        }
        let (time, jumps) = (self.time + elapsed, self.jump);
        Err(Error::StateNotFinite { time, jumps, state: state.components().to_vec() })
    }

    /// The states at many times after the start of the arc, which are in order: 0 ≤ t₀ ≤ t₁ ≤ …. An integrated mode
    /// that overrides [`HybridSystem::flow_at`] is integrated once for all of them.
    ///
    /// # Errors
    /// [`Error::StateNotFinite`] where the flow is not defined, and the errors of [`HybridSystem::flow_at`].
    pub fn states<T>(&self, system: &T, elapsed: &[f64]) -> Result<Vec<X>, Error>
    where
        T: HybridSystem<State = X, Mode = M, Surface = S>,
    {
        let states = system.flow_at(self.mode, &self.start, elapsed)?;
        match states.iter().zip(elapsed).find(|(state, _)| !state.is_finite()) {
            None => Ok(states),
            Some((state, elapsed)) => {
                let (time, jumps) = (self.time + elapsed, self.jump);
                Err(Error::StateNotFinite { time, jumps, state: state.components().to_vec() })
            }
        }
    }

    /// The event that ends the arc; `None` if the arc ends in another way.
    pub fn event(&self) -> Option<&Event<M, S, X>> {
        match &self.end {
            ArcEnd::Event(event) => Some(event),
            _ => None,
        }
    }
}
