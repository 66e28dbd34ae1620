//! Values of formulas, with derivatives.

use crate::error::Error;
use equations::{Formulas, Jet, JetSeries};

/// Some formulas of states, the time and parameters, with derivatives.
#[derive(Debug)]
pub(super) struct FormulaValues(JetSeries);

impl FormulaValues {
    pub(super) fn new(
        formulas: &Formulas,
        what: &'static str,
        (needed, most): (usize, usize),
    ) -> Result<FormulaValues, Error> {
        let given = formulas.count();
        if given < needed || given > most {
            return Err(equations::Error::Length { what, needed, given }.into());
        }
        Ok(FormulaValues(JetSeries::of_values(&formulas.with_time_as_state(None))?))
    }

    pub(super) fn values<const T: usize>(
        &self,
        (state, time): (&[Jet<T>], Jet<T>),
        parameters: impl Iterator<Item = Jet<T>>,
    ) -> Result<Vec<Jet<T>>, Error> {
        let all: Vec<_> = state.iter().copied().chain([time]).chain(parameters).collect();
        Ok(self.0.values(&all)?)
    }
}
