//! What all commands ask: the model, its parameters, a start.

use crate::error::Error;
use crate::model::file::{self, Model};
use crate::model::places::Places;
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
    set: Vec<Named>,
}

/// The start.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct StartOptions {
    /// The mode in which it starts [default: that of the file, or the first one whose `where` the start fulfils]
    #[arg(long)]
    pub(crate) mode: Option<String>,
    /// States at the start, such as x=1,v=0; the others are those of the file, or 0
    #[arg(long, num_args = 1.., value_name = "NAME=VALUE", value_parser = named)]
    pub(crate) start: Vec<Named>,
}

/// Names with values, as they stand in one argument.
pub(crate) type Named = Vec<(String, String)>;

/// Names with values, such as x=1,v=0. A comma in parentheses belongs to a formula.
pub(crate) fn named(text: &str) -> Result<Named, String> {
    let mut depth = 0;
    let is_between = |c: char| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && depth == 0
    };
    let pair = |part: &str| match part.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("give a name and a value, such as x=1".to_owned()),
    };
    text.split(is_between).map(pair).collect()
}

/// The error of a library, in its words.
pub(crate) fn failed(error: impl std::fmt::Display) -> Error {
    Error::Model(error.to_string())
}

impl ModelOptions {
    /// The same for a question that does not follow motions along surfaces.
    ///
    /// # Errors
    /// As [`sliding_model`](Self::sliding_model), and [`Error::Misuse`] for a model with such motions.
    pub(crate) fn model(&self) -> Result<Model, Error> {
        let model = self.sliding_model()?;
        if model.slides {
            let text = "the file says slides = true, and only `nonsmooth run` follows motions along surfaces; write such a motion as a mode";
            return Err(Error::Misuse(format!("{}: {text}", self.file.display())));
        }
        Ok(model)
    }

    /// The model with the parameters that are given.
    ///
    /// # Errors
    /// Those of the file; [`Error::Misuse`] for other parameters.
    pub(crate) fn sliding_model(&self) -> Result<Model, Error> {
        let mut model = file::read(&self.file)?;
        let decimal = |(name, value): &(String, String)| {
            let value = file::decimal(value, name);
            Ok((name.clone(), value.map_err(|reason| Error::Misuse(format!("--set: {reason}")))?))
        };
        check_once(&self.set.concat(), "--set")?;
        let set = self.set.iter().flatten().map(decimal).collect::<Result<Vec<_>, Error>>()?;
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
        let state = self.state(model)?;
        Ok((mode_at(self.mode.as_deref(), model, &state)?, state))
    }

    /// The state.
    pub(crate) fn state(&self, model: &Model) -> Result<Vec<f64>, Error> {
        let states = &model.equations.names().states;
        let mut texts = vec!["0".to_owned(); states.len()];
        for (name, value) in &model.start.state {
            texts[place_of(states, name, "[start] of the file:")?] = value.text();
        }
        check_once(&self.start.concat(), "--start")?;
        for (name, value) in self.start.iter().flatten() {
            texts[place_of(states, name, "--start")?].clone_from(value);
        }
        numbers(model, &texts, "--start")
    }
}

/// The mode that is given, or that of the file's start.
///
/// # Errors
/// [`Error::Misuse`] for a mode that the model does not have.
pub(crate) fn named_mode(given: Option<&str>, model: &Model) -> Result<Option<String>, Error> {
    let Some(mode) = given.or(model.start.mode.as_deref()) else { return Ok(None) };
    if model.modes.iter().any(|known| known == mode) {
        return Ok(Some(mode.to_owned()));
    }
    let reason = format!("there is no such mode; there are: {}", model.modes.join(", "));
    Err(Error::misuse("--mode", shortened(mode), &reason))
}

/// The mode that is given, that of the file's start, or the one in which this state is.
///
/// # Errors
/// As [`named_mode`] and [`Places::of`].
pub(crate) fn mode_at(given: Option<&str>, model: &Model, state: &[f64]) -> Result<String, Error> {
    match named_mode(given, model)? {
        Some(mode) => Ok(mode),
        None => Ok(model.modes[Places::new(model)?.of(state)?].clone()),
    }
}

/// Refuses a name that stands twice: one of the values would not count.
pub(crate) fn check_once(given: &[(String, String)], option: &str) -> Result<(), Error> {
    let twice = |(at, (name, _)): (usize, &(String, String))| {
        given[..at].iter().any(|(own, _)| own == name).then(|| name.clone())
    };
    match given.iter().enumerate().find_map(twice) {
        Some(name) => Err(Error::misuse(option, shortened(&name), "it stands twice")),
        None => Ok(()),
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

/// The names of an option, in their order.
pub(crate) fn names_of(given: &[(String, String)]) -> Vec<String> {
    given.iter().map(|(name, _)| name.clone()).collect()
}

/// The values of some states that are all named, in the order of `names`.
pub(crate) fn point(
    model: &Model,
    names: &[String],
    given: &[(String, String)],
    option: &str,
) -> Result<Vec<f64>, Error> {
    check_once(given, option)?;
    let value = |name: &String| {
        let found = given.iter().find(|(own, _)| own == name);
        let reason = || format!("{name} is missing; give {name}=NUMBER");
        found
            .map(|(_, value)| value.clone())
            .ok_or_else(|| Error::Misuse(format!("{option}: {}", reason())))
    };
    let texts = names.iter().map(value).collect::<Result<Vec<String>, Error>>()?;
    if let Some((unknown, _)) = given.iter().find(|(own, _)| !names.contains(own)) {
        let reason = format!("this is none of {}", names.join(", "));
        return Err(Error::misuse(option, shortened(unknown), &reason));
    }
    numbers(model, &texts, option)
}
