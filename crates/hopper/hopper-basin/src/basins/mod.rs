//! Which speeds and mass ratios belong to the basin of a fixed point?
//!
//! The answer has several forms:
//! an image over the (M, α) plane ([`rasters`]), with the number of hops until each fate ([`hop_counts`]),
//! the fractions of the fates by the paper's protocol ([`fractions`]),
//! fractions over the mass ratio with their ranges ([`fractions_over_mass_ratio`]),
//! what a change of the mass ratio does ([`tipping`]),
//! all basins at one mass ratio as intervals, with what remains undecided ([`intervals`]),
//! and one basin level by level, as the paper constructs it ([`levels`]).
//! Intervals and levels come from the monotone branches of the map ([`branches`]).
//! [`window`] names the speeds of the paper's basins.
//!
//! This room uses `traps`, `fates` and `raster`.

pub(crate) mod branches;
pub(crate) mod fractions;
pub(crate) mod fractions_over_mass_ratio;
pub(crate) mod hop_counts;
pub(crate) mod intervals;
mod inward_ends;
pub(crate) mod levels;
pub(crate) mod minimum_on_fixed_point;
pub(crate) mod rasters;
pub(crate) mod tipping;
pub(crate) mod window;
