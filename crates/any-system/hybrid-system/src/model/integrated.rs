//! Motions that are integrated.

use super::motion::Motion;
use crate::crossing::{NextEvent, Search};
use crate::error::Error;
use crate::ode::{Tolerances, integrated_crossing, integrated_flow, integrated_states};
use crate::state::StateVector;
use crate::system::HybridSystem;

/// The tolerance of a model that states none, relative and absolute: far below what a plot shows or an experiment
/// measures, and far above the rounding of an integration. A smaller number costs steps; one below 1e-13 is lost in
/// rounding.
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

impl<M, X, Y, F> Motion<M, X> for Integrated<F>
where
    M: Copy,
    X: StateVector,
    Y: Into<X>,
    F: Fn(M, &X) -> Y,
{
    fn flow<T>(&self, system: &T, mode: M, start: &X, time: f64) -> X
    where
        T: HybridSystem<Mode = M, State = X>,
    {
        integrated_flow(system, mode, start, time, self.tolerances)
    }

    fn states<T>(&self, system: &T, mode: M, start: &X, times: &[f64]) -> Result<Vec<X>, Error>
    where
        T: HybridSystem<Mode = M, State = X>,
    {
        integrated_states(system, mode, start, times, self.tolerances)
    }

    #[inline]
    fn field(&self, mode: M, state: &X) -> Option<X> {
        Some((self.field)(mode, state).into())
    }

    fn first_crossing<T>(
        &self,
        system: &T,
        mode: M,
        start: &X,
        search: &Search<T::Surface>,
    ) -> Result<NextEvent<T::Surface, X>, Error>
    where
        T: HybridSystem<Mode = M, State = X>,
    {
        integrated_crossing(system, mode, start, search, self.tolerances)
    }
}
