//! Motions that are integrated.

use super::motion::Motion;
use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::ode::{Tolerances, integrated_crossing, integrated_flow, integrated_states};
use crate::state::State;
use crate::system::HybridSystem;

/// The tolerance of a model that states none, relative and absolute: well below what a plot shows or an experiment
/// measures, and ten thousand times above the rounding of an integration. A smaller number costs steps; one below 1e-13
/// is lost in rounding.
const TOLERANCE: f64 = 1e-10;

/// A motion ẋ = f(x) that is integrated: a closure gives f(x) from the mode and the state.
#[derive(Debug, Clone, Copy)]
pub struct Integrated<F> {
    field: F,
    pub(super) tolerances: Tolerances,
}

impl<F> Integrated<F> {
    pub(super) const fn new(field: F) -> Self {
        Integrated { field, tolerances: Tolerances::both(TOLERANCE) }
    }
}

impl<M, Y, F, const N: usize> Motion<M, State<N>> for Integrated<F>
where
    M: Copy,
    Y: Into<State<N>>,
    F: Fn(M, &State<N>) -> Y,
{
    fn flow<T>(&self, system: &T, mode: M, start: &State<N>, time: f64) -> State<N>
    where
        T: HybridSystem<Mode = M, State = State<N>>,
    {
        integrated_flow(system, mode, start, time, self.tolerances)
    }

    fn states<T>(
        &self,
        system: &T,
        mode: M,
        start: &State<N>,
        times: &[f64],
    ) -> Result<Vec<State<N>>, Error>
    where
        T: HybridSystem<Mode = M, State = State<N>>,
    {
        integrated_states(system, mode, start, times, self.tolerances)
    }

    #[inline]
    fn field(&self, mode: M, state: &State<N>) -> Option<State<N>> {
        Some((self.field)(mode, state).into())
    }

    fn first_crossing<T>(
        &self,
        system: &T,
        mode: M,
        start: &State<N>,
        search: &Search<T::Surface>,
    ) -> Result<NextEvent<T::Surface, State<N>>, Error>
    where
        T: HybridSystem<Mode = M, State = State<N>>,
    {
        integrated_crossing(system, mode, start, search, self.tolerances)
    }
}
