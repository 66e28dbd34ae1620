//! `cargo xtask`: the repository's commands by short names, and its rules.
//!
//! This program has no dependencies, so that `cargo xtask tidy` builds in seconds. A command that computes
//! is part of a program in `crates/`; `cargo xtask` builds that program and becomes it.

mod check_builds;
mod check_certificates;
mod check_dependencies;
mod check_explorer;
mod check_formal;
mod check_python;
mod commands;
mod error;
mod explore;
mod explorer_build;
mod explorer_file;
mod process;
mod python_environment;
mod python_release;
mod regenerate;
mod release;
mod repository;
mod site;
mod static_server;
mod tidy;

use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    match commands::run(&arguments) {
        Ok(code) => code,
        Err(error) => {
            use std::io::Write;
            // If standard error is closed, the exit status is the only message.
            let _ = writeln!(std::io::stderr(), "error: {error}");
            ExitCode::FAILURE
        }
    }
}
