//! Arcs and events: the pieces of an execution.

use crate::{Certainty, Error, HybridSystem, State, ZenoLimit};

/// A jump between two arcs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event<M, S, const N: usize> {
    /// The surface that was crossed.
    pub surface: S,
    /// Continuous time t of the event.
    pub time: f64,
    /// Number of jumps before this one, j.
    pub jump: usize,
    /// The state before the jump, x⁻.
    pub before: State<N>,
    /// Mode and state after the jump, (m⁺, x⁺); nothing if the execution stops here.
    pub after: Option<(M, State<N>)>,
    /// How sure it is that no event came earlier.
    pub certainty: Certainty,
}

/// How an arc ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ArcEnd<M, S, const N: usize> {
    /// In an event.
    Event(Event<M, S, N>),
    /// In infinitely many events, each sooner than the one before (Zeno); the arc stands for all of them.
    Zeno {
        /// Where and when they end.
        limit: ZenoLimit<N>,
        /// Mode and state in which the model goes on; nothing if it names none.
        after: Option<(M, State<N>)>,
    },
    /// At the limit on time: no event before it, as surely as the search of the mode's guards is.
    TimeLimit,
    /// Never: no event ever follows, and there is no limit on time.
    Never,
}

/// A stretch of continuous motion in one mode.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arc<M, S, const N: usize> {
    /// The mode.
    pub mode: M,
    /// Continuous time t at which the arc starts.
    pub time: f64,
    /// Number of jumps before the arc, j; (t, j) is the hybrid time.
    pub jump: usize,
    /// The state at the start.
    pub start: State<N>,
    /// How long the arc lasts; infinite if it [never](ArcEnd::Never) ends.
    pub duration: f64,
    /// How it ends.
    pub end: ArcEnd<M, S, N>,
}

impl<M: Copy, S: Copy, const N: usize> Arc<M, S, N> {
    /// The state `elapsed` after the start of the arc, by the flow of `system`.
    ///
    /// # Errors
    /// [`Error::StateNotFinite`] where the flow has none.
    pub fn state<T>(&self, system: &T, elapsed: f64) -> Result<State<N>, Error>
    where
        T: HybridSystem<N, Mode = M, Surface = S>,
    {
        let state = system.flow(self.mode, &self.start, elapsed);
        if state.iter().all(|component| component.is_finite()) {
            return Ok(state);
        }
        let (time, jumps) = (self.time + elapsed, self.jump);
        Err(Error::StateNotFinite { time, jumps, state: state.iter().copied().collect() })
    }

    /// The event that ends the arc, if one does.
    pub fn event(&self) -> Option<&Event<M, S, N>> {
        match &self.end {
            ArcEnd::Event(event) => Some(event),
            ArcEnd::Zeno { .. } | ArcEnd::TimeLimit | ArcEnd::Never => None,
        }
    }
}
