//! What can stop a command.

use std::path::PathBuf;
use thiserror::Error;

/// Why a command failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file or folder could not be read or written.
    #[error("{path}: {source}")]
    File {
        /// Which.
        path: PathBuf,
        /// What the system said.
        source: std::io::Error,
    },
    /// A line of a reference file could not be understood.
    #[error("{path}, line {line}: {reason}")]
    ReferenceLine {
        /// The file.
        path: PathBuf,
        /// The line, from one.
        line: usize,
        /// What is wrong with it.
        reason: String,
    },
    /// A finished piece of a job that cannot be used.
    #[error("{path}: {reason}; remove it, or give another folder")]
    Piece {
        /// Its file.
        path: PathBuf,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// Reference values of the repository that lack something.
    #[error("the reference values: {reason}")]
    Reference {
        /// What.
        reason: String,
    },
    /// A name that does not exist.
    #[error("there is no {kind} '{name}'; there are: {known}")]
    UnknownName {
        /// What was named.
        kind: &'static str,
        /// The name given.
        name: String,
        /// Those that exist.
        known: String,
    },
    /// The dynamics refused.
    #[error(transparent)]
    Basin(#[from] hopper_basin::Error),
    /// The hopper refused.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// The basin tools refused.
    #[error(transparent)]
    Interval(#[from] basin_of_attraction::Error),
    /// The asymptotics refused.
    #[error(transparent)]
    Asymptotics(#[from] hopper_asymptotics::Error),
    /// An execution failed.
    #[error(transparent)]
    Execution(#[from] hybrid_system::Error),
    /// A return map failed.
    #[error(transparent)]
    ReturnMap(#[from] return_map::Error),
    /// A drawing could not be rendered or encoded.
    #[error("cannot render {what}: {reason}")]
    Render {
        /// What was drawn.
        what: String,
        /// What the library said.
        reason: String,
    },
    /// Other people's software could not be run.
    #[error("the peers cannot be compared with: {reason}")]
    Peers {
        /// Why.
        reason: String,
    },
    /// Something that was checked does not hold; the details have been printed.
    #[error("{0}")]
    CheckFailed(String),
}
