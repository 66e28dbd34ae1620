//! The command line.

use crate::commands as c;
use crate::error::Error;
use clap::{Parser, Subcommand};

/// The paper recomputed, results beyond it, and the error and speed of the computations, measured.
#[derive(Debug, Parser)]
// The usage lines show the command that the user types: `cargo xtask` starts this program.
#[command(name = "hopper-studies", bin_name = "cargo xtask", version, about)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// The commands, each with its options and the function that runs it: the enumeration of clap, and the call.
macro_rules! commands {
    ($($(#[doc = $about:literal])+ $name:ident: $module:ident,)+) => {
        #[derive(Debug, Subcommand)]
        enum Command {
            $($(#[doc = $about])+ $name(c::$module::Options),)+
        }

        /// Runs the command line.
        pub fn run() -> Result<(), Error> {
            match Cli::parse().command {
                $(Command::$name(options) => c::$module::run(&options),)+
            }
        }
    };
}

commands! {
    /// Compute every figure and number of the paper, check every claim, write a report
    ReproducePaper: reproduce_paper,
    /// Check only the invariance under M → 1/M, with its figure
    VerifyInvariance: verify_invariance,
    /// Compute results about the basins that the paper does not have, with a report
    BeyondPaper: beyond_paper,
    /// Prove theorems about the basins, by interval arithmetic
    Prove: prove,
    /// Draw figures of the generic crates: how guards are met, and a valve's bifurcations
    ModelFigures: model_figures,
    /// Compare the map and the fates with files of reference values
    CheckReference: check_reference,
    /// Compare every error bound with the actual error, on millions of hops
    CheckBounds: check_bounds,
    /// Measure how often every interval of `basin-of-attraction` contains the true number
    IntervalCoverage: interval_coverage,
    /// Measure time against error of every way to compute a hop
    WorkPrecision: work_precision,
    /// Measure how fast hops and rasters are; the output of each is checked first
    Speed: speed,
    /// Measure the CPU time of rasters by size, and simulate many workers with it
    Scale: scale,
    /// Compare with heyoka, SciPy and numba on the same hops: needs Python and its package index
    ComparePeers: compare_peers,
    /// Compare the events of known scenes with SciPy, heyoka and diffsol: needs Python and both package indices
    CompareEvents: compare_events,
}
