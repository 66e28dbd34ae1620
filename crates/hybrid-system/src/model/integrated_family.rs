//! Derivatives by parameters for integrated models written with closures.

use super::family::Family;
use super::integrated::Integrated;
use super::model::Model;
use super::part::Part;
use crate::ode::integrated_parameter_jacobian;
use crate::parameter_sensitivity::Parametric;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::{RowSVector, SMatrix};
use std::fmt::Debug;

impl<M, S, Y, F, Q, const N: usize, const P: usize> Parametric<N, P>
    for Family<Model<M, S, State<N>, Integrated<F>, Q>, P>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>) -> Y,
    Q: Part<M, S, State<N>>,
{
    type System = Model<M, S, State<N>, Integrated<F>, Q>;

    fn system(&self) -> &Self::System {
        self.system()
    }

    /// All entries are NaN if the integration fails.
    fn flow_by_parameters(&self, mode: M, start: &State<N>, time: f64) -> SMatrix<f64, N, P> {
        let by_parameters = |state: &State<N>| {
            let none = || State::repeat(f64::NAN);
            self.vector(|system| system.vector_field(mode, state).unwrap_or_else(none))
        };
        let (system, tolerances) = (self.system(), self.system().motion.tolerances);
        integrated_parameter_jacobian(system, mode, start, time, by_parameters, tolerances)
            .unwrap_or_else(|_| SMatrix::repeat(f64::NAN))
    }

    fn guard_by_parameters(&self, surface: S, state: &State<N>) -> RowSVector<f64, P> {
        self.guard(surface, state)
    }

    fn reset_by_parameters(&self, mode: M, surface: S, before: &State<N>) -> SMatrix<f64, N, P> {
        self.reset(mode, surface, before)
    }
}
