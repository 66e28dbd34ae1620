//! Which label does each of many speeds have, at one mass ratio or at several?
//!
//! README.md explains the idea, its proof, the invariants that the code cites by name, and every limit.
//!
//! Several columns form a strip, whose orbits hop together ([`strip`], [`column`]).
//! An orbit notes the laps it visits ([`laps`], [`rising_windows`]) in its itinerary ([`itinerary`]).
//! Speeds between two orbits with the same itinerary need no orbit of their own. The intervals they form are kept
//! for orbits that come down to them ([`known_intervals`]).
//! [`labels`] takes speeds in any order.
//!
//! This room uses `traps` and `fates`. Every label is the one that `Fates::fate` gives.

pub(crate) mod column;
pub(crate) mod itinerary;
pub(crate) mod known_intervals;
pub(crate) mod labels;
pub(crate) mod laps;
pub(crate) mod rising_windows;
pub(crate) mod strip;
