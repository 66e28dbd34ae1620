//! The events of the same scenes by SciPy, heyoka, diffsol and this repository, against known answers.

mod answers;
mod diffsol;
mod found;
mod model_lines;
mod ours;
mod table;
mod verdict;

pub(crate) use answers::answers;
pub(crate) use diffsol::run_diffsol;
pub(crate) use found::{by_diffsol, by_python, by_us};
pub(crate) use table::{csv, markdown, totals};
pub(crate) use verdict::verdict;
