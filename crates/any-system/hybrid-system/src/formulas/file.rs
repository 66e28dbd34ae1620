//! Equations as JSON.
//!
//! ```text
//! {"format": "hybrid equations", "version": 1, "states": ["room"], "parameters": [["outside", "10"], …],
//!  "everywhere": [], "modes": [{"name": "on", "field": {"parts": …, "outputs": …},
//!   "guards": [{"surface": "warm", "direction": "rising", "role": "switch", "touch": "error",
//!               "function": {…}, "jump": {"mode": "off"}}], …}]}
//! ```

use super::equations::{Equations, GuardEquations, Jump, ModeEquations};
use super::label::Label;
use crate::error::Error;
use crate::guard::{Direction, Guard, Role, Touch};
use equations::{Formulas, Function, Names};
use serde_json::{Map, Value, json};

const FORMAT: &str = "hybrid equations";

/// The version of the format. A reader refuses others.
const VERSION: u64 = 1;

const DIRECTIONS: [(&str, Direction); 3] =
    [("rising", Direction::Rising), ("falling", Direction::Falling), ("either", Direction::Either)];
const ROLES: [(&str, Role); 5] = [
    ("switch", Role::Switch),
    ("contact", Role::Contact),
    ("crossing", Role::Crossing),
    ("undone", Role::Undone),
    ("clock", Role::Clock),
];
const TOUCHES: [(&str, Touch); 3] =
    [("error", Touch::Error), ("event", Touch::Event), ("ignore", Touch::Ignore)];

/// The entries of a guard.
const OF_GUARD: [&str; 8] =
    ["surface", "direction", "role", "touch", "function", "times", "condition", "jump"];

/// The times of a clock, if they are not a first one and a period.
const LISTED: &str = "listed";

impl Equations {
    /// The equations as JSON, with exact numbers. The same equations have the same bytes.
    ///
    /// ```
    /// use hybrid_system::{Equations, State};
    /// let ball = Equations::new(&["height", "speed"], &[("restitution", "0.8")])
    ///     .mode("flight", |_, x, _| [x[1], x[0].number(-1.0)])
    ///     .falling("floor", |_, x, _| x[0])
    ///     .resets(|_, x, p| [x[0], -p["restitution"] * x[1]]);
    /// let again = Equations::from_json(&ball.to_json()?)?;
    /// assert_eq!(again, ball);
    /// let landing = |ball: &Equations| {
    ///     let ball = ball.model::<State<2>>()?;
    ///     let arc = ball.start("flight", [1.0, 0.0], 9.0)?.next().expect("an arc")?;
    ///     Ok::<_, hybrid_system::Error>(arc.event().expect("a landing").time)
    /// };
    /// assert_eq!(landing(&again)?, landing(&ball)?);
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`check`](Self::check): wrong equations are not written.
    pub fn to_json(&self) -> Result<String, Error> {
        Ok(self.to_value()?.to_string())
    }

    /// The same as a value of JSON: for files with more than equations.
    pub(super) fn to_value(&self) -> Result<Value, Error> {
        self.check()?;
        let mut file = json!({
            "format": FORMAT,
            "version": VERSION,
            "everywhere": self.everywhere.iter().map(GuardEquations::to_value).collect::<Vec<_>>(),
            "modes": self.modes.iter().map(ModeEquations::to_value).collect::<Vec<_>>(),
        });
        if let (Some(file), Value::Object(names)) = (file.as_object_mut(), self.names.to_value()) {
            file.extend(names);
            if self.backward {
                file.insert("backward".into(), true.into());
            }
        }
        Ok(file)
    }

    /// The SHA-256 of [`to_json`](Self::to_json), as 64 hexadecimal digits: a short name of the model for stores and
    /// certificates. Of a user's [`Function`] it has the name alone.
    ///
    /// # Errors
    /// As [`to_json`](Self::to_json).
    pub fn content_hash(&self) -> Result<String, Error> {
        Ok(equations::content_hash(&self.to_json()?))
    }

    /// The equations of a file. Any bytes are safe: what is no such file is an error with its place.
    ///
    /// # Errors
    /// [`Error::Formula`], [`Error::BadEquations`].
    pub fn from_json(text: &str) -> Result<Equations, Error> {
        Equations::from_json_with(text, &[])
    }

    /// The same of a file with calls of these functions, which it has by their names alone.
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json), and for a function that is not given.
    pub fn from_json_with(text: &str, functions: &[Function]) -> Result<Equations, Error> {
        Equations::from_value(&equations::bounded_value(text)?, functions)
    }

    /// The equations of a value that [`to_value`](Self::to_value) made.
    pub(super) fn from_value(file: &Value, functions: &[Function]) -> Result<Equations, Error> {
        if file["format"] != FORMAT || file["version"] != VERSION {
            return bad("format", "it is no file of hybrid equations, or one of another version");
        }
        let names = Names::from_value(file)?.with_functions(functions)?;
        let mut equations = Equations::of_names(names.clone());
        equations.backward = match &file["backward"] {
            Value::Null => false,
            Value::Bool(backward) => *backward,
            _ => return bad("backward", "true or false is expected"),
        };
        equations.everywhere = guards(&file["everywhere"], &names)?;
        for mode in list(&file["modes"], "modes")? {
            let name = label(mode, "name")?;
            let field = formulas(&mode["field"], &names, &format!("the field of mode {name}"))?;
            let guards = guards(&mode["guards"], &names)?;
            let after_limit =
                jump(&mode["after_limit"], &names, &format!("the limit of mode {name}"))?;
            equations.modes.push(ModeEquations { name, field, guards, after_limit });
        }
        equations.check()?;
        Ok(equations)
    }
}

fn bad<T>(what: &str, reason: &'static str) -> Result<T, Error> {
    // A value of a file may be long.
    Err(Error::BadEquations { what: what.chars().take(60).collect(), reason })
}

fn list<'v>(value: &'v Value, what: &str) -> Result<&'v Vec<Value>, Error> {
    value.as_array().map_or_else(|| bad(what, "a list is expected"), Ok)
}

fn label(value: &Value, key: &str) -> Result<Label, Error> {
    value[key].as_str().map_or_else(|| bad(key, "a name is expected"), Label::new)
}

fn guards(value: &Value, names: &Names) -> Result<Vec<GuardEquations>, Error> {
    let guard = |value| {
        let guard = Guard {
            surface: label(value, "surface")?,
            direction: word(value, "direction", &DIRECTIONS)?,
            role: word(value, "role", &ROLES)?,
            touch: word(value, "touch", &TOUCHES)?,
        };
        let place = format!("guard {}", guard.surface);
        // What this version does not know may change what the guard means.
        if value
            .as_object()
            .is_some_and(|entries| entries.keys().any(|key| !OF_GUARD.contains(&&**key)))
        {
            return bad(&place, "it has an entry that this version does not know");
        }
        let function = formulas(&value["function"], names, &place)?;
        let condition = value.get("condition");
        let condition = condition
            .map(|condition| formulas(condition, names, &format!("the condition of {place}")));
        Ok(GuardEquations {
            guard,
            function,
            listed: match &value["times"] {
                Value::Null => false,
                Value::String(word) if word == LISTED => true,
                _ => return bad(&place, "its times are listed, or a first one and a period"),
            },
            condition: condition.transpose()?,
            jump: jump(&value["jump"], names, &place)?,
        })
    };
    list(value, "guards")?.iter().map(guard).collect()
}

/// The formulas of a part of the equations, which an error names.
fn formulas(value: &Value, names: &Names, part: &str) -> Result<Formulas, Error> {
    let read = Formulas::from_value(names.clone(), value);
    let named = read.map_err(|error| match error {
        equations::Error::File { place, reason } => {
            equations::Error::File { place: format!("{part}, {place}"), reason }
        }
        other => other,
    });
    Ok(named?)
}

fn jump(value: &Value, names: &Names, part: &str) -> Result<Option<Jump>, Error> {
    let Value::Object(entries) = value else {
        return if value.is_null() {
            Ok(None)
        } else {
            bad("jump", "an object or null is expected")
        };
    };
    let mode = entries.contains_key("mode").then(|| label(value, "mode")).transpose()?;
    let state = |key: &str, what: &str| {
        let state = entries.get(key);
        state.map(|state| formulas(state, names, &format!("{what} {part}"))).transpose()
    };
    let (state, inverse) =
        (state("state", "the state after")?, state("inverse", "the inverse of")?);
    Ok(Some(Jump { mode, state, inverse }))
}

/// The entry of a table whose name stands under a key.
fn word<T: Copy>(value: &Value, key: &str, table: &[(&str, T)]) -> Result<T, Error> {
    let found = value[key].as_str().and_then(|word| table.iter().find(|(name, _)| *name == word));
    found.map_or_else(|| bad(key, "none of the words that can stand here"), |(_, entry)| Ok(*entry))
}

/// The name of an entry of a table; null for one that is not in it.
fn name<T: PartialEq>(entry: &T, table: &[(&str, T)]) -> Value {
    table.iter().find(|(_, known)| known == entry).map_or(Value::Null, |(name, _)| json!(name))
}

impl ModeEquations {
    fn to_value(&self) -> Value {
        json!({
            "name": self.name.as_str(),
            "field": self.field.to_value(),
            "guards": self.guards.iter().map(GuardEquations::to_value).collect::<Vec<_>>(),
            "after_limit": self.after_limit.as_ref().map(Jump::to_value),
        })
    }
}

impl GuardEquations {
    fn to_value(&self) -> Value {
        let mut guard = json!({
            "surface": self.guard.surface.as_str(),
            "direction": name(&self.guard.direction, &DIRECTIONS),
            "role": name(&self.guard.role, &ROLES),
            "touch": name(&self.guard.touch, &TOUCHES),
            "function": self.function.to_value(),
            "jump": self.jump.as_ref().map(Jump::to_value),
        });
        if self.listed {
            guard["times"] = json!(LISTED);
        }
        if let Some(condition) = &self.condition {
            guard["condition"] = condition.to_value();
        }
        guard
    }
}

impl Jump {
    fn to_value(&self) -> Value {
        let mode = self.mode.map(|mode| ("mode".to_owned(), json!(mode.as_str())));
        let formulas = [("state", &self.state), ("inverse", &self.inverse)];
        let formulas = formulas.into_iter().filter_map(|(key, formulas)| {
            formulas.as_ref().map(|formulas| (key.to_owned(), formulas.to_value()))
        });
        Value::Object(mode.into_iter().chain(formulas).collect::<Map<_, _>>())
    }
}
