//! Maps that are formulas.

use crate::enclosed_map::{Carried, EnclosedMap, StartSet, written};
use crate::event::carried;
use crate::matrix::Matrix;
use crate::set::{AffineSet, Chain};
use crate::start::check_box;
use crate::system::{parameters_as_json, without_time};
use crate::undecided::{Error, Reason};
use equations::Formulas;
use interval_arithmetic::Enclosure;
use serde_json::{Value, json};

/// A map that is formulas, applied some times. Variables behind the first ones, of which there are as many as formulas, are parameters.
#[derive(Debug, Clone)]
pub struct FormulaMap {
    formulas: Formulas,
    slopes: Formulas,
    times: usize,
    count: usize,
    is_recorded: bool,
}

impl FormulaMap {
    /// The map, applied `times` times.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// use validated_dynamics::{EnclosedMap, Enclosure, FormulaMap};
    /// let names = Names::new(&["x"], &[("a", "3.9")])?;
    /// let logistic = FormulaMap::new(Formulas::from_text(names, &["a*x*(1 - x)"])?, 2)?;
    /// let image = logistic.image(&[Enclosure::from(0.5)])?;
    /// assert!(image.values[0].contains(3.9 * 0.975 * 0.025) && image.values[0].width() < 1e-14);
    /// # Ok::<(), validated_dynamics::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Argument`] for fewer variables than formulas, and for 0 times; [`Error::Formula`] for a function with a kink or a jump.
    pub fn new(formulas: Formulas, times: usize) -> Result<FormulaMap, Error> {
        let (variables, count) = (formulas.names().states.len(), formulas.count());
        if count == 0 || count > variables {
            return Error::argument(
                "formulas",
                format!("{count} of them for {variables} variables"),
            );
        }
        if times == 0 {
            return Error::argument("times", "0, but the map is applied at least once");
        }
        let formulas = without_time(formulas, "a map has no time: give it a variable")?;
        // The parameters stay.
        let formulas = formulas.with_last_states(variables - count);
        Ok(FormulaMap { slopes: formulas.jacobian()?, formulas, times, count, is_recorded: false })
    }

    /// The same map, whose statements can be written into a [`Certificate`](crate::Certificate).
    #[must_use]
    pub fn recorded(mut self) -> Self {
        self.is_recorded = true;
        self
    }
}

impl EnclosedMap for FormulaMap {
    fn dimension(&self) -> usize {
        self.count
    }

    fn carry(&self, start: StartSet) -> Result<Carried, Error> {
        let StartSet { mut set, mut chain } = start;
        check_box(&self.formulas.names().states, set.hull())?;
        let mut record;
        (record, set) = written(self.is_recorded, set);
        for _ in 0..self.times {
            let next = carried(&set, chain, (&self.formulas, &self.slopes));
            (set, chain) = next.map_err(|error| {
                let names = &self.formulas.names().states;
                Error::not_proved(Reason::Domain(error), None, Enclosure::ZERO, (names, set.hull()))
            })?;
            if let Some(record) = &mut record {
                set = record.applied(&set);
            }
        }
        let (mut set, chain) = self.variables_of(&set, chain);
        if let Some(record) = &mut record {
            set = record.read(&set);
        }
        Ok(Carried { set, events: Vec::new(), chain, record })
    }

    fn as_json(&self) -> Option<(Option<Value>, Value)> {
        let names = self.formulas.names();
        let map = json!({
            "kind": "map",
            "variables": names.states,
            "parameters": parameters_as_json(names),
            "formulas": self.formulas.texts(),
            "dimension": self.count,
            "times": self.times,
        });
        Some((None, map))
    }
}

impl FormulaMap {
    /// The variables alone, without the parameters.
    fn variables_of(&self, set: &AffineSet, chain: Option<Chain>) -> (AffineSet, Option<Chain>) {
        let all = set.hull().len();
        if all == self.count {
            return (set.clone(), chain);
        }
        let first = Matrix::from_fn(self.count, all, |row, column| {
            Enclosure::from(f64::from(row == column))
        });
        let centre = first.apply(&set.centre_box());
        let hull = &set.hull()[..self.count];
        (set.image(&centre, &first, Some(hull)), chain.map(|chain| chain.then(&first)))
    }
}
