//! In which mode a state is, by the formulas `where` of the modes.

use crate::error::Error;
use crate::model::file::Model;
use equations::Formulas;
use validated_dynamics::Enclosure;

/// For each mode its formula, with the parameters of the model.
#[derive(Debug)]
pub(crate) struct Places<'a> {
    model: &'a Model,
    formulas: Vec<Option<Formulas>>,
}

impl<'a> Places<'a> {
    /// The places of the modes of a model.
    ///
    /// # Errors
    /// [`Error::Misuse`] for a text that is no formula.
    pub(crate) fn new(model: &'a Model) -> Result<Self, Error> {
        let formula = |(number, text): (usize, &Option<String>)| {
            let names = model.equations.names().clone();
            let formula = text.as_ref().map(|text| Formulas::from_text(names, &[text]));
            let formula = formula.transpose().map_err(|error| wrong(model, number, &error))?;
            if formula.as_ref().is_some_and(Formulas::uses_time) {
                let mode = &model.modes[number];
                let text = "it has the time t; a state alone must say whether it is in the mode";
                return Err(Error::Misuse(format!("the mode {mode}: where: {text}")));
            }
            Ok(formula)
        };
        let formulas =
            model.places.iter().enumerate().map(formula).collect::<Result<_, Error>>()?;
        Ok(Places { model, formulas })
    }

    /// Whether some mode has a formula.
    pub(crate) fn are_given(&self) -> bool {
        self.formulas.iter().any(Option::is_some)
    }

    /// The number of the first mode in which a state is: its formula is not negative there, or it has none.
    ///
    /// # Errors
    /// [`Error::Misuse`] for a state in no mode, and for a formula without a value.
    pub(crate) fn of(&self, state: &[f64]) -> Result<usize, Error> {
        for (number, formula) in self.formulas.iter().enumerate() {
            let Some(formula) = formula else { return Ok(number) };
            let value = formula.values(0.0, state);
            let value = value.map_err(|error| wrong(self.model, number, &error))?;
            if value.first().is_some_and(|value| *value >= 0.0) {
                return Ok(number);
            }
        }
        let states = self.model.equations.names().states.iter().zip(state);
        let values: Vec<String> = states.map(|(name, x)| format!("{name} = {x}")).collect();
        let values = values.join(", ");
        let reason = "the formulas `where` of all modes are negative there";
        Err(Error::Misuse(format!("the start {values} is in no mode: {reason}; give --mode")))
    }

    /// Whether all states of a box are in this mode, for certain.
    ///
    /// # Errors
    /// [`Error::Misuse`] for a formula without a value.
    pub(crate) fn hold(&self, mode: usize, states: &[Enclosure]) -> Result<bool, Error> {
        for (number, formula) in self.formulas.iter().enumerate().take(mode + 1) {
            let Some(formula) = formula else { return Ok(number == mode) };
            let value = formula.enclosures(Enclosure::ZERO, states);
            let value = value.map_err(|error| wrong(self.model, number, &error))?[0];
            let is_good = if number == mode { value.low() >= 0.0 } else { value.high() < 0.0 };
            if !is_good {
                return Ok(false);
            }
        }
        Ok(true)
    }
}

fn wrong(model: &Model, number: usize, error: &equations::Error) -> Error {
    Error::Misuse(format!("the mode {}: where: {error}", model.modes[number]))
}
