//! What is the long-term behaviour of a hopper that lifts off with a given speed?
//!
//! There are three fates: the hopper hops for ever and converges to a fixed point, it hops ever lower, or it is
//! grounded ([`hopper_fate`], with the labels of fates in images). An orbit is followed until it enters a trap or
//! is grounded, with a bound on its error ([`certain_fate`]). The fate is undecided, with the reason, if neither
//! happens within a budget of hops, or if the error reaches a verdict. The many hops along the slow side of a fixed
//! point are jumped over ([`slow_sides`]; many starts beside one that falls onto a fixed point: [`beside_edge`]).
//! [`fates_at_mass_ratio`] has the entries and the traps, and [`many_fates`] follows many orbits together. The phase with which
//! an orbit comes to its fixed point: [`asymptotic_phases`].
//!
//! This room uses `traps`. The raster finds the fates of many speeds faster, and gives the same labels.

pub(crate) mod asymptotic_phases;
pub(crate) mod beside_edge;
pub(crate) mod certain_fate;
pub(crate) mod fates_at_mass_ratio;
pub(crate) mod hopper_fate;
pub(crate) mod many_fates;
pub(crate) mod slow_sides;
