//! `cargo xtask regenerate`: the Python programs of `xtask/generators`, in a virtual environment of their own.

use crate::error::Error;
use crate::process::become_program;
use crate::python_environment::{environment_python, first_python, no_python};
use crate::repository::repository;
use std::ffi::OsString;
use std::process::{Command, ExitCode};

/// Runs `regenerate.py` with these arguments.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let scripts = repository().join("xtask/generators");
    let environment = repository().join("target/generators");
    let list = scripts.join("requirements.txt");
    let python = environment_python(&first_python(), &environment, &list)?;
    let mut command = Command::new(&python);
    // Without this, Python would write its compiled files into the repository.
    command.env("PYTHONDONTWRITEBYTECODE", "1");
    command.arg(scripts.join("regenerate.py")).args(arguments);
    become_program(&mut command).map_err(|error| no_python(&python, &error.to_string()))
}
