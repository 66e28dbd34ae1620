//! Errors of a measurement.

use thiserror::Error;

/// Why a command failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file of the repository or of the results could not be used.
    #[error(transparent)]
    Repository(#[from] repository_tools::Error),
    /// A file could not be written, or another run is at work in its folder.
    #[error(transparent)]
    Job(#[from] resumable_job::Error),
    /// A figure could not be rendered, or a table could not be encoded.
    #[error(transparent)]
    Figure(#[from] journal_figures::Error),
    /// A reference value of the repository is missing or malformed.
    #[error(
        "the reference values: {reason}; the files under crates/*/tests/data have been changed"
    )]
    Reference {
        /// The reason.
        reason: String,
    },
    /// A fate or a basin could not be computed.
    #[error(transparent)]
    Basin(#[from] hopper_basin::Error),
    /// A hop could not be computed.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// An interval or a grid was refused.
    #[error(transparent)]
    Interval(#[from] basin_of_attraction::Error),
    /// An expansion could not be evaluated.
    #[error(transparent)]
    Asymptotics(#[from] hopper_asymptotics::Error),
    /// An execution of a hybrid system failed.
    #[error(transparent)]
    Execution(#[from] hybrid_system::Error),
    /// A result could not be encoded, or its document has no place for it.
    #[error("cannot write {what}: {reason}")]
    Render {
        /// Name of the file.
        what: String,
        /// The reason.
        reason: String,
    },
    /// The software that is compared with could not be run.
    #[error("the comparison with the peers failed: {reason}")]
    Peers {
        /// The reason.
        reason: String,
    },
    /// A comparison does not hold, or an option makes no sense; the text states which.
    #[error("{0}")]
    CheckFailed(String),
}
