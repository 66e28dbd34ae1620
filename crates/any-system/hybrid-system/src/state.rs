//! The state of a system: a vector of real numbers, of a dimension known when the program is compiled or when it runs.

use nalgebra::{DVector, SVector};
use std::fmt::Debug;

/// The state of a system with N continuous variables.
pub type State<const N: usize> = SVector<f64, N>;

/// A vector that can be the state of a system: [`State<N>`](State), or `DVector<f64>`, whose dimension is chosen at run
/// time.
///
/// Executions with a [`State<N>`](State) allocate no memory for states. Every state of a `DVector` is an allocation.
pub trait StateVector: Clone + Debug + PartialEq {
    /// The components x₁ … x_N.
    fn components(&self) -> &[f64];

    /// The components, to be changed.
    fn components_mut(&mut self) -> &mut [f64];

    /// The zero vector of the same dimension.
    #[must_use]
    fn zeros_like(&self) -> Self;

    /// The number of components.
    fn dimension(&self) -> usize {
        self.components().len()
    }

    /// True if no component is infinite or NaN.
    fn is_finite(&self) -> bool {
        self.components().iter().all(|component| component.is_finite())
    }

    /// A vector of the same dimension with these components.
    #[must_use]
    fn filled(&self, mut component: impl FnMut(usize) -> f64) -> Self {
        let mut vector = self.zeros_like();
        for (axis, value) in vector.components_mut().iter_mut().enumerate() {
            *value = component(axis);
        }
        vector
    }

    /// self + factor · other. Components that `other` does not have stay as they are.
    fn add_scaled(&mut self, factor: f64, other: &Self) {
        for (own, other) in self.components_mut().iter_mut().zip(other.components()) {
            *own += factor * other;
        }
    }

    /// The largest absolute value of a component; NaN if a component is NaN, 0 without components.
    fn largest(&self) -> f64 {
        let larger = |largest: f64, component: &f64| {
            let size = component.abs();
            // `f64::max` would drop NaN.
            if size > largest || size.is_nan() { size } else { largest }
        };
        self.components().iter().fold(0.0, larger)
    }
}

impl<const N: usize> StateVector for State<N> {
    fn components(&self) -> &[f64] {
        self.as_slice()
    }
    fn components_mut(&mut self) -> &mut [f64] {
        self.as_mut_slice()
    }
    fn zeros_like(&self) -> Self {
        Self::zeros()
    }
}

impl StateVector for DVector<f64> {
    fn components(&self) -> &[f64] {
        self.as_slice()
    }
    fn components_mut(&mut self) -> &mut [f64] {
        self.as_mut_slice()
    }
    fn zeros_like(&self) -> Self {
        DVector::zeros(self.len())
    }
}
