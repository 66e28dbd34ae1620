//! ∂φ(t; x₀)/∂x₀ along an integrated flow, by its variational equation.

use super::Tolerances;
use super::integration::Steps;
use super::vector::Vector;
use crate::{Error, State, VectorField};
use nalgebra::SMatrix;

/// A vector field with its Jacobian.
pub trait Linearized<const N: usize>: VectorField<N> {
    /// ∂f/∂x.
    fn field_jacobian(&self, mode: Self::Mode, state: &State<N>) -> SMatrix<f64, N, N>;
}

/// The state and Φ, its derivative with respect to the start.
#[derive(Debug, Clone, Copy)]
struct Tangent<const N: usize> {
    state: State<N>,
    transition: SMatrix<f64, N, N>,
}

impl<const N: usize> Vector for Tangent<N> {
    fn zero() -> Self {
        Tangent { state: State::zeros(), transition: SMatrix::zeros() }
    }
    fn add(&mut self, factor: f64, other: &Self) {
        self.state += other.state * factor;
        self.transition += other.transition * factor;
    }
    fn components(&self) -> impl Iterator<Item = f64> {
        self.state.iter().chain(self.transition.iter()).copied()
    }
}

/// ∂φ(t; x₀)/∂x₀ in an integrated mode: what
/// [`Differentiable::flow_jacobian`](crate::Differentiable::flow_jacobian) gives there.
///
/// The tolerances hold for its entries as for the state.
///
/// # Errors
/// [`Error::BadLimit`] for a negative time, and those of [`Integration`](crate::Integration).
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
    let field = |_: f64, at: &Tangent<N>| Tangent {
        state: system.vector_field(mode, &at.state),
        transition: system.field_jacobian(mode, &at.state) * at.transition,
    };
    let begin = Tangent { state: *start, transition: SMatrix::identity() };
    if time == 0.0 {
        return Ok(begin.transition);
    }
    if !(time >= 0.0) {
        return Err(Error::BadLimit { what: "the time of a flow", value: time });
    }
    let mut steps = Steps::new(field, &begin, tolerances)?;
    while steps.time < time {
        steps.step()?;
    }
    Ok(steps.directly_at(time)?.transition)
}
