//! Which fate has a hopper that lifts off with a given speed?
//!
//! There are three fates: it hops for ever and converges to a fixed point, it hops ever lower, or it is grounded
//! ([`hopper_fate`], with the labels of fates in images).
//! An orbit is followed until it enters a trap or is grounded ([`fates_at_mass_ratio`]). If neither happens
//! within a budget of hops, or a hop cannot be decided, the fate is undecided, with the reason.
//!
//! This room uses `traps`. The raster finds the fates of many speeds faster, and gives the same labels.

pub(crate) mod fates_at_mass_ratio;
pub(crate) mod hopper_fate;
