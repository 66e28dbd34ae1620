//! `hopper`.

use std::process::ExitCode;

fn main() -> ExitCode {
    hopper::main()
}
