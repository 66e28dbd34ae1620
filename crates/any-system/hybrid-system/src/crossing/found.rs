//! What the search for zeros finds on a stretch of time.

/// What a search finds on a stretch of time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Found {
    /// The function changes sign in the direction of the search, and not before.
    Crossing {
        /// The first time at which the computed function has left its old side.
        time: f64,
        /// Bound on the distance from the zero.
        error: f64,
        /// True if rounding hides the function from `time` − `error` to `time`: each time in between may be the zero.
        hidden: bool,
        /// True if the function goes from negative to positive.
        rising: bool,
    },
    /// The function comes within rounding of zero and goes back. The search can go on behind it.
    Touch {
        /// Time at which the function is closest to zero.
        time: f64,
        /// Half of the length of the hidden interval.
        error: f64,
        /// The computed value at that time.
        value: f64,
        /// The end of the hidden interval: from this time on the function is clear of rounding again.
        until: f64,
    },
    /// Rounding hides the function from some time up to the horizon.
    Undecided {
        /// Time at which the function is closest to zero.
        time: f64,
        /// The computed value at that time.
        value: f64,
    },
    /// No crossing up to the end of the stretch.
    Nothing,
    /// The budget of intervals ended at `ZeroSearch::time`. There is no crossing before.
    BudgetEnded,
}

impl Found {
    /// The side from which a function comes that changes sign, ±1.
    pub(crate) fn from(&self) -> Option<f64> {
        match *self {
            Found::Crossing { rising, .. } => Some(if rising { -1.0 } else { 1.0 }),
            _ => None,
        }
    }
}
