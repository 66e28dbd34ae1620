//! What a search for attractors calls: a map of states, and a feature of a stretch of an orbit.
//!
//! They are called through a pointer. The vector that they return costs more than the call, and a search is compiled
//! once, not for each map.

/// A map of states: the next point, or `None` where the map has no value. It may be called from several threads.
pub type StateMap<'a> = dyn Fn(&[f64]) -> Option<Vec<f64>> + Sync + 'a;

/// Numbers that tell attractors apart, made of the successive points of a stretch of an orbit.
pub type OrbitFeature<'a> = dyn Fn(&[Vec<f64>]) -> Vec<f64> + Sync + 'a;
