//! What all commands ask: the model, its parameters, a start.

use crate::error::Error;
use crate::model::file::{self, Model};
use crate::refusal::shortened;
use equations::{Formulas, Names};
use std::collections::BTreeSet;
use std::path::PathBuf;

/// The model, and its parameters.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct ModelOptions {
    /// The file with the equations: TOML, or JSON if it ends in .json
    file: PathBuf,
    /// Give a parameter another value, such as g=1.62; may be given more than once
    #[arg(long = "set", value_name = "NAME=VALUE", value_parser = named)]
    set: Vec<(String, String)>,
}

/// The start.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct StartOptions {
    /// The mode in which it starts [default: that of the file, or the first one]
    #[arg(long)]
    pub(crate) mode: Option<String>,
    /// States at the start, such as x=1 v=0; the others are those of the file, or 0
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE", value_parser = named)]
    pub(crate) start: Vec<(String, String)>,
}

/// A name with a value.
pub(crate) fn named(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("give a name and a value, such as x=1".to_owned()),
    }
}

/// The error of a library, in its words.
pub(crate) fn failed(error: impl std::fmt::Display) -> Error {
    Error::Model(error.to_string())
}

impl ModelOptions {
    /// The model with the parameters that are given.
    pub(crate) fn model(&self) -> Result<Model, Error> {
        let mut model = file::read(&self.file)?;
        let decimal = |(name, value): &(String, String)| {
            let value = file::decimal(value, name);
            Ok((name.clone(), value.map_err(|reason| Error::Misuse(format!("--set: {reason}")))?))
        };
        let set = self.set.iter().map(decimal).collect::<Result<Vec<_>, Error>>()?;
        let set: Vec<(&str, &str)> =
            set.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
        let known = &model.equations.names().parameters;
        if let Some((name, _)) = set.iter().find(|(name, _)| !known.iter().any(|own| own == name)) {
            let known = known.join(", ");
            let reason = format!("there is no such parameter; there are: {known}");
            return Err(Error::misuse("--set", shortened(name), &reason));
        }
        if !set.is_empty() {
            model.equations = model.equations.with_parameters(&set);
            model.equations.check().map_err(|error| Error::Misuse(format!("--set: {error}")))?;
        }
        Ok(model)
    }
}

impl StartOptions {
    /// The mode and the state.
    pub(crate) fn start_in(&self, model: &Model) -> Result<(String, Vec<f64>), Error> {
        let states = &model.equations.names().states;
        let mut texts = vec!["0".to_owned(); states.len()];
        for (name, value) in &model.start.state {
            texts[place_of(states, name, "[start] of the file:")?] = value.text();
        }
        for (name, value) in &self.start {
            texts[place_of(states, name, "--start")?].clone_from(value);
        }
        Ok((mode_of(self.mode.as_deref(), model)?, numbers(model, &texts, "--start")?))
    }
}

/// The mode that is given, that of the file, or the first one.
pub(crate) fn mode_of(given: Option<&str>, model: &Model) -> Result<String, Error> {
    let mode = given.or(model.start.mode.as_deref());
    let Some(mode) = mode.or(model.modes.first().map(String::as_str)) else {
        return Err(Error::Misuse("the model has no mode".to_owned()));
    };
    match model.modes.iter().any(|known| known == mode) {
        true => Ok(mode.to_owned()),
        false => {
            let reason = format!("there is no such mode; there are: {}", model.modes.join(", "));
            Err(Error::misuse("--mode", shortened(mode), &reason))
        }
    }
}

/// Refuses a surface that the model has not.
pub(crate) fn check_surface(model: &Model, surface: &str) -> Result<(), Error> {
    let all = model.equations.surfaces().map(|(_, surface)| surface.to_string());
    let known: BTreeSet<String> = all.collect();
    if known.contains(surface) {
        return Ok(());
    }
    let names = known.into_iter().collect::<Vec<_>>().join(", ");
    let reason = match names.is_empty() {
        true => "the model has no surface".to_owned(),
        false => format!("there is no such surface; there are: {names}"),
    };
    Err(Error::misuse("--surface", shortened(surface), &reason))
}

/// The place of a state.
pub(crate) fn place_of(states: &[String], name: &str, option: &str) -> Result<usize, Error> {
    states.iter().position(|known| known == name).ok_or_else(|| {
        let reason = format!("there is no such state; there are: {}", states.join(", "));
        Error::misuse(option, shortened(name), &reason)
    })
}

/// The values of texts, which may be formulas of the parameters.
pub(crate) fn numbers(model: &Model, texts: &[String], option: &str) -> Result<Vec<f64>, Error> {
    let own = model.equations.names();
    let names = Names { states: Vec::new(), ..own.clone() };
    let refused = |error: equations::Error| Error::Misuse(format!("{option}: {error}"));
    let formulas = Formulas::from_text(names, &file::texts(texts)).map_err(refused)?;
    formulas.values(0.0, &[]).map_err(refused)
}

/// The values of some states that are all named, in the order of `names`.
pub(crate) fn point(
    model: &Model,
    names: &[String],
    given: &[(String, String)],
    option: &str,
) -> Result<Vec<f64>, Error> {
    let value = |name: &String| {
        let found = given.iter().find(|(own, _)| own == name);
        let reason = || format!("{name} is missing; give {name}=NUMBER");
        found
            .map(|(_, value)| value.clone())
            .ok_or_else(|| Error::Misuse(format!("{option}: {}", reason())))
    };
    let texts = names.iter().map(value).collect::<Result<Vec<String>, Error>>()?;
    if let Some(name) = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name)) {
        return Err(Error::misuse(option, shortened(name.1), "it stands twice"));
    }
    if let Some((unknown, _)) = given.iter().find(|(own, _)| !names.contains(own)) {
        let reason = format!("this is none of {}", names.join(", "));
        return Err(Error::misuse(option, shortened(unknown), &reason));
    }
    numbers(model, &texts, option)
}
