//! The code that the programs of this repository share: the place of its files, the writing of results, and the output
//! on a terminal.
//!
//! | item | role |
//! |---|---|
//! | [`repository`] | the root of the repository, which is known from the build |
//! | [`Folder`], [`results_folder`] | a folder for results; each file is written whole or not at all |
//! | [`read`], [`parse_rows`], [`number`] | text files; files of reference values, one JSON object a line |
//! | [`say`], [`Progress`] | lines on standard output; progress on standard error |
//! | [`exit_code`] | the end of a program: its error as one line, its exit status |

mod error;
mod output;
mod progress;
mod reference_rows;
mod terminal;

pub use error::Error;
pub use output::{Folder, read, repository, results_folder};
pub use progress::{Bar, Progress};
pub use reference_rows::{number, numbered_rows, parse_rows, whole};
pub use terminal::{exit_code, say};
