//! Studies of the passive hopper: its paper recomputed, results beyond the paper, and measurements of error and speed.
//!
//! The program `hopper-studies` runs the commands; `cargo xtask COMMAND` starts it. No other crate uses this one.
//!
//! | module | question |
//! |---|---|
//! | `commands` | the commands, one file each |
//! | `figures` | what does each figure of the paper show, computed anew? |
//! | `claims`, `independent` | does every claim of the paper hold, by code that does not contain it? |
//! | `beyond` | which results does the paper not have? each with a figure and a table |
//! | `models` | how do the generic crates meet guards? figures for their pages |
//! | `comparison` | are new figures the committed ones: numbers, pixels, drawings? |
//! | `reference` | which question and which answer does a line of a reference file contain? |
//! | `bounds` | is every error bound at least the actual error? |
//! | `coverage` | how often does every interval of `basin-of-attraction` contain the true number? |
//! | `work_precision` | how much time and error does each way to compute a hop have? |
//! | `speed` | how fast are hops and rasters, with their output checked first? |
//! | `scale` | what do rasters of growing size cost, and what do many workers gain? |
//! | `peers`, `events`, `motions` | how do heyoka, SciPy, numba and diffsol compare on the same hops, scenes and motions? |
//! | `repository` | where are the repository's files, and how do commands print? |

mod beyond;
mod bounds;
mod choice;
mod claims;
mod cli;
mod commands;
mod comparison;
mod coverage;
mod error;
mod events;
mod figure;
mod figures;
mod independent;
mod job;
mod models;
mod motions;
mod peers;
mod proved_figure;
mod reference;
mod report;
mod repository;
mod scale;
mod speed;
mod text;
mod timing;
mod work_precision;

pub use cli::run;
pub use error::Error;
pub use repository::exit_code;

/// The place of every part of the paper in this repository: equations, figures and numbers, with functions, tests and
/// figure files. The page is compiled, so that a rename breaks the build of the documentation.
#[doc = include_str!("../../../../docs/paper-map.md")]
pub mod paper_map {}

/// The README's code, compiled and run.
#[doc = include_str!("../../../../README.md")]
#[cfg(doctest)]
pub mod readme {}
