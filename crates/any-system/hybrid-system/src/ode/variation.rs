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

/// The state and a matrix of its derivatives, integrated together.
#[derive(Debug, Clone, Copy)]
struct StateAndDerivatives<const N: usize, const C: usize> {
    state: State<N>,
    derivatives: SMatrix<f64, N, C>,
}

impl<const N: usize, const C: usize> Vector for StateAndDerivatives<N, C> {
    fn length(&self) -> usize {
        N + N * C
    }
    /// The entries of a column have the tolerances of the state.
    fn states(&self) -> usize {
        N
    }
    fn component(&self, axis: usize) -> f64 {
        if axis < N { self.state[axis] } else { self.derivatives[axis - N] }
    }
    fn set_component(&mut self, axis: usize, value: f64) {
        if axis < N {
            self.state[axis] = value;
        } else {
            self.derivatives[axis - N] = value;
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
    // Φ˙ = ∂f/∂x Φ, from Φ = I.
    let rate = |state: &State<N>, transition: &SMatrix<f64, N, N>| {
        system.field_jacobian(mode, state) * transition
    };
    derivatives(system, mode, start, (time, SMatrix::identity()), rate, tolerances)
}

/// ∂φ(t; x₀, p)/∂p in an integrated mode, at fixed start and time: the value that
/// [`Parametric::flow_by_parameters`](crate::Parametric::flow_by_parameters) returns there. `by_parameters` is
/// ∂f/∂p, with one column for each parameter.
///
/// The tolerances apply to its entries as to the state.
///
/// # Errors
/// As [`integrated_jacobian`].
pub fn integrated_parameter_jacobian<T, const N: usize, const P: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    time: f64,
    by_parameters: impl Fn(&State<N>) -> SMatrix<f64, N, P>,
    tolerances: Tolerances,
) -> Result<SMatrix<f64, N, P>, Error>
where
    T: Linearized<N> + ?Sized,
{
    // Π˙ = ∂f/∂x Π + ∂f/∂p, from Π = 0.
    let rate = |state: &State<N>, change: &SMatrix<f64, N, P>| {
        system.field_jacobian(mode, state) * change + by_parameters(state)
    };
    derivatives(system, mode, start, (time, SMatrix::zeros()), rate, tolerances)
}

/// The matrix at `time` of the derivatives that begin as `first` and change at the rate `rate`(x, derivatives).
fn derivatives<T, const N: usize, const C: usize>(
    system: &T,
    mode: T::Mode,
    start: &State<N>,
    (time, first): (f64, SMatrix<f64, N, C>),
    rate: impl Fn(&State<N>, &SMatrix<f64, N, C>) -> SMatrix<f64, N, C>,
    tolerances: Tolerances,
) -> Result<SMatrix<f64, N, C>, Error>
where
    T: HybridSystem<State = State<N>> + ?Sized,
{
    if time == 0.0 {
        return Ok(first);
    }
    if !time.is_finite() {
        return Err(Error::BadLimit { what: "the time of a flow", value: time });
    }
    let no_field = || State::repeat(f64::NAN);
    let field = |_: f64, at: &StateAndDerivatives<N, C>| StateAndDerivatives {
        state: system.vector_field(mode, &at.state).unwrap_or_else(no_field),
        derivatives: rate(&at.state, &at.derivatives),
    };
    let begin = StateAndDerivatives { state: *start, derivatives: first };
    let mut steps = Steps::new(field, 0.0, &begin, tolerances)?;
    steps.until(time)?;
    while !steps.ended() {
        steps.step()?;
    }
    Ok(steps.state().derivatives)
}
