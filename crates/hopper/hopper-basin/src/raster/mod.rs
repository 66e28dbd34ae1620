//! Which label does each of many speeds have, at one mass ratio or at several?
//!
//! README.md explains the idea, its proof, the invariants that the code cites by name, and every limit.
//!
//! Several columns form a strip, whose orbits hop together ([`strip`], [`column`]). The itinerary of an orbit lists
//! the laps that it visits ([`laps`], [`rising_windows`], [`itinerary`]). Speeds between two orbits with the same
//! itinerary need no orbit of their own. Their intervals are stored for orbits that descend into them
//! ([`known_intervals`]). Along the slow side of a fixed point orbits jump ([`slow_orbits`]), and what they do
//! after it is found on the known arcs of the circle of fates ([`arcs`]), which the columns of a narrow raster
//! share ([`common_circles`]). [`labels`] takes speeds in any order.
//!
//! This room uses `traps` and `fates`. Every label equals the label that `Fates::fate` gives.

pub(crate) mod arcs;
pub(crate) mod column;
pub(crate) mod common_circles;
pub(crate) mod itinerary;
pub(crate) mod known_intervals;
pub(crate) mod labels;
pub(crate) mod laps;
pub(crate) mod rising_windows;
pub(crate) mod slow_orbits;
pub(crate) mod speed_within;
pub(crate) mod strip;
