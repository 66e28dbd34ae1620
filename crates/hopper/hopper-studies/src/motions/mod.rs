//! Time against error of motions with known answers, by SciPy, heyoka, diffsol and this repository.

mod fields;
mod hard;
mod measured;
mod ours;
mod scene;
mod table;

pub(crate) use hard::markdown as hard_motions;
pub(crate) use measured::{by_diffsol, by_python, by_us};
pub(crate) use table::{csv, markdown};
