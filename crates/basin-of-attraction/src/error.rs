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
    /// A strip with other columns than the raster has, or another number of labels.
    #[error("a strip of {columns} columns and {rows} rows has {found} labels")]
    BadStrip {
        /// Its labels.
        found: usize,
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
    /// A proportion of nothing, or of more than everything.
    #[error("{successes} of {trials} is no proportion")]
    BadTrials {
        /// Successes.
        successes: usize,
        /// Trials.
        trials: usize,
    },
    /// An interval from replicates needs at least two.
    #[error("{replicates} replicates are too few for an interval")]
    TooFewReplicates {
        /// Replicates.
        replicates: usize,
    },
    /// A size of boxes, or a distance, that cannot be used.
    #[error("a size or distance of {size} cannot be used here")]
    BadBoxSize {
        /// The size given.
        size: f64,
    },
    /// Points through which no power law can be fitted.
    #[error(
        "no power law through {points} points: three are needed, positive and at different scales"
    )]
    BadFit {
        /// Points given.
        points: usize,
    },
    /// The Wada test needs three basins.
    #[error("{labels} labels: the Wada property needs three basins")]
    TooFewLabels {
        /// Labels found.
        labels: usize,
    },
}
