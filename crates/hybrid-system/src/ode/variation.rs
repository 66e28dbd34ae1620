//! ∂φ(t; x₀)/∂x₀ along an integrated flow, by its variational equation.

use super::integration::{finite, named};
use super::{Tolerances, first_step};
use crate::{Error, State, VectorField};
use differential_equations::interpolate::Interpolation;
use differential_equations::methods::{Adaptive, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::traits::State as Components;
use nalgebra::SMatrix;

/// A vector field with its Jacobian.
pub trait Linearized<const N: usize>: VectorField<N> {
    /// ∂f/∂x.
    fn field_jacobian(&self, mode: Self::Mode, state: &State<N>) -> SMatrix<f64, N, N>;
}

/// The state and Φ, its derivative with respect to the start.
#[derive(Debug, Clone)]
struct Tangent<const N: usize> {
    state: State<N>,
    transition: SMatrix<f64, N, N>,
}

impl<const N: usize> Tangent<N> {
    fn components(&mut self) -> impl Iterator<Item = &mut f64> {
        self.state.iter_mut().chain(self.transition.iter_mut())
    }
}

impl<const N: usize> Components<f64> for Tangent<N> {
    fn len(&self) -> usize {
        N + N * N
    }
    fn get_component(&self, index: usize) -> f64 {
        if index < N { self.state[index] } else { self.transition[index - N] }
    }
    fn set_component(&mut self, index: usize, value: f64) {
        if index < N {
            self.state[index] = value;
        } else {
            self.transition[index - N] = value;
        }
    }
    fn map_components_mut<F: FnMut(usize, &mut f64)>(&mut self, mut f: F) {
        self.components().enumerate().for_each(|(index, value)| f(index, value));
    }
    fn zeros_like(&self) -> Self {
        Self::zeros()
    }
    fn zeros() -> Self {
        Tangent { state: State::zeros(), transition: SMatrix::zeros() }
    }
    fn mul_add_assign(&mut self, alpha: f64, other: &Self) {
        self.state += other.state * alpha;
        self.transition += other.transition * alpha;
    }
    fn scale_mut(&mut self, alpha: f64) {
        self.state *= alpha;
        self.transition *= alpha;
    }
}

/// (x, Φ)˙ = (f(x), ∂f/∂x Φ).
struct Variational<'a, T: VectorField<N> + ?Sized, const N: usize> {
    system: &'a T,
    mode: T::Mode,
}

impl<T: Linearized<N> + ?Sized, const N: usize> ODE<f64, Tangent<N>> for Variational<'_, T, N> {
    fn diff(&self, _: f64, at: &Tangent<N>, slope: &mut Tangent<N>) {
        slope.state = self.system.vector_field(self.mode, &at.state);
        slope.transition = self.system.field_jacobian(self.mode, &at.state) * at.transition;
    }
}

/// ∂φ(t; x₀)/∂x₀ in an integrated mode: what
/// [`Differentiable::flow_jacobian`](crate::Differentiable::flow_jacobian) gives there.
///
/// The tolerances hold for its entries as for the state.
///
/// # Errors
/// Those of [`Integration`](crate::Integration).
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
    type Method<const N: usize> =
        ExplicitRungeKutta<Ordinary, Adaptive, f64, Tangent<N>, 9, 16, 21>;
    if time == 0.0 {
        return Ok(SMatrix::identity());
    }
    let Tolerances { relative, absolute, steps } = tolerances;
    tolerances.check()?;
    finite(start, 0.0)?;
    let field = |_: f64, state: &State<N>| system.vector_field(mode, state);
    let first = first_step(&field, start, tolerances);
    let mut method: Method<N> =
        Method::rkv988e().rtol(relative).atol(absolute).max_steps(steps).h0(first);
    let equation = Variational { system, mode };
    let begin = Tangent { state: *start, transition: SMatrix::identity() };
    method.init(&equation, 0.0, f64::MAX, &begin).map_err(|failure| named(&failure))?;
    while method.t() < time {
        method.step(&equation).map_err(|failure| named(&failure))?;
        finite(&method.y().state, method.t())?;
    }
    let end = method.interpolate(time).map_err(|failure| named(&failure))?;
    Ok(end.transition)
}
