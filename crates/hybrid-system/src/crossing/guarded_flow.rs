//! The part of a model that a search for crossings needs: one flow, and the guards along it.

use super::enclosure::Enclosure;
use super::quasi_polynomial::QuasiPolynomial;
use crate::guard::Guard;
use crate::state::State;
use std::fmt::Debug;

/// The flow in one mode from one start, with the guards that are searched along it.
///
/// The searches use this trait instead of `HybridSystem`, because the provided method
/// `HybridSystem::first_crossing` calls the searches: the two files would import each other.
pub(crate) trait GuardedFlow<const N: usize> {
    /// The names of the switching surfaces.
    type Surface: Copy + Debug;

    /// The state at time zero.
    fn start(&self) -> &State<N>;

    /// φ(t; x₀).
    fn state(&self, time: f64) -> State<N>;

    /// The guards of the mode, in the order in which the model lists them.
    fn guards(&self) -> &[Guard<Self::Surface>];

    /// g(x).
    fn guard_value(&self, surface: Self::Surface, state: &State<N>) -> f64;

    /// g(φ(t; x₀)) as a quasi-polynomial in t, if the model gives it.
    fn quasi_polynomial(&self, surface: Self::Surface) -> Option<QuasiPolynomial>;

    /// Bounds on dᵏ/dtᵏ g(φ(t; x₀)), k = `order`, over an interval of time, if the model gives them.
    fn enclosure(&self, surface: Self::Surface, order: u32, times: (f64, f64))
    -> Option<Enclosure>;

    /// g(φ(t; x₀)).
    fn guard_at(&self, surface: Self::Surface, time: f64) -> f64 {
        self.guard_value(surface, &self.state(time))
    }
}
