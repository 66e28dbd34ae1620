//! The return map of a proof, from its options.

use crate::error::Error;
use crate::model::file::{Model, texts};
use crate::model::question::{check_surface, failed, mode_of, named};
use validated_dynamics::{SectionMap, ValidatedSystem};

/// A return map.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct MapOptions {
    /// The surface at which the map ends
    #[arg(long)]
    surface: String,
    /// Events there until it ends
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u16).range(1..))]
    count: u16,
    /// The mode in which it begins [default: that of the file, or the first one]
    #[arg(long)]
    mode: Option<String>,
    /// The other states at the start, and the time t, as formulas of the coordinates, such as x=0; those that are not given are 0
    #[arg(long, num_args = 1.., value_name = "NAME=FORMULA", value_parser = named)]
    on: Vec<(String, String)>,
    /// What is read behind the last event, in the order of the coordinates, such as y z "t - 2*pi" [default: the coordinates]
    #[arg(long, num_args = 1.., value_name = "FORMULA", allow_hyphen_values = true)]
    read: Vec<String>,
}

/// The same with all that was left out.
#[derive(Debug, Clone)]
pub(crate) struct MapWords {
    surface: String,
    count: usize,
    pub(crate) mode: String,
    /// The coordinates of the section.
    pub(crate) variables: Vec<String>,
    /// The states at the start, and the time if the model uses it, as formulas of the coordinates.
    pub(crate) states: Vec<String>,
    read: Vec<String>,
}

impl MapOptions {
    /// The map with these coordinates.
    ///
    /// # Errors
    /// [`Error::Misuse`] for names that the model does not have.
    pub(crate) fn words(&self, model: &Model, variables: &[String]) -> Result<MapWords, Error> {
        let mode = mode_of(self.mode.as_deref(), model)?;
        check_surface(model, &self.surface)?;
        let uses_time = !model.equations.is_autonomous();
        let own_states = &model.equations.names().states;
        for (name, _) in &self.on {
            let known = own_states.contains(name) || (uses_time && name == "t");
            if !known || variables.contains(name) {
                let reason = "it is no other state at the start: a state that is no coordinate, or the time t of a model that uses it";
                return Err(Error::misuse("--on", name, reason));
            }
        }
        let state = |name: &String| {
            let own = self.on.iter().find(|(known, _)| known == name);
            let default = if variables.contains(name) { name.clone() } else { "0".to_owned() };
            own.map_or(default, |(_, formula)| formula.clone())
        };
        let mut states: Vec<String> = own_states.iter().map(state).collect();
        if uses_time {
            // The time is a component, too.
            states.push(state(&"t".to_owned()));
        }
        let read = if self.read.is_empty() { variables } else { &self.read[..] };
        Ok(MapWords {
            surface: self.surface.clone(),
            count: usize::from(self.count),
            mode,
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
