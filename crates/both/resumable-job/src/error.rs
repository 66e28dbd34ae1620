//! The reasons why a job on disk cannot go on.

use std::path::PathBuf;
use thiserror::Error;

/// The reason why a job on disk cannot go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// The system could not read or write a file or folder.
    #[error("{path}: {source}")]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// Another process holds the lock.
    #[error(
        "{}: {} is at work on '{part}' in this folder; wait until it ends, or give another folder",
        .folder.display(), process(*.holder)
    )]
    AtWork {
        /// The folder.
        folder: PathBuf,
        /// The part of the folder that is locked.
        part: String,
        /// The number of the process that holds the lock; `None` if the lock file does not contain it.
        holder: Option<u32>,
    },
    /// The lock file was removed or replaced while its holder was at work.
    #[error(
        "{path}: this lock file, or its folder, was removed or replaced during the run, so another run may use the \
         folder; this run stops; run again when no other run is at work there"
    )]
    LockLost {
        /// The lock file.
        path: PathBuf,
    },
    /// The name of the lock file belongs to a folder, a link or a device.
    #[error(
        "{path}: this is no regular file, so it cannot serve as a lock; remove it, or give another folder"
    )]
    LockFile {
        /// The path of the lock file.
        path: PathBuf,
    },
    /// The file system of this folder has no locks.
    #[error(
        "{}: files cannot be locked here ({source}), so two runs could damage each other; \
         give a folder on another file system",
        .folder.display()
    )]
    NoLocks {
        /// The folder.
        folder: PathBuf,
        /// The error of the system.
        source: std::io::Error,
    },
    /// A file has the name of a piece and is not this piece.
    #[error("{0}; remove it, and run again")]
    Piece(#[from] UnusablePiece),
    /// A part that does not exist.
    #[error(
        "'{text}' is no part of a job; write K/N, part K of N, with 1 ≤ K ≤ N ≤ {most}, such as 1/4"
    )]
    NoPart {
        /// The text.
        text: String,
        /// The largest number of parts.
        most: usize,
    },
    /// The folder has the results of another job.
    #[error(
        "{}: this folder has the results of another job, or of another version of the program: '{found}', and not \
         '{wanted}'; give another folder, or replace the results",
        .folder.display()
    )]
    OtherJob {
        /// The folder.
        folder: PathBuf,
        /// The description of its job.
        found: String,
        /// The description of the job that was to be done.
        wanted: String,
    },
    /// The folder has results, and no description of their job.
    #[error(
        "{path}: this result is here already, and no job.txt says which job made it; give another folder, or replace \
         the results"
    )]
    UnknownJob {
        /// The first such file or folder.
        path: PathBuf,
    },
    /// A piece was finished, and its file is missing now.
    #[error("{path}: this finished piece of the job '{job}' is missing; run again to compute it")]
    MissingPiece {
        /// The file of the piece.
        path: PathBuf,
        /// The description of the job.
        job: String,
    },
    /// An assembled file does not hold the bytes of its pieces.
    #[error(
        "{path}: the file written does not hold the bytes of {part}, from byte {offset} on; \
         it was removed, the pieces are kept: run again"
    )]
    Differs {
        /// The file that was to be written.
        path: PathBuf,
        /// The header, a piece with its number, or the end of the file.
        part: String,
        /// The position in the file at which this part starts.
        offset: u64,
    },
}

/// A file that has the name of a piece and is not this piece.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{path}: {reason}")]
pub struct UnusablePiece {
    /// The file.
    pub path: PathBuf,
    /// The defect.
    pub reason: &'static str,
}

/// A process in words.
fn process(holder: Option<u32>) -> String {
    holder.map_or_else(|| "another process".to_owned(), |pid| format!("process {pid}"))
}

impl Error {
    /// Attaches a path to an error of the system.
    pub(crate) fn at(path: &std::path::Path) -> impl FnOnce(std::io::Error) -> Error {
        move |source| Error::File { path: path.to_path_buf(), source }
    }
}
