//! A model in a file: TOML or JSON with texts of formulas, or what `Equations::to_json` writes.

use crate::error::Error;
use crate::model::places::Places;
use equations::{Formulas, Names};
use hybrid_system::Equations;
use serde::Deserialize;
use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

/// The largest file that is read: a model is some lines.
const LARGEST: u64 = 1 << 24;

/// A number, or a text with one: a formula of numbers, such as "2*pi/1.3", is one, too.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
pub(crate) enum Number {
    Whole(i64),
    Real(f64),
    Text(String),
}

impl Number {
    /// Its text. Decimals of a file are exact: 0.1 is a tenth.
    pub(crate) fn text(&self) -> String {
        match self {
            Number::Whole(number) => number.to_string(),
            Number::Real(number) => number.to_string(),
            Number::Text(text) => text.clone(),
        }
    }
}

/// A model with the start of a run.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct ModelFile {
    states: Vec<String>,
    #[serde(default)]
    parameters: BTreeMap<String, Number>,
    mode: Vec<Mode>,
    /// Whether a run goes on along a surface at which the fields of both sides point.
    #[serde(default)]
    slides: bool,
    #[serde(default)]
    start: Start,
}

/// A mode: the rate of each state, and the surfaces that are watched in it.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Mode {
    name: String,
    rates: BTreeMap<String, Number>,
    #[serde(default)]
    surface: Vec<Surface>,
    /// Where the states of the mode are: this formula is not negative there. A start without a mode is in the first one that has it.
    #[serde(rename = "where")]
    place: Option<String>,
    /// The mode behind infinitely many events in finite time, and the states there that are not their limit.
    rests: Option<String>,
    #[serde(default)]
    at_rest: BTreeMap<String, Number>,
}

/// A surface with what happens there; without `resets`, `to` and `stops` nothing does.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Surface {
    name: String,
    guard: Option<String>,
    #[serde(default)]
    direction: Direction,
    /// Times in place of a guard: the first one, and the time between two.
    first: Option<Number>,
    period: Option<Number>,
    only_where: Option<String>,
    #[serde(default)]
    resets: BTreeMap<String, Number>,
    to: Option<String>,
    #[serde(default)]
    stops: bool,
    /// What lies beyond: nothing (`contact`), or the states on the other side (`crossing`).
    beyond: Option<Beyond>,
}

/// What is beyond a surface, where a jump or a start leads there.
#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Beyond {
    Contact,
    Crossing,
}

#[derive(Debug, Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Direction {
    Rising,
    Falling,
    #[default]
    Either,
}

/// The start of a run.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Start {
    /// The mode; without it the first one.
    pub(crate) mode: Option<String>,
    /// The states; those that are not named are 0.
    #[serde(default)]
    pub(crate) state: BTreeMap<String, Number>,
    /// The time at which the run ends.
    pub(crate) time: Option<Number>,
}

/// A model that was read.
#[derive(Debug, Clone)]
pub(crate) struct Model {
    pub(crate) equations: Equations,
    pub(crate) start: Start,
    /// The modes, in their order.
    pub(crate) modes: Vec<String>,
    /// The surfaces that are times.
    pub(crate) clocks: Vec<String>,
    /// For each mode a formula that is not negative at its states, if the file has one.
    pub(crate) places: Vec<Option<String>>,
    /// Whether a run goes on along a surface at which the fields of both sides point.
    pub(crate) slides: bool,
}

/// Reads a file. The ending .json says JSON; others are TOML.
///
/// # Errors
/// [`Error::File`] for a file that cannot be read; [`Error::Misuse`] for one that is no model, with the place.
pub(crate) fn read(path: &Path) -> Result<Model, Error> {
    let refused = |reason: String| Error::Misuse(format!("{}: {reason}", path.display()));
    let unread = |error: std::io::Error| refused(error.to_string());
    let mut text = String::new();
    let file = std::fs::File::open(path).map_err(unread)?;
    file.take(LARGEST + 1).read_to_string(&mut text).map_err(unread)?;
    if text.len() as u64 > LARGEST {
        return Err(refused("it has more than 16 MB; a model has some lines".to_owned()));
    }
    if let Some((line, number)) = longer_than_a_double(&text) {
        let reason = format!(
            "line {line}: {number} has more digits than a number of 64 bits; give it as a text, in quotes"
        );
        return Err(refused(reason));
    }
    let is_json = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
    if is_json && text.contains("\"hybrid equations\"") {
        let equations = Equations::from_json(&text).map_err(|error| refused(error.to_string()))?;
        let parts = equations.mode_parts(&[]).map_err(|error| refused(error.to_string()))?;
        let modes: Vec<String> = parts.iter().map(|mode| mode.name.to_string()).collect();
        let (clocks, places) = (clocks_of(&text), vec![None; modes.len()]);
        let start = Start::default();
        return Ok(Model { equations, start, modes, clocks, places, slides: false });
    }
    let file: ModelFile = match is_json {
        true => serde_json::from_str(&text).map_err(|error| refused(error.to_string()))?,
        false => toml::from_str(&text).map_err(|error| refused(in_line(&text, &error)))?,
    };
    let equations = equations_of(&file).map_err(&refused)?;
    equations.check().map_err(|error| refused(error.to_string()))?;
    let modes = file.mode.iter().map(|mode| mode.name.clone()).collect();
    let surfaces = file.mode.iter().flat_map(|mode| &mode.surface);
    let clocks = surfaces.filter(|own| own.guard.is_none()).map(|own| own.name.clone()).collect();
    let places = file.mode.iter().map(|mode| mode.place.clone()).collect();
    let model = Model { equations, start: file.start, modes, clocks, places, slides: file.slides };
    // A formula that is none is refused with the file.
    Places::new(&model).map_err(|error| refused(error.to_string()))?;
    Ok(model)
}

/// The surfaces of equations as JSON that are times.
fn clocks_of(text: &str) -> Vec<String> {
    let value: serde_json::Value = serde_json::from_str(text).unwrap_or_default();
    let lists = |value: &serde_json::Value| value.as_array().cloned().unwrap_or_default();
    let guards = lists(&value["modes"]).into_iter().flat_map(|mode| lists(&mode["guards"]));
    guards
        .chain(lists(&value["everywhere"]))
        .filter(|guard| guard["role"] == "clock")
        .filter_map(|guard| guard["surface"].as_str().map(str::to_owned))
        .collect()
}

/// The significant digits of a number that a double keeps at least.
const DIGITS: usize = 15;

/// The first number outside of texts and comments that a double does not keep, with its line.
fn longer_than_a_double(text: &str) -> Option<(usize, &str)> {
    text.lines().zip(1..).find_map(|(line, number)| {
        let parts = line
            .split(['"', '\''])
            .step_by(2)
            .map(|part| part.split('#').next().unwrap_or_default());
        let words = parts.flat_map(|part| {
            part.split(|c: char| !(c.is_ascii_alphanumeric() || "._+-".contains(c)))
        });
        let is_number = |word: &&str| {
            word.trim_start_matches(['+', '-'])
                .starts_with(|c: char| c.is_ascii_digit() || c == '.')
        };
        words.filter(is_number).find(|word| digits_of(word) > DIGITS).map(|word| (number, word))
    })
}

/// The significant digits of a decimal.
fn digits_of(word: &str) -> usize {
    let mantissa = word.split(['e', 'E']).next().unwrap_or_default();
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    digits.trim_start_matches('0').trim_end_matches('0').len()
}

/// What is wrong with a text, and in which line.
fn in_line(text: &str, error: &toml::de::Error) -> String {
    let before = error.span().and_then(|span| text.get(..span.start));
    let line = before.map_or(1, |before| before.lines().count().max(1));
    format!("line {line}: {}", error.message().replace('\n', "; "))
}

/// The equations of a file.
fn equations_of(file: &ModelFile) -> Result<Equations, String> {
    let states = texts(&file.states);
    let mut values = Vec::new();
    for (name, value) in &file.parameters {
        values.push((name, decimal(&value.text(), name)?));
    }
    let parameters: Vec<(&str, &str)> =
        values.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
    let mut equations = Equations::new(&states, &parameters);
    for mode in &file.mode {
        let what = format!("the rates of {}", mode.name);
        let rates = in_order(&file.states, &mode.rates, &what, |state| {
            Err(format!("{what}: none of {state}; give {state} = \"0\" if it stays"))
        })?;
        equations = equations.mode_text(&mode.name, &texts(&rates));
        for surface in &mode.surface {
            if file.slides {
                check_sliding(surface)?;
            }
            equations = with_surface(equations, &file.states, surface)?;
        }
        if let Some(rest) = &mode.rests {
            let what = format!("at_rest of {}", mode.name);
            let own = in_order(&file.states, &mode.at_rest, &what, |state| Ok(state.to_owned()))?;
            equations = match mode.at_rest.is_empty() {
                true => equations.rests(rest),
                false => equations.rests_at_text(rest, &texts(&own)),
            };
        } else if !mode.at_rest.is_empty() {
            return Err(format!(
                "the mode {}: at_rest without rests; name the mode behind the limit",
                mode.name
            ));
        }
    }
    Ok(equations)
}

/// A parameter as a decimal. One that is a decimal already stays exact; a formula of numbers, such as "68*pi/180", is rounded to the nearest double.
pub(super) fn decimal(text: &str, name: &str) -> Result<String, String> {
    let plain = text.trim().strip_prefix('+').unwrap_or(text.trim());
    if plain.parse::<f64>().is_ok_and(f64::is_finite) {
        return Ok(plain.to_owned());
    }
    let refused = |error: equations::Error| format!("the parameter {name}: {error}");
    let formula = Names::new(&[], &[]).and_then(|names| Formulas::from_text(names, &[text]));
    let value = formula.and_then(|formula| formula.values(0.0, &[])).map_err(refused)?;
    Ok(value.first().copied().unwrap_or_default().to_string())
}

pub(super) fn texts(all: &[String]) -> Vec<&str> {
    all.iter().map(String::as_str).collect()
}

/// The texts of the states, in their order; `absent` gives those that are not named.
fn in_order(
    states: &[String],
    named: &BTreeMap<String, Number>,
    what: &str,
    absent: impl Fn(&str) -> Result<String, String>,
) -> Result<Vec<String>, String> {
    if let Some(unknown) = named.keys().find(|name| !states.contains(name)) {
        let known = states.join(", ");
        return Err(format!("{what}: {unknown} is no state; the states are {known}"));
    }
    let own = |state: &String| named.get(state).map_or_else(|| absent(state), |own| Ok(own.text()));
    states.iter().map(own).collect()
}

/// Refuses a surface to another mode along which no run can go on, unless it says that runs cross it.
fn check_sliding(surface: &Surface) -> Result<(), String> {
    let crosses = matches!(surface.beyond, Some(Beyond::Crossing));
    if surface.to.is_none() || surface.guard.is_none() || crosses {
        return Ok(());
    }
    let what = match (surface.direction, &surface.only_where) {
        (Direction::Either, _) => "has no direction; give rising or falling",
        (_, Some(_)) => "has a condition",
        _ => return Ok(()),
    };
    let name = &surface.name;
    Err(format!(
        "slides = true: the surface {name} leads to another mode and {what}, or beyond = \"crossing\": then no run slides along it"
    ))
}

fn with_surface(
    equations: Equations,
    states: &[String],
    surface: &Surface,
) -> Result<Equations, String> {
    let Surface { name, guard, direction, first, period, .. } = surface;
    let mut equations = match (guard, first, period) {
        (Some(guard), None, None) => match direction {
            Direction::Rising => equations.rising_text(name, guard),
            Direction::Falling => equations.falling_text(name, guard),
            Direction::Either => equations.either_text(name, guard),
        },
        (None, first, Some(period)) => {
            let first = first.as_ref().unwrap_or(period);
            equations.clock_text(name, &first.text(), &period.text())
        }
        _ => {
            let reason = "give a guard, or a period with the first time, and not both";
            return Err(format!("the surface {name}: {reason}"));
        }
    };
    if let Some(condition) = &surface.only_where {
        equations = equations.only_where_text(condition);
    }
    if !surface.resets.is_empty() {
        let what = format!("the resets of {name}");
        let resets = in_order(states, &surface.resets, &what, |state| Ok(state.to_owned()))?;
        equations = equations.resets_text(&texts(&resets));
    }
    if let Some(mode) = &surface.to {
        equations = equations.to(mode);
    }
    equations = match surface.beyond {
        Some(Beyond::Contact) => equations.contact(),
        Some(Beyond::Crossing) => equations.crossing(),
        None => equations,
    };
    Ok(if surface.stops { equations.stops() } else { equations })
}
