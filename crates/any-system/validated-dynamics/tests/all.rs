#![allow(missing_docs, clippy::unwrap_used, clippy::expect_used, clippy::panic)]
//! All tests of this crate in one program.

mod attacked;
mod basins;
mod certificates;
mod closed_forms;
mod models;
mod periodic_orbits;
mod undecided;
