//! What cannot be proved, or is no question.

use thiserror::Error;

/// Why there is no proof.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The ends are no interval of mass ratios.
    #[error(
        "[{low}, {high}] is no interval of mass ratios: both ends must be positive and finite, and the lower one not \
         above the upper one"
    )]
    MassRatios {
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
    },
    /// The ends are no interval of lift-off speeds.
    #[error(
        "[{low}, {high}] is no interval of lift-off speeds: the ends must be from 0 to {largest}, and the lower one \
         below the upper one"
    )]
    Speeds {
        /// The lower end.
        low: f64,
        /// The upper end.
        high: f64,
        /// The largest speed that is allowed.
        largest: f64,
    },
    /// No share that may stay open.
    #[error(
        "a share of {open} in {parts} parts: the share must be above 0 and at most 1, and there must be a part"
    )]
    Share {
        /// The share.
        open: f64,
        /// The number of parts.
        parts: usize,
    },
    /// No width of a fraction that can be asked for.
    #[error("a width of {width} of fractions: give one from {narrowest} up, and below 1")]
    Width {
        /// The width.
        width: f64,
        /// The smallest one.
        narrowest: f64,
    },
    /// The strips are not those of the next column of the raster.
    #[error(
        "{found} strips for column {column}, which has {needed}: give those of this column, from the left"
    )]
    Strips {
        /// The column, from 0.
        column: usize,
        /// The number that was given.
        found: usize,
        /// The number that the column has.
        needed: usize,
    },
    /// Columns that the raster has not, or a statement about a raster that lacks columns.
    #[error("{wanted} columns of a raster that has {all}: give all its columns, and no others")]
    Columns {
        /// The number of columns up to the last one that was asked for or added.
        wanted: usize,
        /// The number that the raster has.
        all: usize,
    },
    /// A trap, a crisis or a critical point was not enclosed.
    #[error(
        "{what} of hump {n} is not enclosed at M = {mass_ratio}: the sign of an enclosure is open. Give the trap of \
         another hump, or another mass ratio"
    )]
    Open {
        /// What was looked for.
        what: &'static str,
        /// The hump.
        n: u64,
        /// A mass ratio of the strip.
        mass_ratio: f64,
    },
    /// A computation that the proof starts from failed.
    #[error(transparent)]
    Basin(#[from] hopper_basin::Error),
    /// A raster was interrupted, or has no pixels.
    #[error(transparent)]
    Raster(#[from] basin_of_attraction::Error),
    /// A computation of the model failed.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
}
