//! The series of one mode: of the motion, of its derivatives, and of the guards along it.

use crate::matrix::Matrix;
use crate::undecided::Error;
use equations::{Coefficients, Formulas, Series};
use hybrid_system::ModeParts;
use interval_arithmetic::Enclosure;

/// What is expanded in time along the motions of a mode.
#[derive(Debug)]
pub(crate) struct ModeSeries {
    /// The number of components of the state.
    pub(crate) dimension: usize,
    /// The number of guards.
    pub(crate) guards: usize,
    /// The motion, with the guards.
    plain: Series,
    /// The motion and its derivatives, with the guards and theirs.
    varied: Series,
}

/// The coefficients of a motion with its derivatives, and of the guards along it.
#[derive(Debug, Clone)]
pub(crate) struct Varied {
    dimension: usize,
    all: Coefficients<Enclosure>,
}

impl ModeSeries {
    pub(crate) fn new(mode: &ModeParts) -> Result<ModeSeries, Error> {
        let watched = Formulas::all_of(mode.guards.iter().map(|guard| &guard.function))?;
        let carried = mode.field.carried();
        let varied = watched.as_ref().map(|watched| watched.with_variations(&carried));
        let varied = varied.transpose()?;
        Ok(ModeSeries {
            dimension: mode.field.names().states.len(),
            guards: mode.guards.len(),
            plain: Series::new(&mode.field, watched.as_ref())?,
            varied: Series::new(&mode.field.with_variations(&carried)?, varied.as_ref())?,
        })
    }

    /// The coefficients from a state, up to an order.
    pub(crate) fn motion(
        &self,
        state: &[Enclosure],
        order: usize,
    ) -> Result<Coefficients<Enclosure>, equations::Error> {
        self.plain.coefficients(Enclosure::ZERO, state, order)
    }

    /// The coefficients from a state and derivatives there, up to an order.
    pub(crate) fn varied(
        &self,
        state: &[Enclosure],
        derivatives: &Matrix,
        order: usize,
    ) -> Result<Varied, equations::Error> {
        let start = [state, derivatives.entries()].concat();
        let all = self.varied.coefficients(Enclosure::ZERO, &start, order)?;
        Ok(Varied { dimension: self.dimension, all })
    }
}

impl Varied {
    /// Of a component of the state.
    pub(crate) fn state(&self, component: usize) -> &[Enclosure] {
        self.all.state(component)
    }

    /// Of the derivative of a component with respect to one of the start.
    pub(crate) fn derivative(&self, component: usize, of: usize) -> &[Enclosure] {
        self.all.state(self.dimension * (1 + component) + of)
    }

    /// Of all components of the state.
    pub(crate) fn states(&self) -> impl Iterator<Item = &[Enclosure]> {
        self.all.states().take(self.dimension)
    }

    /// Of all derivatives, row by row.
    pub(crate) fn derivatives(&self) -> impl Iterator<Item = &[Enclosure]> {
        self.all.states().skip(self.dimension)
    }

    /// Of a guard.
    pub(crate) fn guard(&self, guard: usize) -> &[Enclosure] {
        self.all.watched(guard)
    }

    /// Of the derivative of a guard with respect to a component of the start.
    pub(crate) fn guard_derivative(&self, guards: usize, guard: usize, of: usize) -> &[Enclosure] {
        self.all.watched(guards + guard * self.dimension + of)
    }
}
