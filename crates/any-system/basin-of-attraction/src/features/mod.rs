//! Which feature vectors belong together?
//!
//! `attractor_features` finds attractors by features of orbits. `feature_groups` groups vectors by a `metric`, with a `suggested_radius`; `intermingledness`
//! says how mixed groups are.

pub(crate) mod attractor_features;
pub(crate) mod feature_groups;
pub(crate) mod intermingledness;
pub(crate) mod metric;
pub(crate) mod suggested_radius;
