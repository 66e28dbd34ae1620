//! Which attractors has any map, and which disturbances do they withstand?
//!
//! `state_map` is the map of a user. `search` has the class of attractors, which are found or given in the ways of `kinds`. `boundaries` has points
//! between basins, edge states and fatal shocks, `stability` what random starts show, `along` the attractors along a parameter. Their results are tuples:
//! the classes that a user sees are those of `nonsmooth/boundaries.py`, `stability.py` and `along.py`.

mod along;
mod boundaries;
mod kinds;
mod search;
mod stability;
mod state_map;

pub(crate) use along::_attractors_along;
pub(crate) use boundaries::{_boundary_between, _minimal_fatal_shock, _track_edge};
pub(crate) use search::Attractors;
pub(crate) use stability::{_stability, _tipping};
