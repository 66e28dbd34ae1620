//! The tests of this crate are one program: what they share is compiled once, and the tests of all files run side by
//! side.

#![allow(missing_docs, clippy::panic, clippy::unwrap_used)]

mod check_bounds;
mod check_reference;
mod generic_tools;
mod reproduce_paper;
mod two_reports;
