//! The continuous part of a system's state.

use nalgebra::SVector;

/// A point of the continuous state space.
pub type State<const N: usize> = SVector<f64, N>;
