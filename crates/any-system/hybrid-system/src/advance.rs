//! Advance an execution piece by piece: up to a time, and on from a limit.

use crate::execution::Execution;
use crate::limits::{Limits, Stop};
use crate::system::HybridSystem;

impl<T: HybridSystem> Execution<'_, T> {
    /// The mode in which the execution is.
    pub fn mode(&self) -> T::Mode {
        self.at.mode
    }

    /// The state at which the execution is: after the last jump, or at the limit that was reached. After a terminal
    /// event it is the state before the jump that does not happen.
    pub fn state(&self) -> &T::State {
        &self.at.state
    }

    /// The continuous time t at which the execution is.
    pub fn time(&self) -> f64 {
        self.at.time.value()
    }

    /// The number of events so far, j.
    pub fn jump(&self) -> usize {
        self.at.jump
    }

    /// The limits.
    pub fn limits(&self) -> Limits {
        self.limits
    }

    /// The arcs up to a continuous time t. The last of them ends there, and [`state`](Self::state) is then the state at
    /// that time. A later call goes on from it.
    ///
    /// ```
    /// use hybrid_system::*;
    ///
    /// let ball = Model::closed_form(|(), x: &State<2>, t| [x[0] + t * (x[1] - t / 2.0), x[1] - t])
    ///     .falling((), |x| x[0], |x| ((), [0.0, -0.5 * x[1]]))
    ///     .sampled(0.01);
    /// let mut execution = ball.run((), [0.5, 0.0], 0.0);
    /// for frame in 1..=20 {
    ///     for arc in execution.run_until(0.125 * f64::from(frame)) {
    ///         arc?;
    ///     }
    ///     assert!(execution.state()[0] >= 0.0);
    /// }
    /// // Landed at 1 and 2, and up to ⅛ in between.
    /// assert_eq!((execution.time(), execution.jump()), (2.5, 3));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// The state at the time is a new start. Rounding and the steps of an integration therefore differ a little
    /// from those of an execution without the stop; [`Checkpoint`](crate::Checkpoint)s between two arcs change
    /// nothing.
    ///
    /// Other limits stay as they are. If the execution had stopped for another reason than its limit on time, there
    /// are no arcs, and [`stop`](Self::stop) tells the reason. A time before the present one is
    /// [`Error::BadLimit`](crate::Error::BadLimit).
    #[must_use = "the execution advances when the arcs are taken"]
    pub fn run_until(&mut self, time: f64) -> &mut Self {
        self.limits.time = time;
        if self.stop == Some(Stop::TimeLimit) {
            self.stop = None;
        }
        self
    }

    /// Goes on with other limits, if the execution has stopped at a limit on time or on events, or at the end of a
    /// budget.
    ///
    /// After every other stop, [`stop`](Self::stop) stays as it is, and there are no further arcs.
    #[must_use = "the execution advances when the arcs are taken"]
    pub fn go_on(&mut self, limits: Limits) -> &mut Self {
        self.limits = limits;
        if let Some(Stop::TimeLimit | Stop::EventLimit | Stop::Unfinished) = self.stop {
            self.stop = None;
        }
        self
    }
}
