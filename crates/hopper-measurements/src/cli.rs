//! The command line.

use crate::commands;
use crate::error::Error;
use clap::{Parser, Subcommand};

/// Error and speed of the hopper's computations, measured.
#[derive(Debug, Parser)]
// The usage lines show the command that the user types: `cargo xtask` starts this program.
#[command(name = "hopper-measurements", bin_name = "cargo xtask", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compare the map and the fates with files of reference values
    CheckReference(commands::check_reference::Options),
    /// Compare every error bound with the actual error, on millions of hops
    CheckBounds(commands::check_bounds::Options),
    /// Measure how often every interval of `basin-of-attraction` contains the true number
    IntervalCoverage(commands::interval_coverage::Options),
    /// Measure time against error of every way to compute a hop
    WorkPrecision(commands::work_precision::Options),
    /// Measure how fast hops and rasters are; the output of each is checked first
    Speed(commands::speed::Options),
    /// Measure the CPU time of rasters by size, and simulate many workers with it
    Scale(commands::scale::Options),
    /// Compare with heyoka, SciPy and numba on the same hops: needs Python and its package index
    ComparePeers(commands::compare_peers::Options),
    /// Compare the events of known scenes with SciPy, heyoka and diffsol: needs Python and both package indices
    CompareEvents(commands::compare_events::Options),
}

/// Runs the command line.
pub fn run() -> Result<(), Error> {
    match Cli::parse().command {
        Command::CheckReference(options) => commands::check_reference::run(&options),
        Command::CheckBounds(options) => commands::check_bounds::run(&options),
        Command::IntervalCoverage(options) => commands::interval_coverage::run(&options),
        Command::WorkPrecision(options) => commands::work_precision::run(&options),
        Command::Speed(options) => commands::speed::run(&options),
        Command::Scale(options) => commands::scale::run(&options),
        Command::ComparePeers(options) => commands::compare_peers::run(&options),
        Command::CompareEvents(options) => commands::compare_events::run(&options),
    }
}
