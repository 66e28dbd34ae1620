//! The programs `hopper`, the passive hopper at the command line, and `nonsmooth`, any hybrid system from a file.
//!
//! ```text
//!   arguments ──► cli.rs ──► commands/NAME.rs ──► a library ──► Table ──► plain text, CSV or JSON
//! ```
//!
//! The program holds no mathematics: a command reads its arguments, asks a library, and prints tables or writes
//! figures.
//!
//! | item | role |
//! |---|---|
//! | [`run`], [`Streams`] | one call of the program, with the streams that it reads and writes |
//! | [`main`] | the same with the streams of the process |
//! | [`run_nonsmooth`], [`nonsmooth_main`] | the same of `nonsmooth` |
//!
//! ```
//! let (mut output, mut messages) = (Vec::new(), Vec::new());
//! let streams = passive_hopper_cli::Streams {
//!     input: &mut std::io::empty(),
//!     input_is_terminal: false,
//!     output_has_colors: false,
//!     output: &mut output,
//!     messages: &mut messages,
//! };
//! let code = passive_hopper_cli::run(["hopper", "hop", "5.5", "-M", "0.2", "--csv"].map(Into::into), streams);
//! assert_eq!(code, 0);
//! assert!(String::from_utf8_lossy(&output).contains("3.78336571334506"));
//! ```
//!
//! # Exit status
//! 0: done. 1: failed. 2: the call or its input is wrong. 130 and 143: interrupted; the same call continues, or
//! begins anew if it writes no folder.

mod basins;
mod cli;
mod commands;
mod error;
mod interrupt;
mod model;
mod options;
mod output;
mod program;
mod refusal;
mod streams;

pub use program::{main, nonsmooth_main, run, run_nonsmooth};
pub use streams::Streams;
