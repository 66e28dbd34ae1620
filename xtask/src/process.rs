//! How this program becomes another one.

use std::process::{Command, ExitCode};

/// Replaces this process, so that a signal meets the program itself and its exit status is ours.
#[cfg(unix)]
pub(crate) fn become_program(command: &mut Command) -> Result<ExitCode, std::io::Error> {
    // It returns only if the program could not be started.
    Err(std::os::unix::process::CommandExt::exec(command))
}

/// Waits for the program and takes over its exit status. Ctrl-C reaches both processes.
#[cfg(not(unix))]
pub(crate) fn become_program(command: &mut Command) -> Result<ExitCode, std::io::Error> {
    let code = command.status()?.code().and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}
