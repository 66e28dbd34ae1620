//! Where is the repository, and how do commands read its files, write results and print?
//!
//! - `output.rs`: its root, which is known from the build, and folders whose files are written whole or not at all;
//! - `reference_rows.rs`: files of reference values, one JSON object a line;
//! - `terminal.rs`: lines on standard output, and the exit status of a program;
//! - `progress.rs`: progress on standard error.

mod output;
mod progress;
mod reference_rows;
mod terminal;

pub(crate) use output::{Folder, read, repository, results_folder};
pub(crate) use progress::{Bar, Progress};
pub(crate) use reference_rows::{number, numbered_rows, parse_rows, whole};
pub use terminal::exit_code;
pub(crate) use terminal::say;
