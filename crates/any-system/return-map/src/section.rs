//! Sections: the surfaces that a return map maps to themselves.

use hybrid_system::{Event, HybridSystem, State};
use nalgebra::{SMatrix, SVector};

/// A K-dimensional section through the N-dimensional state space. Executions meet it at events.
pub trait Section<T: HybridSystem<State = State<N>>, const N: usize, const K: usize> {
    /// Mode and state of the point with these coordinates, from which an execution starts.
    fn point(&self, coordinates: &SVector<f64, K>) -> (T::Mode, State<N>);

    /// The coordinates of an event on the section; `None` for an event that is not on it.
    fn coordinates(&self, event: &Event<T::Mode, T::Surface, State<N>>) -> Option<SVector<f64, K>>;
}

/// A section with derivatives, from which the derivative of the return map is computed.
pub trait SmoothSection<T: HybridSystem<State = State<N>>, const N: usize, const K: usize>:
    Section<T, N, K>
{
    /// ∂x/∂ξ of the [point](Section::point) with these coordinates.
    fn point_jacobian(&self, coordinates: &SVector<f64, K>) -> SMatrix<f64, N, K>;

    /// ∂ξ/∂x⁺ of the [coordinates](Section::coordinates) of an event, x⁺ being the state after it.
    fn coordinates_jacobian(
        &self,
        event: &Event<T::Mode, T::Surface, State<N>>,
    ) -> SMatrix<f64, K, N>;
}
