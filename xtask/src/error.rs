//! Why a command failed, as a sentence: nothing here asks for more.

use std::fmt;
use std::path::Path;

/// The sentence.
#[derive(Debug)]
pub(crate) struct Error(String);

impl Error {
    pub(crate) fn new(text: impl Into<String>) -> Self {
        Error(text.into())
    }

    /// A file that cannot be read or written.
    pub(crate) fn at(path: impl AsRef<Path>) -> impl Fn(std::io::Error) -> Self {
        let path = path.as_ref().to_path_buf();
        move |source| Error(format!("{}: {source}", path.display()))
    }

    /// A program that cannot be started.
    pub(crate) fn starting(program: impl AsRef<Path>) -> impl Fn(std::io::Error) -> Self {
        let program = program.as_ref().to_path_buf();
        move |source| Error(format!("{} cannot be started: {source}", program.display()))
    }

    pub(crate) fn unknown_option(command: &str, option: &str) -> Self {
        Error(format!("`cargo xtask {command}` has no option '{option}'; leave it out"))
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}
