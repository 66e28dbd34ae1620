//! Errors of the expansions.

use thiserror::Error;

/// Why an expansion has no value.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The index 0. At α*_0 = 0 the expansion has other exponents: see
    /// [`small_hop_loss`](crate::small_hop_loss).
    #[error("an expansion about the fixed point α*_{n}: the index must be at least 1")]
    Index {
        /// The given index.
        n: u64,
    },
    /// An offset, a speed, a number of hops, or λ, outside the range in which the bound on the error is proved.
    #[error("{value} is outside the range of the expansion: it holds from {left} to {right}")]
    OutsideRange {
        /// The given value.
        value: f64,
        /// Lower end of the range.
        left: f64,
        /// Upper end of the range.
        right: f64,
    },
}
