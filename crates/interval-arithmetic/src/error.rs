//! What is no enclosure.

use thiserror::Error;

/// Why an enclosure was not made.
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
}
