//! The derivatives of a model written with closures, by difference quotients of its closures.

use super::model::Model;
use super::motion::{ClosedForm, Motion};
use super::part::ModelPart;
use crate::sensitivity::Differentiable;
use crate::state::State;
use crate::system::{HybridSystem, Reset};
use nalgebra::SMatrix;
use std::fmt::Debug;

/// Half the distance of the two values of a difference quotient, for a component of size 1: ε^⅓. The curvature of
/// the function gives an error of order h² = 4·10⁻¹¹, the rounding of its values one of order ε/h, which is equal.
/// A function whose scale is smaller than 10⁻³ needs the derivatives of the trait.
const REACH: f64 = 6e-6;

/// The Jacobian of `function` at `state`, by central differences: about ten digits for a smooth function whose scale is
/// that of its arguments, max(1, |x|). A column is NaN where the function is.
///
/// ```
/// use hybrid_system::{State, jacobian_by_differences};
/// let product = |x: &State<2>| State::<2>::new(x[0] * x[1], x[1]);
/// let found = jacobian_by_differences(&State::<2>::new(2.0, 3.0), product);
/// assert!((found[(0, 0)] - 3.0).abs() < 1e-9 && (found[(0, 1)] - 2.0).abs() < 1e-9);
/// ```
pub fn jacobian_by_differences<const N: usize>(
    state: &State<N>,
    function: impl Fn(&State<N>) -> State<N>,
) -> SMatrix<f64, N, N> {
    let mut jacobian = SMatrix::<f64, N, N>::zeros();
    for axis in 0..N {
        let [ahead, behind, distance] = neighbours(state, axis);
        let change = (function(&ahead) - function(&behind)) / distance[axis];
        jacobian.set_column(axis, &change);
    }
    jacobian
}

/// The gradient of `function` at `state`, as [`jacobian_by_differences`].
pub fn gradient_by_differences<const N: usize>(
    state: &State<N>,
    function: impl Fn(&State<N>) -> f64,
) -> State<N> {
    State::from_fn(|axis, _| {
        let [ahead, behind, distance] = neighbours(state, axis);
        (function(&ahead) - function(&behind)) / distance[axis]
    })
}

/// The states ahead and behind along an axis, and their difference, which is exact.
fn neighbours<const N: usize>(state: &State<N>, axis: usize) -> [State<N>; 3] {
    let reach = REACH * state[axis].abs().max(1.0);
    let (mut ahead, mut behind) = (*state, *state);
    ahead[axis] += reach;
    behind[axis] -= reach;
    [ahead, behind, ahead - behind]
}

/// ∂x⁺/∂x⁻ of a reset, as [`jacobian_by_differences`]. It is NaN if the reset ends the execution nearby.
pub fn reset_by_differences<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    surface: T::Surface,
    before: &State<N>,
) -> SMatrix<f64, N, N>
where
    T: HybridSystem<State = State<N>>,
{
    jacobian_by_differences(before, |state| state_after(system.reset(mode, surface, state)))
}

/// The state after a reset, NaN in all components if the reset ends the execution.
pub(super) fn state_after<M, const N: usize>(reset: Reset<M, State<N>>) -> State<N> {
    match reset {
        Reset::Jump { state, .. } | Reset::Resize { state, .. } => state,
        Reset::Stop => State::repeat(f64::NAN),
    }
}

/// Derivatives by central differences of the closures, with about ten digits. The field comes from [`Model::field`].
impl<M, S, Y, F, P, C, const N: usize> Differentiable<N>
    for Model<M, S, State<N>, ClosedForm<F>, P, C>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>, f64) -> Y,
    P: ModelPart<M, S, State<N>>,
{
    fn flow_jacobian(&self, mode: M, start: &State<N>, time: f64) -> SMatrix<f64, N, N> {
        jacobian_by_differences(start, |start| self.motion.flow(self, mode, start, time))
    }

    fn guard_gradient(&self, surface: S, state: &State<N>) -> State<N> {
        gradient_by_differences(state, |state| self.guard_value(surface, state))
    }

    fn reset_jacobian(&self, mode: M, surface: S, before: &State<N>) -> SMatrix<f64, N, N> {
        reset_by_differences(self, mode, surface, before)
    }
}
