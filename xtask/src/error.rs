//! Errors of the commands.

use std::ffi::OsString;
use std::fmt;
use std::path::PathBuf;

/// Why a command failed.
#[derive(Debug)]
pub(crate) enum Error {
    /// No command was named.
    NoCommand { known: String },
    /// A command that does not exist.
    UnknownCommand { name: String, known: String },
    /// An option that this program does not have.
    UnknownOption { command: &'static str, option: String },
    /// Cargo could not be started.
    Cargo { program: OsString, source: std::io::Error },
    /// A file could not be read, or standard output not be written.
    File { path: PathBuf, source: std::io::Error },
    /// Python, its virtual environment or its packages are missing.
    Python { program: PathBuf, reason: String },
    /// The explorer could not be built, served or tested.
    Explorer(String),
    /// A program of the certificates failed; it has printed what.
    Certificates(&'static str),
    /// Packages from outside break a rule, or could not be checked.
    Dependencies(String),
    /// Builds failed; each has been printed with the compiler's messages.
    Builds(usize),
    /// The workspace's manifest promises no oldest Rust.
    NoRustVersion,
    /// Rules of the repository are broken; each breach has been printed.
    Breaches(usize),
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::NoCommand { known } => write!(f, "no command is named; there are: {known}"),
            Error::UnknownCommand { name, known } => {
                write!(f, "there is no command '{name}'; there are: {known}")
            }
            Error::UnknownOption { command, option } => {
                write!(f, "`cargo xtask {command}` has no option '{option}'; leave it out")
            }
            Error::Cargo { program, source } => {
                write!(f, "{} cannot be started: {source}", program.to_string_lossy())
            }
            Error::File { path, source } => write!(f, "{}: {source}", path.display()),
            Error::Python { program, reason } => write!(
                f,
                "{} failed ({reason}); install Python 3.11 or newer with its venv module and let pip reach a package \
                 index, or name another interpreter with PYTHON=/path/to/python3",
                program.display()
            ),
            Error::Explorer(reason) => write!(f, "the explorer: {reason}"),
            Error::Certificates(name) => write!(f, "{name} failed; its messages stand above"),
            Error::Dependencies(reason) => write!(f, "packages from outside: {reason}"),
            Error::Builds(count) => write!(f, "{count} builds failed"),
            Error::NoRustVersion => {
                write!(f, "Cargo.toml has no rust-version; write the oldest Rust that is supported")
            }
            Error::Breaches(count) => write!(f, "{count} breaches of the repository's rules"),
        }
    }
}
