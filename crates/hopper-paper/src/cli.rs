//! The command line.

use crate::commands;
use crate::error::Error;
use clap::{Parser, Subcommand};

/// The paper recomputed: figures, claims, and results beyond it.
#[derive(Debug, Parser)]
// The usage lines show the command that the user types: `cargo xtask` starts this program.
#[command(name = "hopper-paper", bin_name = "cargo xtask", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Compute every figure and number of the paper, check every claim, write a report
    ReproducePaper(commands::reproduce_paper::Options),
    /// Check only the invariance under M → 1/M, with its figure
    VerifyInvariance(commands::verify_invariance::Options),
    /// Compute results about the basins that the paper does not have, with a report
    BeyondPaper(commands::beyond_paper::Options),
    /// Prove theorems about the basins, by interval arithmetic
    Prove(commands::prove::Options),
    /// Draw figures of the generic crates: how guards are met, and a valve's bifurcations
    ModelFigures(commands::model_figures::Options),
}

/// Runs the command line.
pub fn run() -> Result<(), Error> {
    match Cli::parse().command {
        Command::ReproducePaper(options) => commands::reproduce_paper::run(&options),
        Command::VerifyInvariance(options) => commands::verify_invariance::run(&options),
        Command::BeyondPaper(options) => commands::beyond_paper::run(&options),
        Command::Prove(options) => commands::prove::run(&options),
        Command::ModelFigures(options) => commands::model_figures::run(&options),
    }
}
