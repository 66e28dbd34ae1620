//! Errors of the drawings.

use thiserror::Error;

impl From<basin_of_attraction::Error> for Error {
    fn from(error: basin_of_attraction::Error) -> Self {
        Error::Basin(error.into())
    }
}

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Error {
    /// An image could not be encoded.
    #[error(transparent)]
    Figure(#[from] journal_figures::Error),
    /// A hop could not be computed.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// A trap could not be computed.
    #[error(transparent)]
    Basin(#[from] hopper_basin::Error),
    /// A proof could not be tried.
    #[error(transparent)]
    Proof(#[from] hopper_proof::Error),
    /// A window of speeds that is empty.
    #[error("a window of speeds must increase, not go from {from:?} to {to:?}")]
    EmptyWindow {
        /// Its lower end.
        from: f64,
        /// Its upper end.
        to: f64,
    },
    /// A window with more humps of the map than a page shows.
    #[error(
        "the window from {from:?} to {to:?} has {humps} humps of the map, and a picture shows at most {most}; take a \
         narrower one"
    )]
    TooWide {
        /// Its lower end.
        from: f64,
        /// Its upper end.
        to: f64,
        /// The number of humps.
        humps: u64,
        /// The largest number that is drawn.
        most: u64,
    },
    /// Samples that are no motion.
    #[error("sample {index} is none of a motion: {reason}")]
    NoMotion {
        /// The number of the sample, from 0.
        index: usize,
        /// The reason.
        reason: &'static str,
    },
    /// A motion with more samples than are kept.
    #[error(
        "the motion lasts {duration:?}/ω and would need more than {most} samples; take fewer hops, or a slower start"
    )]
    TooLong {
        /// Its duration so far.
        duration: f64,
        /// The largest number of samples.
        most: usize,
    },
    /// An animation with more frames than are kept.
    #[error(
        "the motion lasts {duration:?}/ω, which is {frames} frames, and an animation has at most {most}; take fewer \
         hops, or a slower start"
    )]
    TooManyFrames {
        /// The duration of the motion.
        duration: f64,
        /// The number of frames.
        frames: usize,
        /// The largest number of frames.
        most: usize,
    },
}
