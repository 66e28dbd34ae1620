//! The tests of this crate are one program: what they share is compiled once, and the tests of all files run side by
//! side.

#![allow(missing_docs)]

mod basins;
mod certificates;
mod hops_against_reference;
mod theorems;
