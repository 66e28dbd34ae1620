//! Checkpoints: everything that decides how an execution goes on.

use crate::execution::Execution;
use crate::limits::{Limits, Stop};
use crate::point::Point;
use crate::system::HybridSystem;

/// An execution between two arcs, without its system and its limits.
///
/// An execution that is [restored](Execution::restore) from a checkpoint, with the same system and limits, gives
/// the same bits as the execution from which the checkpoint was [taken](Execution::checkpoint). The checkpoint
/// contains the mode, the state, the time (with the digits that a double does not hold), the number of events, the
/// durations and states from which a Zeno limit is recognised, and the events at the present instant.
///
/// With the feature `serde` a checkpoint can be written and read by serde, if modes, surfaces and states can. JSON
/// keeps all bits if the reader is exact (`serde_json` with its feature `float_roundtrip`). A checkpoint with an
/// infinite or NaN component is not written, because JSON has no such numbers: the writer returns an error.
/// Surfaces that are texts (`&'static str`) can be written but not read: use numbers or an enum.
///
/// ```
/// use hybrid_system::*;
///
/// let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
///     .falling((), |x| x[0], |x| ((), [0.0, -0.5 * x[1]]))
///     .sampled(0.01);
/// let mut execution = ball.run((), [0.5, 0.0], 2.9);
/// execution.next();
/// let checkpoint = execution.checkpoint();
/// let rest: Vec<_> = execution.collect::<Result<_, _>>()?;
/// let again = Execution::restore(&ball, checkpoint, Limits::sampled(2.9, 1000, 0.01));
/// assert_eq!(again.collect::<Result<Vec<_>, _>>()?, rest);
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Checkpoint<M, S, X> {
    pub(crate) point: Point<M, S, X>,
    pub(crate) stop: Option<Stop>,
}

impl<M: Copy, S, X> Checkpoint<M, S, X> {
    /// The mode.
    pub fn mode(&self) -> M {
        self.point.mode
    }

    /// The state.
    pub fn state(&self) -> &X {
        &self.point.state
    }

    /// Continuous time t.
    pub fn time(&self) -> f64 {
        self.point.time.value()
    }

    /// The number of events so far, j.
    pub fn jump(&self) -> usize {
        self.point.jump
    }

    /// Why the execution had ended; `None` if it had not.
    pub fn stop(&self) -> Option<Stop> {
        self.stop
    }
}

impl<'a, T: HybridSystem> Execution<'a, T> {
    /// The present point of the execution, from which it can be restored.
    pub fn checkpoint(&self) -> Checkpoint<T::Mode, T::Surface, T::State> {
        Checkpoint { point: self.at.clone(), stop: self.stop }
    }

    /// The execution of `system` from a checkpoint.
    ///
    /// If the execution had ended at a limit, [`go_on`](Self::go_on) continues it with others.
    pub fn restore(
        system: &'a T,
        checkpoint: Checkpoint<T::Mode, T::Surface, T::State>,
        limits: Limits,
    ) -> Self {
        let (stop, at) = (checkpoint.stop, checkpoint.point);
        Execution { stop, ..Execution::of(system, limits, at) }
    }
}
