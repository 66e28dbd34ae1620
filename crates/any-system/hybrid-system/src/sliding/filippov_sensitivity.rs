//! Derivatives along sliding motions.
//!
//! With a = ∇g·f⁻, b = ∇g·f⁺, λ = a/(a − b), and the Jacobians J⁻ and J⁺ of the fields,
//!
//! ```text
//!   f_s = f⁻ + λ(f⁺ − f⁻)
//!   ∂f_s/∂x = J⁻ + λ(J⁺ − J⁻) + (f⁺ − f⁻)∇λᵀ        ∇λ = (a∇b − b∇a)/(a − b)²
//!   ∇a = J⁻ᵀ∇g + H f⁻     ∇b = J⁺ᵀ∇g + H f⁺          H = ∂²g/∂x²
//! ```
//!
//! H f is the derivative of ∇g along f, by differences of order eight. It is exact to rounding for quadratic guards.
//!
//! A start is changed within the surface. The saltation at the entrance, I + (f_s − f⁻)∇gᵀ/(∇g·f⁻), maps every change
//! there: ∇gᵀ + (0 − ∇g·f⁻)∇gᵀ/(∇g·f⁻) = 0. At an exit both fields agree, and the saltation is the identity.

use super::directional::slope_along;
use super::filippov::{Fields, Filippov, Sides};
use super::filippov_modes::{FilippovMode, FilippovSurface};
use crate::guard::Guard;
use crate::ode::{Linearized, integrated_jacobian};
use crate::sensitivity::Differentiable;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::SMatrix;

impl<T, const N: usize> Filippov<T>
where
    T: HybridSystem<State = State<N>> + Differentiable<N> + Linearized<N>,
{
    /// H f.
    fn curvature_along(&self, surface: T::Surface, state: &State<N>, field: &State<N>) -> State<N> {
        State::from_fn(|axis, _| {
            let component = |state: &State<N>| self.system.guard_gradient(surface, state)[axis];
            slope_along(&component, state, field, 0.0).value
        })
    }

    /// ∇(∇g·f) for the field of `mode`.
    fn rate_gradient(&self, surface: T::Surface, mode: T::Mode, state: &State<N>) -> State<N> {
        let Some(field) = self.system.vector_field(mode, state) else {
            return State::repeat(f64::NAN);
        };
        let gradient = self.system.guard_gradient(surface, state);
        self.system.field_jacobian(mode, state).transpose() * gradient
            + self.curvature_along(surface, state, &field)
    }
}

impl<T, const N: usize> Linearized<N> for Filippov<T>
where
    T: Differentiable<N> + Linearized<N>,
{
    fn field_jacobian(&self, mode: Self::Mode, state: &State<N>) -> SMatrix<f64, N, N> {
        let (surface, below, above) = match mode {
            FilippovMode::Free(mode) => return self.system.field_jacobian(mode, state),
            FilippovMode::Sliding { surface, below, above, .. } => (surface, below, above),
        };
        let sides = Sides { surface, below, above };
        let state = self.on_surface(&sides, *state);
        let Some(Fields { below: lower, above: upper, rates: (a, b) }) =
            self.fields(&sides, &state)
        else {
            return SMatrix::repeat(f64::NAN);
        };
        let lambda = a / (a - b);
        let of = |mode| self.system.field_jacobian(mode, &state);
        let (j_below, j_above) = (of(below), of(above));
        let grad_a = self.rate_gradient(surface, below, &state);
        let grad_b = self.rate_gradient(surface, above, &state);
        let grad_lambda = (grad_b * a - grad_a * b) / ((a - b) * (a - b));
        j_below + (j_above - j_below) * lambda + (upper - lower) * grad_lambda.transpose()
    }
}

impl<T, const N: usize> Differentiable<N> for Filippov<T>
where
    T: Differentiable<N> + Linearized<N>,
{
    fn flow_jacobian(&self, mode: Self::Mode, start: &State<N>, time: f64) -> SMatrix<f64, N, N> {
        match mode {
            FilippovMode::Free(mode) => self.system.flow_jacobian(mode, start, time),
            FilippovMode::Sliding { .. } => {
                integrated_jacobian(self, mode, start, time, self.tolerances)
                    .unwrap_or_else(|_| SMatrix::repeat(f64::NAN))
            }
        }
    }

    fn guard_gradient(&self, surface: Self::Surface, state: &State<N>) -> State<N> {
        match surface {
            FilippovSurface::Model(surface) => self.system.guard_gradient(surface, state),
            FilippovSurface::Tangent { surface, mode } => self.rate_gradient(surface, mode, state),
        }
    }

    fn reset_jacobian(
        &self,
        mode: Self::Mode,
        surface: Self::Surface,
        before: &State<N>,
    ) -> SMatrix<f64, N, N> {
        let FilippovSurface::Model(surface) = surface else { return SMatrix::identity() };
        match mode {
            FilippovMode::Free(mode) => self.system.reset_jacobian(mode, surface, before),
            FilippovMode::Sliding { below, above, .. } => {
                // Both resets agree where both modes have this guard.
                let has = |mode: &T::Mode| {
                    let of_surface = |guard: &Guard<T::Surface>| guard.surface == surface;
                    self.system.guards(*mode).iter().any(of_surface)
                };
                let mode = [below, above].into_iter().find(has);
                mode.map_or(SMatrix::identity(), |mode| {
                    self.system.reset_jacobian(mode, surface, before)
                })
            }
        }
    }
}
