//! Maps that are formulas.

use crate::certificate::Record;
use crate::division::{Budget, divided, halves};
use crate::enclosed_map::{Carried, EnclosedMap, StartSet, written};
use crate::event::carried;
use crate::matrix::Matrix;
use crate::set::{AffineSet, Chain};
use crate::start::check_box;
use crate::system::{parameters_as_json, without_time};
use crate::undecided::{Error, Reason};
use equations::Formulas;
use hybrid_system::Label;
use interval_arithmetic::Enclosure;
use serde_json::{Value, json};

/// How far conditions are positive on a set, as a part of their width there: so another program that encloses them by other means finds them positive,
/// too.
const MARGIN: f64 = 1.0 / 64.0;

/// A map that is formulas, applied some times. Variables behind the first ones, of which there are as many as formulas, are parameters.
#[derive(Debug, Clone)]
pub struct FormulaMap {
    formulas: Formulas,
    slopes: Formulas,
    times: usize,
    count: usize,
    sets: Vec<(Label, Formulas)>,
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
        let slopes = formulas.jacobian()?;
        Ok(FormulaMap { slopes, formulas, times, count, sets: Vec::new(), is_recorded: false })
    }

    /// The same map with a set: the points at which all `conditions` are positive. Images, after all applications, that lie in it as a whole are
    /// [`Reason::Stopped`] at its name, and cells of basins whose points come to it have this fate.
    ///
    /// An orbit may come to a set and leave it again. It stays in one that [`keeps`](Self::keeps) its points.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// use validated_dynamics::{Division, Enclosure, FormulaMap, ProvedBasins, ProvedFate};
    /// let names = Names::new(&["x"], &[])?;
    /// let map = FormulaMap::new(Formulas::from_text(names, &["2*x + x^3"])?, 1)?.with_set("far", &["x^2 - 1"])?;
    /// let window = [Enclosure::between(-2.0, 2.0)?];
    /// let division = Division { first: 4, last: 10, images: 10_000 };
    /// let basins = ProvedBasins::new(&[&map], Vec::new(), &[&window], division)?;
    /// let ProvedFate::Stopped(set) = basins.fate(0, &[0.1]).unwrap() else { panic!() };
    /// assert_eq!(set, *"far");
    /// assert_eq!(basins.fate(0, &[0.0]), None);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::Argument`] for a name that is no label or is in use, and without conditions; [`Error::Formula`] for a condition that is no formula of
    /// the map's variables and parameters.
    pub fn with_set(mut self, name: &str, conditions: &[&str]) -> Result<Self, Error> {
        let label = Label::new(name).or_else(|error| Error::argument(name, error.to_string()))?;
        if conditions.is_empty() || self.sets.iter().any(|(known, _)| *known == label) {
            return Error::argument(name, "a set has conditions, and a name of its own");
        }
        let formulas = Formulas::from_text(self.formulas.names().clone(), conditions)?;
        self.sets.push((label, without_time(formulas, "a map has no time: give it a variable")?));
        Ok(self)
    }

    /// Boxes that cover the part of a set in `domain`, whose images are in the set and in `domain`: the map leads this part into itself. Points of the
    /// set outside of `domain` are not looked at.
    ///
    /// # Errors
    /// [`Error::Argument`] for a set that the map has not, or that has no point there; [`Reason::NotInside`] if a box is open within the budget; as [`carry`](EnclosedMap::carry).
    pub fn keeps(
        &self,
        set: &str,
        domain: &[Enclosure],
        budget: Budget,
    ) -> Result<Vec<Vec<Enclosure>>, Error> {
        let place = self.sets.iter().position(|(label, _)| *label == *set);
        let Some((_, conditions)) = place.map(|place| &self.sets[place]) else {
            return Error::argument(set, "no set of the map");
        };
        if self.times != 1 {
            return Error::argument(
                "times",
                format!("{}, but a set keeps its points at each one", self.times),
            );
        }
        let found = divided(domain, budget, halves, |part| {
            let is_beyond = |value: &Enclosure| value.high() <= 0.0;
            let values = conditions.enclosures(Enclosure::ZERO, part);
            if values.is_ok_and(|values| values.iter().any(is_beyond)) {
                return Ok(Some(false));
            }
            let image = self.follow(StartSet::of_box(part).without_derivatives())?.set;
            let stays = image.hull().iter().zip(domain).all(|(own, whole)| own.is_inside(whole));
            Ok((stays && holds(conditions, &image)).then_some(true))
        })?;
        if let Some((part, _)) = found.open.first() {
            return Err(Error::of_variables(Reason::NotInside { tries: budget.boxes }, part));
        }
        if !found.decided.iter().any(|(_, may_be_in)| *may_be_in) {
            return Error::argument(set, "no point of the domain is in it");
        }
        Ok(found.decided.into_iter().map(|(part, _)| part).collect())
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
        let Followed { set, chain, mut record, set_of } = self.follow(start)?;
        if let Some(surface) = set_of {
            return Err(self.not_proved(Reason::Stopped { surface }, &set));
        }
        let (mut set, chain) = self.variables_of(&set, chain);
        if let Some(record) = &mut record {
            set = record.read(&set);
        }
        Ok(Carried { set, events: Vec::new(), chain, record })
    }

    fn end_of(&self, start: StartSet) -> Result<Option<Record>, Error> {
        Ok(self.follow(start)?.record)
    }

    fn as_json(&self) -> Option<(Option<Value>, Value)> {
        let names = self.formulas.names();
        let mut map = json!({
            "kind": "map",
            "variables": names.states,
            "parameters": parameters_as_json(names),
            "formulas": self.formulas.texts(),
            "dimension": self.count,
            "times": self.times,
        });
        if !self.sets.is_empty() {
            let set = |(label, conditions): &(Label, Formulas)| {
                json!([label.as_str(), conditions.texts()])
            };
            map["sets"] = self.sets.iter().map(set).collect();
        }
        Some((None, map))
    }
}

/// The images of a set, and the first set of the map in which they lie.
struct Followed {
    set: AffineSet,
    chain: Option<Chain>,
    record: Option<Record>,
    set_of: Option<Label>,
}

/// True if all conditions are positive at all points, by a part of what they vary by.
fn holds(conditions: &Formulas, set: &AffineSet) -> bool {
    let values = conditions.enclosures(Enclosure::ZERO, set.hull());
    values.is_ok_and(|values| values.iter().all(|value| value.low() > MARGIN * value.width()))
}

impl FormulaMap {
    fn follow(&self, start: StartSet) -> Result<Followed, Error> {
        let StartSet { mut set, mut chain } = start;
        check_box(&self.formulas.names().states, set.hull())?;
        let mut record;
        (record, set) = written(self.is_recorded, set);
        for _ in 0..self.times {
            let next = carried(&set, chain, (&self.formulas, &self.slopes));
            (set, chain) = next.map_err(|error| self.not_proved(Reason::Domain(error), &set))?;
            if let Some(record) = &mut record {
                set = record.applied(&set);
            }
        }
        let set_of = self.sets.iter().find(|(_, conditions)| holds(conditions, &set));
        let set_of = set_of.map(|(label, _)| *label);
        Ok(Followed { set, chain, record, set_of })
    }

    fn not_proved(&self, reason: Reason, set: &AffineSet) -> Error {
        Error::not_proved(
            reason,
            None,
            Enclosure::ZERO,
            (&self.formulas.names().states, set.hull()),
        )
    }

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
