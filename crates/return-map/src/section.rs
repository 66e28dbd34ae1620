//! Sections: where in an execution the map looks.

use hybrid_system::{Event, HybridSystem, State};
use nalgebra::SVector;

/// A K-dimensional section through the N-dimensional state space, met at events.
pub trait Section<T: HybridSystem<N>, const N: usize, const K: usize> {
    /// Mode and state of the point with these coordinates, from which an execution starts.
    fn point(&self, coordinates: &SVector<f64, K>) -> (T::Mode, State<N>);

    /// The coordinates of an event that lies on the section; nothing if it does not.
    fn coordinates(&self, event: &Event<T::Mode, T::Surface, N>) -> Option<SVector<f64, K>>;
}
