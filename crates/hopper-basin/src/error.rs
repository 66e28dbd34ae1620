//! What cannot be asked.

use thiserror::Error;

/// Why a trap, crisis or basin could not be computed.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// The hopper refused.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// The basin tools refused.
    #[error(transparent)]
    Basin(#[from] basin_of_attraction::Error),
    /// A bracket that theory guarantees did not hold numerically.
    #[error("no root where theory has one, on hump {n}: {source}")]
    Root {
        /// The hump.
        n: u64,
        /// What the root finder said.
        source: hybrid_system::Error,
    },
    /// A window whose fixed points do not fit the labels, or that goes below zero.
    #[error("a window of lift-off speeds must lie in [0, {largest}], not [{bottom}, {top}]")]
    Window {
        /// Lowest speed.
        bottom: f64,
        /// Highest speed.
        top: f64,
        /// Highest speed whose fixed points have labels.
        largest: f64,
    },
    /// A measure by no points at all.
    #[error("no points: {points} on each interval from α*_{from} to α*_{to}")]
    NoPoints {
        /// First fixed point.
        from: u64,
        /// Last fixed point.
        to: u64,
        /// Points asked for on each interval.
        points: usize,
    },
    /// An index for which the quantity is not defined or not resolved.
    #[error("the index of the hump must be from {smallest} to {largest}, not {n}")]
    Index {
        /// The index given.
        n: u64,
        /// The smallest accepted.
        smallest: u64,
        /// The largest accepted.
        largest: u64,
    },
    /// A spacing too fine or too coarse to scan with.
    #[error("cannot scan a length of {length} at a spacing of {width}")]
    Width {
        /// The spacing asked for.
        width: f64,
        /// The length to be scanned, or the largest mass ratio tried.
        length: f64,
    },
}
