//! The same hops, and the same basins, by heyoka, SciPy, NumPy, numba and this repository, in one run on one machine.

mod arrays;
mod basins;
mod compare;
mod figure;
mod peer;
mod python;
mod systems;
mod table;

pub(crate) use arrays::{array_times, arrays_markdown};
pub(crate) use basins::{basin_times, basins_markdown};
pub(crate) use compare::measure;
pub(crate) use figure::peers_figure;
pub(crate) use python::{Python, call, results};
pub(crate) use systems::{system_times, systems_markdown};
pub(crate) use table::{csv, markdown};
