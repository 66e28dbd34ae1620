//! Starting other programs: in place of this one, or to ask whether they succeed.

use std::process::{Command, ExitCode, Stdio};

/// Replaces this process, so that signals reach the program itself and its exit status is the exit status of the
/// command.
#[cfg(unix)]
pub(crate) fn become_program(command: &mut Command) -> Result<ExitCode, std::io::Error> {
    // `exec` returns only if the program could not be started.
    Err(std::os::unix::process::CommandExt::exec(command))
}

/// Waits for the program and returns its exit status. Ctrl-C reaches both processes.
#[cfg(not(unix))]
pub(crate) fn become_program(command: &mut Command) -> Result<ExitCode, std::io::Error> {
    let code = command.status()?.code().and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}

/// Whether a program can be started and succeeds; it prints to no one.
pub(crate) fn succeeds(command: &mut Command) -> bool {
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}
