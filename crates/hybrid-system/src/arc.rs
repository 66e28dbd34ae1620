//! Arcs and events: the pieces of an execution.

use crate::crossing::Certainty;
use crate::error::Error;
use crate::state::State;
use crate::system::HybridSystem;
use crate::zeno::ZenoLimit;

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
    /// Mode and state after the jump, (m⁺, x⁺); `None` if the execution ends here.
    pub after: Option<(M, State<N>)>,
    /// How certain it is that no event came before.
    pub certainty: Certainty,
}

/// How an arc ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ArcEnd<M, S, const N: usize> {
    /// The arc ends in an event.
    Event(Event<M, S, N>),
    /// The arc ends in a Zeno limit. It replaces infinitely many arcs, each shorter than the one before.
    Zeno {
        /// Time and state of the limit.
        limit: ZenoLimit<N>,
        /// Mode and state after the limit; `None` if the model gives none.
        after: Option<(M, State<N>)>,
    },
    /// The arc reaches the limit on time, without an event. Whether an event may have been missed depends on how the
    /// guards of the mode are searched, see [`Certainty`].
    TimeLimit,
    /// The arc does not end: no event follows, and there is no limit on time.
    Never,
}

/// A piece of continuous motion in one mode, between two events.
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
    /// Duration; infinite if the arc [never](ArcEnd::Never) ends.
    pub duration: f64,
    /// How it ends.
    pub end: ArcEnd<M, S, N>,
}

impl<M: Copy, S: Copy, const N: usize> Arc<M, S, N> {
    /// The state at `elapsed` time after the start of the arc, by the flow of `system`.
    ///
    /// # Errors
    /// [`Error::StateNotFinite`] where the flow is not defined.
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

    /// The event that ends the arc; `None` if the arc ends in another way.
    pub fn event(&self) -> Option<&Event<M, S, N>> {
        match &self.end {
            ArcEnd::Event(event) => Some(event),
            ArcEnd::Zeno { .. } | ArcEnd::TimeLimit | ArcEnd::Never => None,
        }
    }
}
