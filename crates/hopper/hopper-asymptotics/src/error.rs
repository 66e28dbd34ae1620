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
    /// An offset that is not a finite number, or has an exponent of ten beyond ±10 000.
    #[error(
        "the offset {text}: the mantissa must be a number and the exponent of ten between −10000 and 10000; give a \
         deeper point by its phase"
    )]
    Offset {
        /// The given offset.
        text: String,
    },
    /// A phase whose error is not small compared with it: its offset has no bound.
    #[error(
        "the phase {hops} is known to within {error} hops only: its offset has no bound; give the phase a smaller error"
    )]
    Phase {
        /// The phase, a number of hops; infinite beyond the largest `f64`.
        hops: f64,
        /// Bound on its error.
        error: f64,
    },
    /// A drift of the slow side, a multiple of λ, at which the series of the Fatou coordinate has no bound.
    #[error(
        "the slow side of α*_{n} drifts with {drift:e}: the series of its Fatou coordinate has no bound there"
    )]
    Drift {
        /// The index.
        n: u64,
        /// A of the leading term 1/(A x).
        drift: f64,
    },
    /// A hop near the fixed point has no value.
    #[error(transparent)]
    Hop(#[from] passive_hopper::Error),
}
