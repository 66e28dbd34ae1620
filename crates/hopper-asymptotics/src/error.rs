//! What an expansion refuses.

use thiserror::Error;

/// Why an expansion has no value.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The expansions are about α*_n with n ≥ 1; at α*_0 = 0 the exponents are others.
    #[error("there is no expansion of this kind about the fixed point α*_{n}")]
    Index {
        /// The index given.
        n: u64,
    },
    /// Outside the range in which the error of the expansion was measured: of an offset, a speed, or λ.
    #[error("the expansion holds from {left} to {right}, not at {value}")]
    OutsideRange {
        /// The value given.
        value: f64,
        /// Lower end of the range.
        left: f64,
        /// Upper end of the range.
        right: f64,
    },
}
