//! Which arithmetics compute a hop?
//!
//! ```text
//!   real.rs              Real: the operations that the formulas of a flight need; f64. Extended: longer numbers
//!   double_double.rs     106 bits, as the sum of two f64
//!   long/                256, 512 or 1024 bits
//!   ball.rs              a number with a bound on its error
//!   nearest_integer.rs   rounding to an integer without a branch
//! ```
//!
//! This room uses no other room.

pub(crate) mod ball;
pub(crate) mod double_double;
pub(crate) mod long;
pub(crate) mod nearest_integer;
pub(crate) mod real;
