//! How sure is a number, and which exponent has a law?
//!
//! `bounds` hold for certain, `confidence_interval` in 95 % of samples, `power_law` has exponents with all local slopes. `split_mix` makes the random
//! numbers, and `least_squares` fits lines.

pub(crate) mod bounds;
pub(crate) mod confidence_interval;
pub(crate) mod least_squares;
pub(crate) mod power_law;
pub(crate) mod split_mix;
