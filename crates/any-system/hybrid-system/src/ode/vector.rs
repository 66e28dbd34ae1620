//! Vectors that can be integrated.

use crate::state::StateVector;

/// What can be integrated: the state of a system, or that state with its derivatives (`variation`). The integrator
/// reads and writes components; it computes in vectors of its own (`rows`).
pub(super) trait Vector: Clone {
    /// The number of components.
    fn length(&self) -> usize;
    /// The number of components of the state. Each further component has the tolerance of one of them, in turn.
    fn states(&self) -> usize {
        self.length()
    }
    /// Component `axis`, below the length.
    fn component(&self, axis: usize) -> f64;
    /// Changes component `axis`, below the length.
    fn set_component(&mut self, axis: usize, value: f64);
    /// Changes all components.
    fn set_components(&mut self, components: &[f64]) {
        for (axis, component) in components.iter().enumerate() {
            self.set_component(axis, *component);
        }
    }
    /// This vector, with other components.
    fn with_components(&self, components: &[f64]) -> Self {
        let mut vector = self.clone();
        vector.set_components(components);
        vector
    }
}

impl<V: StateVector> Vector for V {
    fn length(&self) -> usize {
        self.components().len()
    }
    fn component(&self, axis: usize) -> f64 {
        self.components()[axis]
    }
    fn set_component(&mut self, axis: usize, value: f64) {
        self.components_mut()[axis] = value;
    }
    fn set_components(&mut self, components: &[f64]) {
        self.components_mut().copy_from_slice(components);
    }
}
