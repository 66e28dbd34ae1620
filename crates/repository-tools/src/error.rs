//! Errors in reading and writing the repository's files.

use std::path::PathBuf;
use thiserror::Error;

/// Why a file could not be used.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A file, a folder or standard output could not be read or written.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: PathBuf,
        /// The system's message.
        source: std::io::Error,
    },
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
    /// A file could not be written, or another run is at work in its folder.
    #[error(transparent)]
    Job(#[from] resumable_job::Error),
}

impl Error {
    /// The error of reading or writing `path`.
    pub(crate) fn at(path: impl Into<PathBuf>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.into();
        move |source| Error::File { path, source }
    }
}
