//! Where runs begin: at numbers, in boxes, on charts.

use crate::enclosed_map::StartSet;
use crate::event::carried;
use crate::run::ValidatedRun;
use crate::system::{ValidatedGuard, ValidatedSystem, without_time};
use crate::undecided::{Error, Reason};
use equations::{Arithmetic, Formulas, Names};
use interval_arithmetic::Enclosure;

/// A chart: states as formulas of some variables, in a mode.
///
/// A surface on which they are for all values of the variables is known exactly: a guard x − 0.5 is 0 on a chart whose x is 0.5.
#[derive(Debug, Clone)]
pub struct Chart {
    pub(crate) mode: usize,
    pub(crate) states: Formulas,
    slopes: Formulas,
    /// For each guard of the mode, true if it is 0 on the chart.
    on: Vec<bool>,
}

impl ValidatedSystem {
    /// The states in a mode that these texts give, a formula of the variables and the parameters for each component of the state.
    ///
    /// # Errors
    /// [`Error::Argument`] for a mode that is not there, and for another number of texts than components; [`Error::Formula`] for texts and
    /// names that are refused.
    pub fn chart(&self, mode: &str, variables: &[&str], states: &[&str]) -> Result<Chart, Error> {
        let mode = self.place_of(mode)?;
        if states.len() != self.names.states.len() {
            let names = self.names.states.join(", ");
            return Error::argument(
                "states",
                format!("{} given; needed are {names}", states.len()),
            );
        }
        let names = Names {
            states: variables.iter().map(|&name| name.to_owned()).collect(),
            ..self.names.clone()
        };
        let given = states.len();
        let states = Formulas::from_text(names, states)?;
        let states = without_time(states, "a chart has no time: give it a variable")?;
        if states.count() != given {
            return Error::argument("states", "a definition among the formulas: write it out");
        }
        let slopes = states.jacobian()?;
        let zero = |guard: &ValidatedGuard| Ok(guard.function.on(&states)?.vanishes() == [true]);
        let on = self.modes[mode].guards.iter().map(zero).collect::<Result<_, Error>>()?;
        Ok(Chart { mode, states, slopes, on })
    }

    /// A run from one state: decimals, or formulas of the parameters.
    ///
    /// # Errors
    /// As [`chart`](Self::chart); [`Error::Formula`] for a formula without a value.
    pub fn start(&self, mode: &str, states: &[&str]) -> Result<ValidatedRun<'_>, Error> {
        self.start_on(&self.chart(mode, &[], states)?, &[])
    }

    /// A run from all states of a chart whose variables are in a box. Its derivatives are those with respect to these variables.
    ///
    /// # Errors
    /// [`Error::Argument`] for another number of enclosures than variables, and for one without bounds; [`Error::Formula`] for a
    /// formula without a value.
    pub fn start_on(
        &self,
        chart: &Chart,
        variables: &[Enclosure],
    ) -> Result<ValidatedRun<'_>, Error> {
        self.start_set(chart, StartSet::of_box(variables))
    }

    /// The same of a set.
    pub(crate) fn start_set(
        &self,
        chart: &Chart,
        start: StartSet,
    ) -> Result<ValidatedRun<'_>, Error> {
        check_box(&chart.states.names().states, start.set.hull())?;
        let found = carried(&start.set, start.chain, (&chart.states, &chart.slopes));
        let (set, chain) = found.map_err(|error| {
            let mode = Some(self.modes[chart.mode].name);
            let states = (&chart.states.names().states[..], start.set.hull());
            Error::not_proved(Reason::Domain(error), mode, Enclosure::ZERO, states)
        })?;
        Ok(ValidatedRun::new(self, chart.mode, set, chain, chart.on.clone()))
    }

    /// A run from all states of a set, such as that of another run: of the same states without guards, say.
    ///
    /// # Errors
    /// As [`start_on`](Self::start_on).
    pub fn start_from(&self, mode: &str, start: StartSet) -> Result<ValidatedRun<'_>, Error> {
        let mode = self.place_of(mode)?;
        check_box(&self.names.states, start.set.hull())?;
        let on = vec![false; self.modes[mode].guards.len()];
        Ok(ValidatedRun::new(self, mode, start.set, start.chain, on))
    }

    /// A run from all states of a box.
    ///
    /// # Errors
    /// As [`start_on`](Self::start_on).
    pub fn start_box(&self, mode: &str, states: &[Enclosure]) -> Result<ValidatedRun<'_>, Error> {
        self.start_from(mode, StartSet::of_box(states))
    }
}

/// An error unless a box has these components, with bounds.
pub(crate) fn check_box(names: &[String], given: &[Enclosure]) -> Result<(), Error> {
    if names.len() != given.len() {
        let names = names.join(", ");
        return Error::argument(
            "box",
            format!("{} enclosures given; needed are {names}", given.len()),
        );
    }
    for (name, x) in names.iter().zip(given) {
        if !x.is_valid() {
            return Error::argument(name, format!("{x} is no interval of finite numbers"));
        }
    }
    Ok(())
}
