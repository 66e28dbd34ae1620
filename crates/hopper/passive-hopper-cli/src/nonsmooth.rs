//! `nonsmooth`.

use std::process::ExitCode;

fn main() -> ExitCode {
    passive_hopper_cli::nonsmooth_main()
}
