//! `hopper-studies`.

use std::process::ExitCode;

fn main() -> ExitCode {
    hopper_studies::exit_code(hopper_studies::run())
}
