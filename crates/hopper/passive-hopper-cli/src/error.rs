//! Refusals and failures, with their exit status.

use std::path::PathBuf;
use thiserror::Error;

/// Why a call ended early.
#[derive(Debug, Error)]
#[non_exhaustive]
pub(crate) enum Error {
    /// The call is wrong. The text names the option, the value, the limit and the remedy.
    #[error("{0}")]
    Misuse(String),
    /// A line of the input is wrong.
    #[error("standard input, line {line}, '{text}': {reason}")]
    Input {
        /// The line, from one.
        line: u64,
        /// Its text, shortened.
        text: String,
        /// What is wrong, and the remedy.
        reason: String,
    },
    /// A file, a folder or a stream could not be read or written.
    #[error("{path}: {source}")]
    File {
        /// The file.
        path: PathBuf,
        /// The system's message.
        source: std::io::Error,
    },
    /// The reader of the output has closed it: what it wanted has been written.
    #[error("the reader closed the output")]
    ClosedOutput,
    /// A hop could not be computed.
    #[error(transparent)]
    Hopper(#[from] passive_hopper::Error),
    /// A fate or a basin could not be computed.
    #[error(transparent)]
    Basin(#[from] hopper_basin::Error),
    /// A basin could not be enclosed.
    #[error(transparent)]
    Proof(#[from] hopper_proof::Error),
    /// A file could not be written, or another run is at work in its folder.
    #[error(transparent)]
    Job(#[from] resumable_job::Error),
    /// A figure could not be drawn.
    #[error(transparent)]
    Drawing(#[from] hopper_figures::Error),
    /// An interval, a grid or an estimate was refused.
    #[error(transparent)]
    Interval(#[from] basin_of_attraction::Error),
    /// An expansion could not be evaluated.
    #[error(transparent)]
    Asymptotics(#[from] hopper_asymptotics::Error),
    /// Pieces of a job are missing, so that they cannot be joined. The text says which, and how to get them.
    #[error("{0}")]
    MissingPieces(String),
    /// A finished piece is whole, and yet not what it should be.
    #[error("{0}; remove its folder, or add --force, and run again")]
    Unreadable(String),
    /// Files of a job are not as they were written.
    #[error(
        "{count} of the files are damaged; the first: {first}; `hopper basins --out {folder}` computes them again"
    )]
    Damaged {
        /// How many.
        count: usize,
        /// The first one, and what is wrong.
        first: String,
        /// The folder.
        folder: String,
    },
    /// A signal has asked the program to stop.
    #[error("interrupted: {done}; the same call, given again, goes on")]
    Interrupted {
        /// The exit status of the signal.
        status: u8,
        /// How far the job is.
        done: String,
    },
    /// A signal has ended a search that keeps nothing.
    #[error("interrupted: nothing of the search is kept; the same call, given again, begins anew")]
    Ended {
        /// The exit status of the signal.
        status: u8,
    },
    /// A model of a file could not be followed, or a statement about it is not proved: in the words of the library.
    #[error("{0}")]
    Model(String),
    /// Results are undecided, and --strict was given.
    #[error("{count} of the results are undecided (--strict); the output says which")]
    Undecided {
        /// How many.
        count: u64,
    },
    /// A figure could not be encoded.
    #[error(transparent)]
    Figure(#[from] journal_figures::Error),
}

impl Error {
    /// The same for a call that keeps no pieces.
    pub(crate) fn without_pieces(self) -> Self {
        match self {
            Error::Interrupted { status, .. } => Error::Ended { status },
            other => other,
        }
    }

    /// The exit status: 1 for a failure, 2 for a wrong call, 0 if the reader of the output has gone, 130 or 143
    /// after a signal.
    pub(crate) fn exit_status(&self) -> u8 {
        match self {
            Error::ClosedOutput => 0,
            Error::Misuse(_) | Error::Input { .. } => 2,
            Error::Interrupted { status, .. } | Error::Ended { status } => *status,
            _ => 1,
        }
    }

    /// The refusal of an option: "--window 3 2: the window must …; give …".
    pub(crate) fn misuse(option: &str, value: impl std::fmt::Display, reason: &str) -> Self {
        let value = value.to_string();
        // An empty value is shown as such.
        let value = if value.is_empty() { "''" } else { value.as_str() };
        Error::Misuse(format!("{option} {value}: {reason}"))
    }

    /// The error of writing to standard output.
    pub(crate) fn output(source: std::io::Error) -> Self {
        if source.kind() == std::io::ErrorKind::BrokenPipe {
            return Error::ClosedOutput;
        }
        Error::File { path: "standard output".into(), source }
    }
}
