//! Derivatives by parameters for models written with closures that slide.
//!
//! Along a sliding motion ẋ = f_s(x, p), and g(x, p) = 0: the surface may depend on the parameters. A change δx
//! that keeps the state on the surface of the changed model has δẋ = ∂f_s/∂x δx + ∂f_s/∂p δp, with the derivatives
//! of the formula for f_s at a fixed state. No projection enters: it would keep the state on one surface.

use super::derivatives::state_after;
use super::family::Family;
use super::integrated::Integrated;
use super::model::Model;
use super::part::ModelPart;
use crate::parameter_sensitivity::Parametric;
use crate::sliding::{Filippov, FilippovMode, FilippovSurface};
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::{RowSVector, SMatrix};
use std::fmt::Debug;

type Mode<M, S> = FilippovMode<M, S>;
type Surface<M, S> = FilippovSurface<M, S>;

impl<M, S, Y, F, Q, C, const N: usize, const P: usize> Parametric<N, P>
    for Family<Filippov<Model<M, S, State<N>, Integrated<F>, Q, C>>, P>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>) -> Y,
    Q: ModelPart<M, S, State<N>>,
{
    type System = Filippov<Model<M, S, State<N>, Integrated<F>, Q, C>>;

    fn system(&self) -> &Self::System {
        self.system()
    }

    fn flow_by_parameters(
        &self,
        mode: Mode<M, S>,
        start: &State<N>,
        time: f64,
    ) -> SMatrix<f64, N, P> {
        let system = self.system();
        let tolerances = match mode {
            FilippovMode::Free(_) => system.system().motion.tolerances,
            FilippovMode::Sliding { .. } => system.tolerances(),
        };
        let field =
            |system: &Self::System, state: &State<N>| system.field_without_projection(mode, state);
        self.integrated_flow((mode, start, time), field, tolerances)
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
        self.vector(|system| state_after(system.system().reset(mode, surface, before)))
    }
}
