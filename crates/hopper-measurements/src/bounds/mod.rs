//! Is every error bound of the libraries at least the actual error?
//!
//! Each file measures one group of bounds against longer arithmetic. `cargo xtask check-bounds` runs all groups.

pub(crate) mod expansions;
pub(crate) mod fates;
pub(crate) mod hops;
pub(crate) mod measured;
