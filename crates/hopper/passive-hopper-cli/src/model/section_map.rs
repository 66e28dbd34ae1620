//! The return map of a proof, from its options, and whether it is what the flow does.

use crate::error::Error;
use crate::model::file::{Model, texts};
use crate::model::period::{check_period, spread};
use crate::model::places::Places;
use crate::model::prove::middle_of;
use crate::model::question::{
    Named, check_once, check_surface, failed, mode_at, named, named_mode,
};
use equations::{Formulas, Names};
use validated_dynamics::{EnclosedMap, Enclosure, SectionMap, StartSet, ValidatedSystem};

/// A return map.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct MapOptions {
    /// The surface at which the map ends
    #[arg(long)]
    surface: String,
    /// Events there until it ends
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    count: u16,
    /// The mode in which it begins [default: that of the file, or the first one whose `where` the point of --near fulfils]
    #[arg(long)]
    mode: Option<String>,
    /// The other states at the start, and the time t, as formulas of the coordinates, such as x=0; those that are not given are 0
    #[arg(long, num_args = 1.., value_name = "NAME=FORMULA", value_parser = named)]
    on: Vec<Named>,
    /// What is read behind the last event, in the order of the coordinates, such as y z "t - 2*pi" [default: the coordinates]. A formula does not begin with a sign: (-v)
    #[arg(long, num_args = 1.., value_name = "FORMULA")]
    read: Vec<String>,
}

/// The same with all that was left out.
#[derive(Debug, Clone)]
pub(crate) struct MapWords {
    surface: String,
    count: usize,
    pub(crate) mode: String,
    /// Whether the mode follows from a point, by `where`: then it must be that of all starts.
    is_of_place: bool,
    /// The coordinates of the section.
    pub(crate) variables: Vec<String>,
    /// The states at the start, and the time if the model uses it, as formulas of the coordinates.
    pub(crate) states: Vec<String>,
    read: Vec<String>,
}

impl MapOptions {
    /// The map with these coordinates, near a point.
    ///
    /// # Errors
    /// [`Error::Misuse`] for names that the model does not have.
    pub(crate) fn words(
        &self,
        model: &Model,
        (variables, near): (&[String], &[f64]),
    ) -> Result<MapWords, Error> {
        check_surface(model, &self.surface)?;
        let uses_time = !model.equations.is_autonomous();
        let own_states = &model.equations.names().states;
        check_once(&self.on.concat(), "--on")?;
        for (name, _) in self.on.iter().flatten() {
            let known = own_states.contains(name) || (uses_time && name == "t");
            if !known || variables.contains(name) {
                let reason = "it is no other state at the start: a state that is no coordinate, or the time t of a model that uses it";
                return Err(Error::misuse("--on", name, reason));
            }
        }
        let state = |name: &String| {
            let own = self.on.iter().flatten().find(|(known, _)| known == name);
            let default = if variables.contains(name) { name.clone() } else { "0".to_owned() };
            own.map_or(default, |(_, formula)| formula.clone())
        };
        let mut states: Vec<String> = own_states.iter().map(state).collect();
        if uses_time {
            // The time is a component, too.
            states.push(state(&"t".to_owned()));
        }
        let own = &states[..own_states.len()];
        let start = formulas_of(model, variables, own)?.values(0.0, near).map_err(failed)?;
        let mode = mode_at(self.mode.as_deref(), model, &start)?;
        let is_of_place = named_mode(self.mode.as_deref(), model)?.is_none();
        let read = if self.read.is_empty() { variables } else { &self.read[..] };
        Ok(MapWords {
            surface: self.surface.clone(),
            count: usize::from(self.count),
            mode,
            is_of_place,
            variables: variables.to_vec(),
            states,
            read: read.to_vec(),
        })
    }
}

impl MapWords {
    /// The map, which keeps its steps if `recorded`.
    ///
    /// # Errors
    /// [`Error::Model`] in the words of the library.
    pub(crate) fn map<'a>(
        &self,
        system: &'a ValidatedSystem,
        recorded: bool,
    ) -> Result<SectionMap<'a>, Error> {
        let map = self.map_reading(system, &texts(&self.read))?;
        Ok(if recorded { map.recorded() } else { map })
    }

    /// The map of which other formulas are read.
    ///
    /// # Errors
    /// As [`map`](Self::map).
    pub(crate) fn map_reading<'a>(
        &self,
        system: &'a ValidatedSystem,
        read: &[&str],
    ) -> Result<SectionMap<'a>, Error> {
        let start = system.chart(&self.mode, &texts(&self.variables), &texts(&self.states));
        let start = start.map_err(failed)?;
        SectionMap::new(system, start, &self.surface, self.count, read).map_err(failed)
    }
}

impl MapWords {
    /// Refuses starts that `where` puts into other modes than that in which the map begins.
    ///
    /// # Errors
    /// [`Error::Misuse`] if the starts of a box are not in the mode for certain.
    pub(crate) fn check_mode(&self, model: &Model, starts: &[Enclosure]) -> Result<(), Error> {
        if self.are_in_mode(model, starts)? {
            return Ok(());
        }
        let text = format!(
            "by `where` not all of these starts are in the mode {}, or that is not certain; give a smaller window, or --mode for starts \
             that are all in it",
            self.mode
        );
        Err(Error::Misuse(text))
    }

    /// Whether `where` puts all starts of a box into the mode in which the map begins, for certain; true for a mode that is named.
    ///
    /// # Errors
    /// [`Error::Misuse`] for a formula without a value.
    pub(crate) fn are_in_mode(&self, model: &Model, starts: &[Enclosure]) -> Result<bool, Error> {
        let places = Places::new(model)?;
        let number = model.modes.iter().position(|mode| *mode == self.mode);
        let Some(number) = number.filter(|_| self.is_of_place && places.are_given()) else {
            return Ok(true);
        };
        // Without the time.
        let states = &self.states[..model.equations.names().states.len()];
        let states = formulas_of(model, &self.variables, states)?;
        places.hold(number, &states.enclosures(Enclosure::ZERO, starts).map_err(failed)?)
    }
}

/// Points at which it is looked whether a map goes on as the flow does.
const LOOKED: usize = 12;

impl MapWords {
    /// Refuses a map whose iterates are not the flow: one that begins anew elsewhere than where it has ended, or at a time
    /// that is no period of the model. It is looked at points of the box with these middles and halves of sides, in enclosures. Formulas that differ
    /// are the same at all of them by chance only; a point whose way is not decided is passed over.
    ///
    /// # Errors
    /// [`Error::Misuse`] with the state that does not come back.
    pub(crate) fn check_closing(
        &self,
        model: &Model,
        system: &ValidatedSystem,
        (middle, half): (&[f64], &[f64]),
    ) -> Result<(), Error> {
        let own = model.equations.names();
        let again = formulas_of(model, &self.variables, &self.states)?;
        let components: Vec<&str> =
            own.states.iter().map(String::as_str).chain(["t"]).take(self.states.len()).collect();
        let maps = components
            .iter()
            .map(|component| self.map_reading(system, &[component]))
            .chain([self.map(system, false)])
            .collect::<Result<Vec<_>, Error>>()?;
        let inside = spread(LOOKED, middle.len())
            .map(|part| (0..middle.len()).map(|at| middle[at] + part[at] * half[at]).collect());
        let mut period: Option<Enclosure> = None;
        let mut around: Option<Vec<f64>> = None;
        for point in std::iter::once(middle.to_vec()).chain(inside) {
            let start: Vec<Enclosure> = point.iter().map(|x| Enclosure::from(*x)).collect();
            let end = |map: &SectionMap<'_>| {
                let image = map.carry(StartSet::of_box(&start).without_derivatives()).ok()?;
                Some(image.set.hull().to_vec())
            };
            let Some(ends) = maps.iter().map(end).collect::<Option<Vec<_>>>() else { continue };
            let Some((next, ends)) = ends.split_last() else { continue };
            let Ok(begin) = again.enclosures(Enclosure::ZERO, next) else { continue };
            for ((component, from), to) in components.iter().zip(&begin).zip(ends) {
                let to = to[0];
                if *component == "t" && own.states.len() < self.states.len() {
                    let own = to - *from;
                    if period.is_some_and(|period| apart(&period, &own)) {
                        let text = "--on, --read: the time between the ends of two returns and their beginnings differs from point to \
                                    point, so that it is no period; give the time as a coordinate, or a surface at fixed times";
                        return Err(Error::Misuse(text.to_owned()));
                    }
                    period = Some(own);
                } else if apart(&to, from) {
                    let text = format!(
                        "--on, --read: {component} is in {to} where a return ends, and in {from} where the next one begins: the map is not \
                         what the flow does; name {component} in --near, or give it in --on as it is there"
                    );
                    return Err(Error::Misuse(text));
                }
            }
            around.get_or_insert_with(|| {
                let end = |end: &Vec<Enclosure>| middle_of(&end[0]);
                ends.iter().take(own.states.len()).map(end).collect()
            });
        }
        match (period, around) {
            (Some(period), Some(around)) => {
                check_period(model, middle_of(&period), &around, Some(&self.surface), "--surface")
            }
            _ => Ok(()),
        }
    }
}

/// Formulas of the coordinates of a section.
fn formulas_of(model: &Model, variables: &[String], of: &[String]) -> Result<Formulas, Error> {
    let names = Names { states: variables.to_vec(), ..model.equations.names().clone() };
    let refused = |error: equations::Error| Error::Misuse(format!("--on: {error}"));
    Formulas::from_text(names, &texts(of)).map_err(refused)
}

fn apart(one: &Enclosure, other: &Enclosure) -> bool {
    one.high() < other.low() || other.high() < one.low()
}
