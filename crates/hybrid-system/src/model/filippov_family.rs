//! Derivatives by parameters for models written with closures that slide.
//!
//! Along a sliding motion ẋ = f_s(x, p), and g(x, p) = 0: the surface may depend on the parameters. A change δx that keeps
//! the state on the surface of the changed model has δẋ = ∂f_s/∂x δx + ∂f_s/∂p δp, with the derivatives of the formula for f_s
//! at a fixed state. No projection enters: it would keep the state on one surface.

use super::family::Family;
use super::integrated::Integrated;
use super::model::Model;
use super::part::Part;
use crate::ode::integrated_parameter_jacobian;
use crate::parameter_sensitivity::Parametric;
use crate::sliding::{Filippov, FilippovMode, FilippovSurface};
use crate::state::State;
use crate::system::{HybridSystem, Reset};
use nalgebra::{RowSVector, SMatrix};
use std::fmt::Debug;

type Mode<M, S> = FilippovMode<M, S>;
type Surface<M, S> = FilippovSurface<M, S>;

impl<M, S, Y, F, Q, const N: usize, const P: usize> Parametric<N, P>
    for Family<Filippov<Model<M, S, State<N>, Integrated<F>, Q>>, P>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>) -> Y,
    Q: Part<M, S, State<N>>,
{
    type System = Filippov<Model<M, S, State<N>, Integrated<F>, Q>>;

    fn system(&self) -> &Self::System {
        self.system()
    }

    /// All entries are NaN if the integration fails.
    fn flow_by_parameters(
        &self,
        mode: Mode<M, S>,
        start: &State<N>,
        time: f64,
    ) -> SMatrix<f64, N, P> {
        let by_parameters = |state: &State<N>| {
            let none = || State::repeat(f64::NAN);
            self.vector(|system| system.field_without_projection(mode, state).unwrap_or_else(none))
        };
        let system = self.system();
        let tolerances = match mode {
            FilippovMode::Free(_) => system.system().motion.tolerances,
            FilippovMode::Sliding { .. } => system.tolerances(),
        };
        integrated_parameter_jacobian(system, mode, start, time, by_parameters, tolerances)
            .unwrap_or_else(|_| SMatrix::repeat(f64::NAN))
    }

    fn guard_by_parameters(&self, surface: Surface<M, S>, state: &State<N>) -> RowSVector<f64, P> {
        self.guard(surface, state)
    }

    /// That of the reset of the model: the state after an exit is the state before it.
    fn reset_by_parameters(
        &self,
        mode: Mode<M, S>,
        surface: Surface<M, S>,
        before: &State<N>,
    ) -> SMatrix<f64, N, P> {
        let FilippovSurface::Model(surface) = surface else { return SMatrix::zeros() };
        let mode = match mode {
            FilippovMode::Free(mode) => mode,
            FilippovMode::Sliding { below, above, .. } => {
                // Both resets agree where both modes have this guard.
                let guards = self.system().system().guards(below);
                if guards.iter().any(|guard| guard.surface == surface) { below } else { above }
            }
        };
        self.vector(|system| match system.system().reset(mode, surface, before) {
            Reset::Jump { state, .. } => state,
            Reset::Stop => State::repeat(f64::NAN),
        })
    }
}
