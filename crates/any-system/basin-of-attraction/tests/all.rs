//! The tests of this crate are one program: what they share is compiled once, and the tests of all files run side by
//! side.

#![allow(missing_docs, clippy::disallowed_methods, clippy::panic, clippy::unwrap_used)]

mod attacked;
mod attacked_again;
mod attractor_features;
mod attractors;
mod attractors_known;
mod attractors_once;
mod boundary_distance;
mod boundary_shapes;
mod cantor;
mod cantor_sets;
mod confidence_intervals;
mod convergences;
mod endless_windows;
mod fractions_along;
mod known_basins;
mod known_flows;
mod known_planes;
#[cfg(feature = "figures")]
mod pictures;
mod planted_intervals;
mod resilience;
mod riddled_basin;
mod runge_kutta;
mod stability;
mod tipping;
mod transients;
