//! The output of a program on the terminal, and its exit status.

use crate::error::Error;
use std::fmt::Display;
use std::io::Write;
use std::process::ExitCode;

/// Writes a line to standard output.
///
/// # Errors
/// [`Error::File`] if standard output is closed or full, so that a program in a pipe ends with a message.
pub(crate) fn say(line: impl Display) -> Result<(), Error> {
    writeln!(std::io::stdout().lock(), "{line}").map_err(Error::at("standard output"))
}

/// The exit status of a program: 0, or 1 after its error is written to standard error as one line.
pub fn exit_code<E: Display>(result: Result<(), E>) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // If standard error is closed, the exit status is the only message.
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}
