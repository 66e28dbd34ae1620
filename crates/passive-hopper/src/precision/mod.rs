//! Which numbers can a hop be computed with?
//!
//! ```text
//!   real.rs              Real: what the formulas of a flight ask of a number; f64. Extended: longer numbers
//!   double_double.rs     106 bits, as the sum of two f64
//!   long/                256, 512 or 1024 bits
//!   nearest_integer.rs   rounding to an integer without a branch
//! ```
//!
//! This room uses no other one.

pub(crate) mod double_double;
pub(crate) mod long;
pub(crate) mod nearest_integer;
pub(crate) mod real;
