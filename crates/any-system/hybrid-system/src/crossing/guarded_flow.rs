//! The part of a model that a search for crossings needs: one flow, and the guards along it.

use super::guard_rounding::{rounding_of_state, stated_or_measured};
use super::quasi_polynomial::QuasiPolynomial;
use crate::guard::Guard;
use crate::state::StateVector;
use interval_arithmetic::Enclosure;
use std::fmt::Debug;

/// The flow in one mode from one start, with the guards that are searched along it.
///
/// The searches use this trait instead of `HybridSystem`, because the provided method
/// `HybridSystem::first_crossing` calls the searches: the two files would import each other.
pub(crate) trait GuardedFlow {
    /// The states.
    type State: StateVector;
    /// The names of the switching surfaces.
    type Surface: Copy + PartialEq + Debug;

    /// The state at time zero.
    fn start(&self) -> &Self::State;

    /// φ(t; x₀).
    fn state(&self, time: f64) -> Self::State;

    /// The guards of the mode, in the order in which the model lists them.
    fn guards(&self) -> &[Guard<Self::Surface>];

    /// g(x).
    fn guard_value(&self, surface: Self::Surface, state: &Self::State) -> f64;

    /// A bound on the rounding of g's own arithmetic, if the model gives it.
    fn guard_error(&self, surface: Self::Surface, state: &Self::State) -> Option<f64>;

    /// f(x), if the model gives it.
    fn vector_field(&self, state: &Self::State) -> Option<Self::State>;

    /// The side to which a guard leaves its zero at the start, if the model gives it; 0 if it stays there.
    fn leaving_side(&self, surface: Self::Surface) -> Option<f64>;

    /// g(φ(t; x₀)) as a quasi-polynomial in t, if the model gives it.
    fn quasi_polynomial(&self, surface: Self::Surface) -> Option<QuasiPolynomial>;

    /// Bounds on dᵏ/dtᵏ g(φ(t; x₀)), k = `order`, over an interval of time, if the model gives them.
    fn enclosure(&self, surface: Self::Surface, order: u32, times: (f64, f64))
    -> Option<Enclosure>;

    /// The rounding error of g at a state: of the state, and of g's own operations, as far as the model states it or
    /// they show it. The operations that give an exact zero have not rounded.
    fn rounding_at(&self, surface: Self::Surface, state: &Self::State) -> f64 {
        let value = |state: &Self::State| self.guard_value(surface, state);
        if value(state) == 0.0 {
            return rounding_of_state(state, state, &value);
        }
        stated_or_measured(self.guard_error(surface, state), state, &value)
    }

    /// g(φ(t; x₀)).
    fn guard_at(&self, surface: Self::Surface, time: f64) -> f64 {
        self.guard_value(surface, &self.state(time))
    }
}
