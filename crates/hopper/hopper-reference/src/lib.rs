//! The hopper's reference values, for tests and for `cargo xtask check-reference`.
//!
//! | item | role |
//! |---|---|
//! | [`rows`], [`Row`] | the lines of a reference file, for tests |
//! | [`error_unit`], [`UNITS_PER_FLIGHT`] | the unit in which an error of α′ is judged, and the units that a flight may have |
//!
//! The methods of [`Row`] panic on a line that lacks a value: a test that reads it must fail.

mod row;
mod unit;

pub use row::{Row, map, rows};
pub use unit::{UNITS_PER_FLIGHT, error_unit};
