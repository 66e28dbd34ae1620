//! Where runs end, and why: of one, and of many at once.

use crate::error::Error;
use crate::execution::{AnArc, Execution};
use crate::limits::Stop;
use crate::system::HybridSystem;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Where a run ended, and why.
#[derive(Debug, Clone, PartialEq)]
pub struct Fate<M, S, X> {
    /// Why.
    pub end: End<S>,
    /// The mode at the end.
    pub mode: M,
    /// The state at the end: before an event that ends the run. If no further event follows and there is no limit on time, that
    /// at the start of the last arc.
    pub state: X,
    /// The continuous time t of this state.
    pub time: f64,
    /// The number of events so far; the one that ends the run counts.
    pub events: usize,
}

/// Why a run ended.
#[derive(Debug, Clone, PartialEq)]
pub enum End<S> {
    /// By an event of this surface, which ends the run.
    Terminal(S),
    /// For another reason. An execution that had ended before has its [`Stop`] here, also if that is `Terminal` or `Failed`.
    Stopped(Stop),
    /// By an error. The state is the last one that was reached.
    Failed(Error),
}

/// The fate of an execution of a system.
pub type FateOf<T> =
    Fate<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface, <T as HybridSystem>::State>;

impl<T: HybridSystem> Execution<'_, T> {
    /// Follows the execution to its end: where it ends, and why.
    pub fn fate(self) -> FateOf<T> {
        self.fate_after(None)
    }

    /// The same of an execution whose last arc has ended the run in this way, or has not.
    pub(crate) fn fate_after(mut self, mut end: Option<End<T::Surface>>) -> FateOf<T> {
        for arc in self.by_ref() {
            end = end_of_arc::<T>(arc);
        }
        // An execution without arcs had ended before.
        let end = end.unwrap_or(End::Stopped(self.stop.unwrap_or(Stop::EventLimit)));
        let (mode, time, events) = (self.at.mode, self.at.time.value(), self.at.jump);
        Fate { end, mode, state: self.at.state, time, events }
    }
}

/// How an arc ends a run; `None` if it does not, or only by a limit.
pub(crate) fn end_of_arc<T: HybridSystem>(arc: Result<AnArc<T>, Error>) -> Option<End<T::Surface>> {
    match arc {
        Ok(arc) => {
            let last = arc.event().filter(|event| event.after.is_none());
            last.map(|event| End::Terminal(event.surface))
        }
        Err(error) => Some(End::Failed(error)),
    }
}

/// The results of many runs, such as their [fates](Execution::fate), in the order of their numbers: with the feature
/// `parallel` on all processors. They have the same bits for any number of threads.
///
/// `progress` receives the number of runs that have finished, after each. If it breaks, no further run begins, and runs
/// that have not begun are `None`. With `parallel`, calls of `progress` may overlap and come out of order, and which runs are
/// `None` after a break depends on the threads.
///
/// ```
/// use hybrid_system::{End, Equations, State, many};
/// use std::ops::ControlFlow::Continue;
/// // A coin falls to one of two sides of a ridge. A hundred starts at once:
/// let coin = Equations::new(&["x", "v"], &[("friction", "0.5")])
///     .mode_text("rolls", &["v", "x - friction*v"])
///     .rising_text("right", "x - 1")
///     .stops()
///     .falling_text("left", "x + 1")
///     .stops()
///     .model::<State<2>>()?;
/// let fates = many(
///     100,
///     |run| Ok(coin.start("rolls", [0.1, -0.01 * run as f64], 99.0)?.fate()),
///     |_| Continue(()),
/// );
/// let fates = fates.into_iter().flatten().collect::<Result<Vec<_>, hybrid_system::Error>>()?;
/// let left = fates.iter().filter(|fate| matches!(fate.end, End::Terminal(s) if s == "left"));
/// // It goes left if −v/x is above the root of s² − s/2 − 1, which is 1.28.
/// assert_eq!(left.count(), 100 - 13);
/// # Ok::<(), hybrid_system::Error>(())
/// ```
///
/// A run makes its own model where a parameter changes: `|run| model_at(parameters[run]).run(…).fate()`.
pub fn many<R: Send>(
    runs: usize,
    run: impl Fn(usize) -> R + Sync,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Vec<Option<R>> {
    let (finished, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let one = |number: usize| {
        if stopped.load(Ordering::Relaxed) {
            return None;
        }
        let result = run(number);
        if progress(finished.fetch_add(1, Ordering::Relaxed) + 1).is_break() {
            stopped.store(true, Ordering::Relaxed);
        }
        Some(result)
    };
    in_order(runs, one)
}

#[cfg(feature = "parallel")]
pub(crate) fn in_order<R: Send>(
    runs: usize,
    one: impl Fn(usize) -> Option<R> + Sync,
) -> Vec<Option<R>> {
    use rayon::prelude::*;
    // Runs differ in length: each is a piece of its own.
    (0..runs).into_par_iter().with_max_len(1).map(&one).collect()
}

#[cfg(not(feature = "parallel"))]
pub(crate) fn in_order<R: Send>(
    runs: usize,
    one: impl Fn(usize) -> Option<R> + Sync,
) -> Vec<Option<R>> {
    (0..runs).map(one).collect()
}
