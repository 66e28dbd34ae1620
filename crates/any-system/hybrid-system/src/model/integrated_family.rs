//! Derivatives by parameters for integrated models written with closures.

use super::family::Family;
use super::integrated::Integrated;
use super::model::Model;
use super::part::ModelPart;
use crate::ode::{Linearized, Tolerances, integrated_parameter_jacobian};
use crate::parameter_sensitivity::Parametric;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::{RowSVector, SMatrix};
use std::fmt::Debug;

impl<T, const P: usize> Family<T, P> {
    /// The derivative of an integrated flow by the parameters, from the `field` of each model. All entries are NaN
    /// if the integration fails, or a model has no field.
    pub(super) fn integrated_flow<const N: usize>(
        &self,
        (mode, start, time): (T::Mode, &State<N>, f64),
        field: impl Fn(&T, &State<N>) -> Option<State<N>>,
        tolerances: Tolerances,
    ) -> SMatrix<f64, N, P>
    where
        T: Linearized<N>,
    {
        let by_parameters = |state: &State<N>| {
            let none = || State::repeat(f64::NAN);
            self.vector(|system| field(system, state).unwrap_or_else(none))
        };
        integrated_parameter_jacobian(self.system(), mode, start, time, by_parameters, tolerances)
            .unwrap_or_else(|_| SMatrix::repeat(f64::NAN))
    }
}

impl<M, S, Y, F, Q, C, const N: usize, const P: usize> Parametric<N, P>
    for Family<Model<M, S, State<N>, Integrated<F>, Q, C>, P>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>) -> Y,
    Q: ModelPart<M, S, State<N>>,
{
    type System = Model<M, S, State<N>, Integrated<F>, Q, C>;

    fn system(&self) -> &Self::System {
        self.system()
    }

    fn flow_by_parameters(&self, mode: M, start: &State<N>, time: f64) -> SMatrix<f64, N, P> {
        let field = |system: &Self::System, state: &State<N>| system.vector_field(mode, state);
        self.integrated_flow((mode, start, time), field, self.system().motion.tolerances)
    }

    fn guard_by_parameters(&self, surface: S, state: &State<N>) -> RowSVector<f64, P> {
        self.guard(surface, state)
    }

    fn reset_by_parameters(&self, mode: M, surface: S, before: &State<N>) -> SMatrix<f64, N, P> {
        self.reset(mode, surface, before)
    }
}
