//! The errors of this crate.

use thiserror::Error;

/// Why an enclosure was not made, or a root not found.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The ends are no interval of finite numbers.
    #[error(
        "[{low}, {high}] is no interval: the ends must be finite, and the lower one not above the upper one"
    )]
    Ends {
        /// The lower end that was given.
        low: f64,
        /// The upper end that was given.
        high: f64,
    },
    /// A function has the same sign at both ends of a bracket.
    #[error("no sign change on [{left:?}, {right:?}]: values {at_left:?} and {at_right:?}")]
    NoSignChange {
        /// Left end of the bracket.
        left: f64,
        /// Right end of the bracket.
        right: f64,
        /// Function value at the left end.
        at_left: f64,
        /// Function value at the right end.
        at_right: f64,
    },
    /// A function or an end of a bracket is infinite or NaN.
    #[error("the function is {value:?} at {at:?}")]
    NotFinite {
        /// Argument of the function.
        at: f64,
        /// Its value.
        value: f64,
    },
    /// A root search reached its limit of iterations.
    #[error("the search on [{left:?}, {right:?}] did not end within {iterations} iterations")]
    NoConvergence {
        /// Left end of the bracket.
        left: f64,
        /// Right end of the bracket.
        right: f64,
        /// The limit.
        iterations: usize,
    },
}
