//! Arithmetic longer than `f64`: double-double, 256 to 1024 bits, and what both have in common.

pub(crate) mod double_double;
pub(crate) mod long;
pub(crate) mod real;
