//! Starting other programs: in place of this one, as a step, or to ask whether they succeed; and what is said of them.

use crate::error::Error;
use std::ffi::OsString;
use std::io::Write;
use std::process::{Command, ExitCode, Stdio};

/// Replaces this process, so that signals reach the program itself and its exit status is the exit status of the
/// command.
#[cfg(unix)]
pub(crate) fn become_program(command: &mut Command) -> Result<ExitCode, Error> {
    // `exec` returns only if the program could not be started.
    let source = std::os::unix::process::CommandExt::exec(command);
    Err(Error::starting(command.get_program())(source))
}

/// Waits for the program and returns its exit status. Ctrl-C reaches both processes.
#[cfg(not(unix))]
pub(crate) fn become_program(command: &mut Command) -> Result<ExitCode, Error> {
    let status = command.status().map_err(Error::starting(command.get_program()))?;
    let code = status.code().and_then(|code| u8::try_from(code).ok());
    Ok(code.map_or(ExitCode::FAILURE, ExitCode::from))
}

/// Whether a program can be started and succeeds; it prints to no one.
pub(crate) fn succeeds(command: &mut Command) -> bool {
    let quiet = command.stdout(Stdio::null()).stderr(Stdio::null());
    quiet.status().is_ok_and(|status| status.success())
}

/// Cargo, the one that started this program.
pub(crate) fn cargo() -> OsString {
    std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// The option with the profile in which programs of the workspace run: release, or the one that the variable
/// `XTASK_PROFILE` names. The gate names `dev`, in which the tests have built them before.
pub(crate) fn profile() -> OsString {
    let named = std::env::var_os("XTASK_PROFILE").filter(|name| !name.is_empty());
    let mut option = OsString::from("--profile=");
    option.push(named.unwrap_or_else(|| "release".into()));
    option
}

/// Runs a step to its end; its own messages stand above the error.
pub(crate) fn step(command: &mut Command, what: &str) -> Result<(), Error> {
    let status = command.status().map_err(Error::starting(command.get_program()))?;
    match status.success() {
        true => Ok(()),
        false => Err(failed(what, &status.to_string())),
    }
}

/// Runs steps side by side. Their messages are printed in this order when all have ended.
pub(crate) fn steps(commands: Vec<(Command, &str)>) -> Result<(), Error> {
    let output = |mut command: Command| {
        let output = command.output();
        output.map_err(Error::starting(command.get_program()))
    };
    std::thread::scope(|scope| {
        let running =
            commands.into_iter().map(|(command, what)| (what, scope.spawn(|| output(command))));
        // All begin before the first is waited for, and all end before an error is returned.
        let running: Vec<_> = running.collect();
        let found: Vec<_> = running.into_iter().map(|(what, step)| (what, step.join())).collect();
        for (what, found) in found {
            let found = found.unwrap_or_else(|_| Err(failed(what, "a panic")))?;
            std::io::stdout().write_all(&found.stdout).map_err(Error::at("standard output"))?;
            std::io::stderr().write_all(&found.stderr).map_err(Error::at("standard error"))?;
            if !found.status.success() {
                return Err(failed(what, &found.status.to_string()));
            }
        }
        Ok(())
    })
}

fn failed(what: &str, how: &str) -> Error {
    Error::new(format!("{what} failed ({how}); its messages stand above"))
}

/// A line for the user.
pub(crate) fn say(line: &str) -> Result<(), Error> {
    writeln!(std::io::stdout(), "{line}").map_err(Error::at("standard output"))
}

/// Says that a command cannot do its work here.
pub(crate) fn skip(what: &str, reason: &str) -> Result<ExitCode, Error> {
    print(&format!("SKIPPED {what}: {reason}"))
}

/// A text that is all the answer.
pub(crate) fn print(text: &str) -> Result<ExitCode, Error> {
    say(text.trim_end())?;
    Ok(ExitCode::SUCCESS)
}
