//! What these tools refuse.

use thiserror::Error;

/// Why a basin could not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The ends of an interval are not numbers in order.
    #[error("[{left}, {right}] is not an interval")]
    BadInterval {
        /// Left end.
        left: f64,
        /// Right end.
        right: f64,
    },
    /// Two traps have points in common.
    #[error("the traps [{first_left}, {first_right}] and [{second_left}, {second_right}] overlap")]
    OverlappingTraps {
        /// Left end of the first.
        first_left: f64,
        /// Right end of the first.
        first_right: f64,
        /// Left end of the second.
        second_left: f64,
        /// Right end of the second.
        second_right: f64,
    },
    /// A raster without pixels, or one too large to hold.
    #[error("cannot make a raster of {columns} × {rows} pixels")]
    BadRaster {
        /// Number of columns.
        columns: usize,
        /// Number of rows.
        rows: usize,
    },
    /// The caller asked to stop.
    #[error("interrupted after {finished} of {columns} columns")]
    Interrupted {
        /// Columns finished.
        finished: usize,
        /// Columns in all.
        columns: usize,
    },
    /// A search with too few samples.
    #[error("{samples} samples are too few to find monotone branches")]
    TooFewSamples {
        /// Samples asked for.
        samples: usize,
    },
}
