//! Is every error bound of the libraries at least the actual error?
//!
//! `cargo xtask check-bounds` runs the groups of bounds:
//!
//! ```text
//!   hops.rs, hop_classes.rs, branch_changes.rs   every landing of a hop, and the next speed
//!   sines.rs                                     sines and cosines
//!   expansions.rs, fates.rs                      local hops and expansions; traps and orbits
//! ```
//!
//! `tally.rs` collects the ratios actual error / bound, `measured.rs` is the result, `table.rs` writes it down.

mod branch_changes;
pub(crate) mod expansions;
pub(crate) mod fates;
mod hop_classes;
pub(crate) mod hops;
pub(crate) mod measured;
pub(crate) mod sines;
pub(crate) mod table;
pub(crate) mod tally;
