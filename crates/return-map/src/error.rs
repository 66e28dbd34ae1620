//! Why a return map has no value.

use thiserror::Error;

/// Why a point has no image, or a search no result.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The execution ended before it came back to the section.
    #[error("no return to the section: {stop:?} after {time} time units and {events} events")]
    NoReturn {
        /// Why the execution ended.
        stop: hybrid_system::Stop,
        /// Continuous time spent.
        time: f64,
        /// Events passed.
        events: usize,
    },
    /// The execution failed.
    #[error("the execution failed: {0}")]
    Execution(#[from] hybrid_system::Error),
    /// A window that is empty or not finite, or too few samples.
    #[error("cannot search [{left}, {right}] at {samples} points")]
    BadWindow {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
        /// Number of samples asked for.
        samples: usize,
    },
    /// Newton's method found no periodic point.
    #[error("no periodic point: the residual is {residual} after {steps} Newton steps")]
    NoPeriodicPoint {
        /// The largest component of fᵖ(x) − x.
        residual: f64,
        /// Newton steps taken.
        steps: usize,
    },
}
