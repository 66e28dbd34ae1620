//! `hopper`.

use std::process::ExitCode;

fn main() -> ExitCode {
    passive_hopper_cli::main()
}
