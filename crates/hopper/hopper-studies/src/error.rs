//! Errors of the commands.

use std::path::PathBuf;
use thiserror::Error;

/// Why a command failed.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A line of a reference file could not be understood.
    #[error("{path}, line {line}: {reason}")]
    ReferenceLine {
        /// The file.
        path: PathBuf,
        /// The line, from one.
        line: usize,
        /// The reason.
        reason: String,
    },
    /// A file without reference values, or without values that can be compared.
    #[error("{path}: this file holds no reference value, so that a check with it would be empty")]
    NoReference {
        /// The file.
        path: PathBuf,
    },
    /// A figure could not be rendered or encoded.
    #[error(transparent)]
    Figure(#[from] journal_figures::Error),
    /// A drawing of the hopper failed.
    #[error(transparent)]
    Drawing(#[from] hopper_figures::Error),
    /// A file, a folder or standard output could not be read or written.
    #[error("{path}: {source}")]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The system's message.
        source: std::io::Error,
    },
    /// A long job on disk cannot continue.
    #[error(transparent)]
    Job(#[from] resumable_job::Error),
    /// A reference value of the repository is missing or malformed.
    #[error(
        "the reference values: {reason}; the files under crates/*/*/tests/data have been changed"
    )]
    Reference {
        /// The reason.
        reason: String,
    },
    /// The texts of a figure do not fit it.
    #[error("texts.md: the figure {name} {what}")]
    Text {
        /// The figure.
        name: &'static str,
        /// What is wrong.
        what: String,
    },
    /// A name that does not exist.
    #[error("there is no {kind} '{name}'; there are: {known}")]
    UnknownName {
        /// The kind of thing that the name was taken for.
        kind: &'static str,
        /// The given name.
        name: String,
        /// The names that exist.
        known: String,
    },
    /// A fate or a basin could not be computed.
    #[error(transparent)]
    Basin(#[from] hopper_basin::Error),
    /// A proof could not begin.
    #[error(transparent)]
    Proof(#[from] hopper_proof::Error),
    /// A hop could not be computed.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// An interval, a grid or an estimate was refused.
    #[error(transparent)]
    Interval(#[from] basin_of_attraction::Error),
    /// An expansion could not be evaluated.
    #[error(transparent)]
    Asymptotics(#[from] hopper_asymptotics::Error),
    /// Formulas were refused, or have no value.
    #[error(transparent)]
    Equations(#[from] equations::Error),
    /// An execution of a hybrid system failed.
    #[error(transparent)]
    Execution(#[from] hybrid_system::Error),
    /// A root was not found.
    #[error(transparent)]
    Root(#[from] interval_arithmetic::Error),
    /// A return map failed.
    #[error(transparent)]
    ReturnMap(#[from] return_map::Error),
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
    /// A figure's file is not what its name says, so that it cannot be compared with the committed one.
    #[error("{name} cannot be compared: {reason}")]
    Unreadable {
        /// Name of the file.
        name: String,
        /// The reason.
        reason: String,
    },
    /// A claim or a comparison does not hold, or an option makes no sense; the text states which.
    #[error("{0}")]
    CheckFailed(String),
}

impl Error {
    /// The error of reading or writing `path`.
    pub(crate) fn at(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Error::File { path, source }
    }

    /// The error for a file that cannot be read as what its name says.
    pub(crate) fn unreadable(name: &str, reason: impl std::fmt::Display) -> Self {
        Error::Unreadable { name: name.to_owned(), reason: reason.to_string() }
    }
}
