//! Measurements of the hopper's computations: their error against reference values of 40 digits, their speed, and both
//! compared with other people's software.
//!
//! The program `hopper-measurements` runs the commands; `cargo xtask COMMAND` starts it.
//!
//! | module | question |
//! |---|---|
//! | [`commands`] | the commands, one file each |
//! | `reference` | which question and which answer does a line of a reference file contain? |
//! | `bounds` | is every error bound at least the actual error? |
//! | `coverage` | how often does every interval of `basin-of-attraction` contain the true number? |
//! | `work_precision` | how much time and error does each way to compute a hop have? |
//! | `speed` | how fast are hops and rasters, with their output checked first? |
//! | `scale` | what do rasters of growing size cost, and what do many workers gain? |
//! | `peers` | how do heyoka, SciPy and numba compare on the same hops? |
//! | `events` | which events of known scenes do SciPy, heyoka, diffsol and this repository find? |

mod bounds;
pub mod cli;
pub mod commands;
mod coverage;
mod error;
mod events;
mod peers;
mod reference;
mod scale;
mod speed;
mod text;
mod timing;
mod work_precision;

pub use error::Error;
