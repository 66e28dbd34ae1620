//! One program for all tests of this crate: it links once.
#![allow(clippy::unwrap_used)]

mod bits;
mod known_functions;
mod known_maps;
mod models;
mod random_formulas;
mod reading;
mod refusals;
mod taylor_flows;
mod user_functions;
