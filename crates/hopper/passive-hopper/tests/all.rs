//! The tests of this crate are one program: what they share is compiled once, and the tests of all files run side by
//! side.

#![allow(missing_docs, clippy::disallowed_methods, clippy::panic, clippy::unwrap_used)]

mod bits;
mod bounded_orbit;
mod enclosed_hop;
mod hard_hops;
#[cfg(feature = "hybrid-system")]
mod hybrid_system;
mod lift_off_map;
mod many_at_once;
mod mass_errors;
mod near_fixed_point;
mod slopes;
