//! ∂φ(t; x₀)/∂x₀ along an integrated flow, by its variational equation.

use super::steps::Steps;
use super::tolerances::Tolerances;
use super::vector::Vector;
use crate::error::Error;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::SMatrix;

/// A vector field with its Jacobian.
pub trait Linearized<const N: usize>: HybridSystem<State = State<N>> {
    /// ∂f/∂x.
    fn field_jacobian(&self, mode: Self::Mode, state: &State<N>) -> SMatrix<f64, N, N>;
}

/// The state and Φ, its derivative with respect to the start, integrated together.
#[derive(Debug, Clone, Copy)]
struct StateAndTransition<const N: usize> {
    state: State<N>,
    transition: SMatrix<f64, N, N>,
}

impl<const N: usize> Vector for StateAndTransition<N> {
    fn length(&self) -> usize {
        N + N * N
    }
    fn component(&self, axis: usize) -> f64 {
        if axis < N { self.state[axis] } else { self.transition[axis - N] }
    }
    fn set_component(&mut self, axis: usize, value: f64) {
        if axis < N {
            self.state[axis] = value;
        } else {
            self.transition[axis - N] = value;
        }
    }
}

/// ∂φ(t; x₀)/∂x₀ in an integrated mode: the value that
/// [`Differentiable::flow_jacobian`](crate::Differentiable::flow_jacobian) returns there.
///
/// The tolerances apply to its entries as to the state.
///
/// # Errors
/// [`Error::BadLimit`] for a time that is not finite, and the errors of [`Integration`](crate::Integration).
pub fn integrated_jacobian<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    time: f64,
    tolerances: Tolerances,
) -> Result<SMatrix<f64, N, N>, Error>
where
    T: Linearized<N> + ?Sized,
{
    // (x, Φ)˙ = (f(x), ∂f/∂x Φ)
    let no_field = || State::repeat(f64::NAN);
    let field = |_: f64, at: &StateAndTransition<N>| StateAndTransition {
        state: system.vector_field(mode, &at.state).unwrap_or_else(no_field),
        transition: system.field_jacobian(mode, &at.state) * at.transition,
    };
    let begin = StateAndTransition { state: *start, transition: SMatrix::identity() };
    if time == 0.0 {
        return Ok(begin.transition);
    }
    if !time.is_finite() {
        return Err(Error::BadLimit { what: "the time of a flow", value: time });
    }
    let mut steps = Steps::new(field, 0.0, &begin, tolerances)?;
    steps.until(time)?;
    while !steps.ended() {
        steps.step()?;
    }
    Ok(steps.state().transition)
}
