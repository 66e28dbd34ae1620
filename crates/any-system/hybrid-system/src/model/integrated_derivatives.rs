//! The derivatives of an integrated model: those of the flow by the variational equation.

use super::derivatives::{gradient_by_differences, jacobian_by_differences, reset_by_differences};
use super::integrated::Integrated;
use super::model::Model;
use super::part::ModelPart;
use crate::ode::{Linearized, integrated_jacobian};
use crate::sensitivity::Differentiable;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::SMatrix;
use std::fmt::Debug;

/// The Jacobian of the field by central differences, with about ten digits.
impl<M, S, Y, F, P, C, const N: usize> Linearized<N> for Model<M, S, State<N>, Integrated<F>, P, C>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>) -> Y,
    P: ModelPart<M, S, State<N>>,
{
    fn field_jacobian(&self, mode: M, state: &State<N>) -> SMatrix<f64, N, N> {
        let none = || State::repeat(f64::NAN);
        jacobian_by_differences(state, |state| self.vector_field(mode, state).unwrap_or_else(none))
    }
}

/// The derivative of the flow by its variational equation, the others by central differences of the closures. All have
/// about ten digits, or those of the tolerances.
impl<M, S, Y, F, P, C, const N: usize> Differentiable<N>
    for Model<M, S, State<N>, Integrated<F>, P, C>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>) -> Y,
    P: ModelPart<M, S, State<N>>,
{
    /// All entries are NaN if the integration fails.
    fn flow_jacobian(&self, mode: M, start: &State<N>, time: f64) -> SMatrix<f64, N, N> {
        integrated_jacobian(self, mode, start, time, self.motion.tolerances)
            .unwrap_or_else(|_| SMatrix::repeat(f64::NAN))
    }

    fn guard_gradient(&self, surface: S, state: &State<N>) -> State<N> {
        gradient_by_differences(state, |state| self.guard_value(surface, state))
    }

    fn reset_jacobian(&self, mode: M, surface: S, before: &State<N>) -> SMatrix<f64, N, N> {
        reset_by_differences(self, mode, surface, before)
    }
}
