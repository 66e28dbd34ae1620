//! The workspace's tasks: `cargo xtask --help`.
//!
//! The libraries compute. Only this code prints and draws; it writes files through `resumable-job`.

pub mod beyond;
pub mod claims;
pub mod commands;
mod error;
pub mod figures;
pub mod models;
pub mod output;
mod peers;
pub mod plot;
pub mod progress;
mod reference;
pub mod report;
mod speed;
mod work_precision;

pub use error::Error;

/// Where everything of the paper is: equations, figures and numbers, with functions, tests and
/// figure files. Compiled, so that a rename breaks the build of the docs.
#[doc = include_str!("../../docs/paper-map.md")]
pub mod paper_map {}

/// The README's code, compiled and run.
#[doc = include_str!("../../README.md")]
#[cfg(doctest)]
pub mod readme {}

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

/// Figures, claims and rules of the hybrid-hopper workspace.
#[derive(Debug, Parser)]
#[command(name = "cargo xtask", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compute every figure and number of the paper, check every claim, write a report
    ReproducePaper(commands::reproduce_paper::Options),
    /// Check the invariance under M → 1/M alone, with its figure
    VerifyInvariance(commands::verify_invariance::Options),
    /// Compute the basins over any window, in tiles that survive a kill
    BasinRaster(commands::basin_raster::Options),
    /// Compute what the paper could not say of the basins, with a report
    BeyondPaper(commands::beyond_paper::Options),
    /// Draw what the generic crates do: how guards are met, and a valve's bifurcations
    ModelFigures(commands::model_figures::Options),
    /// Compare the map and the fates with files of reference values
    CheckReference(commands::check_reference::Options),
    /// Measure time against error of every way to compute a hop
    WorkPrecision(commands::work_precision::Options),
    /// Measure how fast hops and rasters are, each after its output was checked
    Speed(commands::speed::Options),
    /// Compare with heyoka, SciPy and numba on the same hops: needs Python and its package index
    ComparePeers(commands::compare_peers::Options),
    /// Check the repository's rules
    Tidy,
}

/// The command line; an unknown command lists what exists.
fn command() -> Result<Command, Error> {
    match Cli::try_parse() {
        Ok(cli) => Ok(cli.command),
        Err(error) if error.kind() == ErrorKind::InvalidSubcommand => {
            let name = std::env::args().nth(1).unwrap_or_default();
            let commands = Cli::command();
            let known: Vec<&str> =
                commands.get_subcommands().map(clap::Command::get_name).collect();
            Err(Error::UnknownName { kind: "command", name, known: known.join(", ") })
        }
        Err(error) => error.exit(),
    }
}

/// Runs the command line.
pub fn run() -> Result<(), Error> {
    match command()? {
        Command::ReproducePaper(options) => commands::reproduce_paper::run(&options),
        Command::VerifyInvariance(options) => commands::verify_invariance::run(&options),
        Command::BasinRaster(options) => commands::basin_raster::run(&options),
        Command::BeyondPaper(options) => commands::beyond_paper::run(&options),
        Command::ModelFigures(options) => commands::model_figures::run(&options),
        Command::CheckReference(options) => commands::check_reference::run(&options),
        Command::WorkPrecision(options) => commands::work_precision::run(&options),
        Command::Speed(options) => commands::speed::run(&options),
        Command::ComparePeers(options) => commands::compare_peers::run(&options),
        Command::Tidy => commands::tidy::run(),
    }
}
