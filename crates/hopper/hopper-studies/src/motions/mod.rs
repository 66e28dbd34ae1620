//! Time against error of motions with known answers, by SciPy, heyoka, diffsol and this repository.

mod measured;
mod ours;
mod scene;
mod table;

pub(crate) use measured::{by_diffsol, by_python, by_us};
pub(crate) use table::{csv, markdown};
