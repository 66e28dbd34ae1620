//! The reasons why a command fails.

use std::path::PathBuf;
use thiserror::Error;

/// The reason why a command failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file or folder could not be read or written.
    #[error("{path}: {source}")]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The answer of the system.
        source: std::io::Error,
    },
    /// A line of a reference file could not be understood.
    #[error("{path}, line {line}: {reason}")]
    ReferenceLine {
        /// The file.
        path: PathBuf,
        /// The line, from one.
        line: usize,
        /// The defect.
        reason: String,
    },
    /// A job on disk cannot go on.
    #[error(transparent)]
    Job(#[from] resumable_job::Error),
    /// A file of reference values that holds none, or none that can be compared.
    #[error("{path}: this file holds no reference value; a check of it would check nothing")]
    NoReference {
        /// The file.
        path: PathBuf,
    },
    /// Reference values of the repository that lack something.
    #[error("the reference values: {reason}")]
    Reference {
        /// The missing value or field.
        reason: String,
    },
    /// A name that does not exist.
    #[error("there is no {kind} '{name}'; there are: {known}")]
    UnknownName {
        /// The kind of thing that was named: a figure, a result, a command.
        kind: &'static str,
        /// The name given.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// An error of `hopper-basin`.
    #[error(transparent)]
    Basin(#[from] hopper_basin::Error),
    /// An error of `passive-hopper`.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// An error of `basin-of-attraction`.
    #[error(transparent)]
    Interval(#[from] basin_of_attraction::Error),
    /// An error of `hopper-asymptotics`.
    #[error(transparent)]
    Asymptotics(#[from] hopper_asymptotics::Error),
    /// An error of `hybrid-system`.
    #[error(transparent)]
    Execution(#[from] hybrid_system::Error),
    /// An error of `return-map`.
    #[error(transparent)]
    ReturnMap(#[from] return_map::Error),
    /// A drawing could not be rendered or encoded.
    #[error("cannot render {what}: {reason}")]
    Render {
        /// The name of the drawing or file.
        what: String,
        /// The answer of the library.
        reason: String,
    },
    /// The software of other people could not be run.
    #[error("the peers cannot be compared with: {reason}")]
    Peers {
        /// The reason.
        reason: String,
    },
    /// A check failed; the command has printed the details.
    #[error("{0}")]
    CheckFailed(String),
}
