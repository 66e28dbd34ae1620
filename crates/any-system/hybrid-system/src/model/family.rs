//! A model and its neighbours: derivatives by parameters for models written with closures.

use super::derivatives::state_after;
use super::model::Model;
use super::motion::{ClosedForm, Motion};
use super::part::ModelPart;
use crate::parameter_sensitivity::Parametric;
use crate::state::State;
use crate::system::HybridSystem;
use nalgebra::{RowSVector, SMatrix};
use std::fmt::Debug;

/// Half the distance of the two parameters of a difference quotient, for a parameter of size 1: ε^⅓, as for the
/// components of a state.
const REACH: f64 = 6e-6;

/// A model that depends on P parameters, with its derivatives by them.
///
/// The derivatives of field, guards and resets are central differences between the models at neighbouring
/// parameters, with about ten digits if the model changes smoothly on the scale of max(1, |p|). So are those of a
/// flow in closed form. An integrated flow has its variational equation by the parameters, and so has the sliding
/// motion of a `Filippov` of an integrated model.
///
/// [`parameter_sensitivity`](crate::parameter_sensitivity) and
/// [`event_parameter_sensitivity`](crate::event_parameter_sensitivity) use it.
#[derive(Debug, Clone)]
pub struct Family<T, const P: usize> {
    system: T,
    /// For each parameter the models ahead and behind, and the distance of their parameters.
    neighbours: [(T, T, f64); P],
}

impl<T, const P: usize> Family<T, P> {
    /// The family of models that `model` makes, at these parameters. `model` is called once there, and twice for each
    /// parameter nearby.
    pub fn new(parameters: [f64; P], model: impl Fn([f64; P]) -> T) -> Self {
        let neighbours = std::array::from_fn(|p| {
            let reach = REACH * parameters[p].abs().max(1.0);
            let (mut ahead, mut behind) = (parameters, parameters);
            ahead[p] += reach;
            behind[p] -= reach;
            (model(ahead), model(behind), ahead[p] - behind[p])
        });
        Family { system: model(parameters), neighbours }
    }

    /// The model at the parameters.
    pub const fn system(&self) -> &T {
        &self.system
    }

    /// The derivative of a vector of the model by the parameters.
    pub(super) fn vector<const N: usize>(&self, of: impl Fn(&T) -> State<N>) -> SMatrix<f64, N, P> {
        let mut columns = SMatrix::<f64, N, P>::zeros();
        for (p, (ahead, behind, distance)) in self.neighbours.iter().enumerate() {
            columns.set_column(p, &((of(ahead) - of(behind)) / *distance));
        }
        columns
    }

    /// The derivative of a guard by the parameters.
    pub(super) fn guard<const N: usize>(
        &self,
        surface: T::Surface,
        state: &State<N>,
    ) -> RowSVector<f64, P>
    where
        T: HybridSystem<State = State<N>>,
    {
        let of = |system: &T| system.guard_value(surface, state);
        RowSVector::from_fn(|_, p| {
            let (ahead, behind, distance) = &self.neighbours[p];
            (of(ahead) - of(behind)) / distance
        })
    }

    /// The derivative of a reset by the parameters. It is NaN if the reset ends the execution nearby.
    pub(super) fn reset<const N: usize>(
        &self,
        mode: T::Mode,
        surface: T::Surface,
        before: &State<N>,
    ) -> SMatrix<f64, N, P>
    where
        T: HybridSystem<State = State<N>>,
    {
        self.vector(|system| state_after(system.reset(mode, surface, before)))
    }
}

impl<M, S, Y, F, Q, C, const N: usize, const P: usize> Parametric<N, P>
    for Family<Model<M, S, State<N>, ClosedForm<F>, Q, C>, P>
where
    M: Copy + Eq + Debug,
    S: Copy + Eq + Debug,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>, f64) -> Y,
    Q: ModelPart<M, S, State<N>>,
{
    type System = Model<M, S, State<N>, ClosedForm<F>, Q, C>;

    fn system(&self) -> &Self::System {
        &self.system
    }

    fn flow_by_parameters(&self, mode: M, start: &State<N>, time: f64) -> SMatrix<f64, N, P> {
        self.vector(|system| system.motion.flow(system, mode, start, time))
    }

    fn guard_by_parameters(&self, surface: S, state: &State<N>) -> RowSVector<f64, P> {
        self.guard(surface, state)
    }

    fn reset_by_parameters(&self, mode: M, surface: S, before: &State<N>) -> SMatrix<f64, N, P> {
        self.reset(mode, surface, before)
    }
}
