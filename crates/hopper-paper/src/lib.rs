//! The paper recomputed: its figures, its claims, results beyond it, and the reports of both.
//!
//! The program `hopper-paper` runs the commands; `cargo xtask COMMAND` starts it.
//!
//! | item | role |
//! |---|---|
//! | [`figures`] | the figures of the paper, one file each |
//! | [`claims`] | every claim of the paper, checked |
//! | [`beyond`] | results that the paper does not have, each with a figure and a table |
//! | [`models`] | figures of the generic crates |
//! | [`report`] | `report.html` |
//! | [`commands`] | the commands, one file each |
//! | [`job`] | finished pieces of long computations, stored on disk |

pub mod beyond;
mod choice;
pub mod claims;
pub mod cli;
pub mod commands;
mod comparison;
mod error;
mod figure;
pub mod figures;
mod independent;
pub mod job;
pub mod models;
mod proved_figure;
pub mod report;

pub use error::Error;
pub use figure::Figure;

/// The place of every part of the paper in this repository: equations, figures and numbers, with functions, tests and
/// figure files. The page is compiled, so that a rename breaks the build of the documentation.
#[doc = include_str!("../../../docs/paper-map.md")]
pub mod paper_map {}

/// The README's code, compiled and run.
#[doc = include_str!("../../../README.md")]
#[cfg(doctest)]
pub mod readme {}
