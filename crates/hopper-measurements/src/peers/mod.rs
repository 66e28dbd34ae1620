//! The same hops by other people's software, side by side in one run.

mod compare;
mod figure;
mod peer;
mod python;
mod table;

pub(crate) use compare::measure;
pub(crate) use figure::peers_figure;
pub(crate) use python::Python;
pub(crate) use table::{csv, markdown};
