//! The result of the search along one guard.

/// The first event of one guard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum OneGuard {
    /// The guard is crossed in its direction.
    Crossing {
        /// Time of the crossing.
        time: f64,
        /// Bound on the error of the time.
        error: f64,
        /// The side from which it comes.
        from: Option<f64>,
    },
    /// The guard touches its surface, and its policy does not ignore that.
    Touch {
        /// Time at which the guard is closest to zero.
        time: f64,
        /// Half of the time for which rounding hides the guard.
        error: f64,
        /// Value of the guard at that time.
        value: f64,
    },
    /// No event.
    Quiet,
    /// The budget of intervals ended at this time. There is no event before.
    BudgetEnded {
        /// The time.
        time: f64,
    },
}
