//! `hopper-measurements`.

use std::process::ExitCode;

fn main() -> ExitCode {
    repository_tools::exit_code(hopper_measurements::cli::run())
}
