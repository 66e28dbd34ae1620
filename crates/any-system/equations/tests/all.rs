//! One program for all tests of this crate: it links once.
#![allow(clippy::unwrap_used)]

mod known_functions;
mod models;
mod random_formulas;
mod reading;
mod refusals;
mod taylor_flows;
mod user_functions;
