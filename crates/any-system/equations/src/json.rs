//! Formulas as JSON, with exact numbers.
//!
//! ```text
//! {"format": "equations", "version": 1,
//!  "states": ["angle", "speed"], "parameters": [["damping", "0.1"]],
//!  "parts": [["state", 1], ["state", 0], ["sin", 1], …], "outputs": [0, 7]}
//! ```
//!
//! Each part has its name first, then the places of parts before it, or its number as text.

use crate::constant::{Constant, Decimal};
use crate::error::Error;
use crate::formulas::{Formulas, MOST_PARTS};
use crate::function::Function;
use crate::graph::Graph;
use crate::names::Names;
use crate::node::{BINARY, Binary, Node, UNARY, Unary, name_in, named};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// The version of the format. A reader refuses others.
const VERSION: u64 = 1;

/// The longest file, in bytes: a million parts of thirty characters. Its values take half a gigabyte at most.
const LONGEST: usize = 30_000_000;

/// Operators, with their names in files. Functions have the names that they have in text.
const OPERATORS: [(&str, Binary); 5] = [
    ("+", Binary::Sum),
    ("-", Binary::Difference),
    ("*", Binary::Product),
    ("/", Binary::Quotient),
    ("^", Binary::Power),
];

impl Formulas {
    /// The formulas as JSON. The same formulas have the same bytes.
    ///
    /// ```
    /// use equations::{Formulas, Names};
    /// let field = Formulas::from_text(Names::new(&["x"], &[("a", "0.2")])?, &["a*x*(1 - x)"])?;
    /// let again = Formulas::from_json(&field.to_json())?;
    /// assert_eq!(again, field);
    /// assert_eq!(again.values(0.0, &[0.3])?, field.values(0.0, &[0.3])?);
    /// # Ok::<(), equations::Error>(())
    /// ```
    pub fn to_json(&self) -> String {
        let mut file = json!({ "format": "equations", "version": VERSION });
        for part in [self.names.to_value(), self.to_value()] {
            if let (Some(file), Value::Object(part)) = (file.as_object_mut(), part) {
                file.extend(part);
            }
        }
        file.to_string()
    }

    /// The [`content_hash`] of [`to_json`](Self::to_json): equal for the same formulas with the same names and values. Of a
    /// user's [`Function`] it has the name alone.
    pub fn content_hash(&self) -> String {
        content_hash(&self.to_json())
    }

    /// Their parts and outputs as a value of JSON, without the names: for files of several formulas.
    pub fn to_value(&self) -> Value {
        json!({ "parts": self.nodes.iter().map(part).collect::<Vec<_>>(), "outputs": self.outputs })
    }

    /// The formulas of a file. Any bytes are safe: what is no such file is an error with its place.
    ///
    /// # Errors
    /// [`Error::File`]; [`Error::Name`]; [`Error::TooLarge`].
    pub fn from_json(text: &str) -> Result<Formulas, Error> {
        Formulas::from_json_with(text, &[])
    }

    /// The same of a file with calls of these functions, which it has by their names alone.
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json), and for a function that is not given.
    pub fn from_json_with(text: &str, functions: &[Function]) -> Result<Formulas, Error> {
        let file = bounded_value(text)?;
        if file["format"] != "equations" || file["version"] != VERSION {
            let reason = format!("\"format\" must be \"equations\", and \"version\" {VERSION}");
            return Err(wrong("the file", reason));
        }
        Formulas::from_value(Names::from_value(&file)?.with_functions(functions)?, &file)
    }

    /// The formulas of a value that [`to_value`](Self::to_value) made.
    ///
    /// # Errors
    /// As [`from_json`](Self::from_json).
    pub fn from_value(names: Names, file: &Value) -> Result<Formulas, Error> {
        let mut graph = Graph::default();
        let parts = list(file, "parts")?;
        if parts.len() > MOST_PARTS {
            return Err(Error::TooLarge { limit: MOST_PARTS });
        }
        for (at, part) in parts.iter().enumerate() {
            let node =
                node(part, at, &names).map_err(|reason| wrong(&format!("parts[{at}]"), reason))?;
            // Powers with integers are products: no other form has their values below zero.
            let by_integer = match node {
                Node::Binary(Binary::Power, _, exponent) => {
                    graph.short_exponent(exponent).is_some()
                }
                _ => false,
            };
            if by_integer || graph.place(node) != at {
                let reason =
                    format!("it equals an earlier part, or is a power of an integer: {part}");
                return Err(wrong(&format!("parts[{at}]"), reason));
            }
        }
        let outputs = list(file, "outputs")?.iter().enumerate().map(|(at, output)| {
            place(output, parts.len()).map_err(|reason| wrong(&format!("outputs[{at}]"), reason))
        });
        let outputs = outputs.collect::<Result<Vec<_>, Error>>()?;
        Formulas::of_parts(names, graph.into_nodes(), outputs)
    }
}

/// The SHA-256 of the bytes of a file, as 64 hexadecimal digits: a short name of its contents for stores and certificates,
/// which any other program can compute.
///
/// ```
/// let empty = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
/// assert_eq!(equations::content_hash(""), empty);
/// ```
pub fn content_hash(text: &str) -> String {
    Sha256::digest(text).iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A value of JSON, if its memory is bounded: of at most 30 million bytes, with at most two million lists.
///
/// # Errors
/// [`Error::File`]; [`Error::TooLarge`].
pub fn bounded_value(text: &str) -> Result<Value, Error> {
    if text.len() > LONGEST {
        return Err(wrong("the file", format!("it is longer than {LONGEST} bytes")));
    }
    // Parts and parameters are lists. A file of more lists would take memory before they are counted.
    if text.matches('[').count() > 2 * MOST_PARTS {
        return Err(Error::TooLarge { limit: MOST_PARTS });
    }
    serde_json::from_str(text).map_err(|error| wrong("the file", error.to_string()))
}

impl Names {
    /// Names and values as a value of JSON.
    pub fn to_value(&self) -> Value {
        let parameters = self.parameters.iter().zip(&self.values);
        let parameters = parameters.map(|(name, value)| json!([name, written(value)]));
        json!({ "states": self.states, "parameters": parameters.collect::<Vec<_>>() })
    }

    /// The names of a value that [`to_value`](Self::to_value) made.
    ///
    /// # Errors
    /// [`Error::File`]; [`Error::Name`].
    pub fn from_value(file: &Value) -> Result<Names, Error> {
        names(file)
    }
}

fn wrong(place: &str, reason: String) -> Error {
    // A value of a file may be long.
    Error::File { place: place.to_owned(), reason: reason.chars().take(200).collect() }
}

fn list<'a>(file: &'a Value, key: &str) -> Result<&'a Vec<Value>, Error> {
    file[key].as_array().ok_or_else(|| wrong(key, "a list is expected".to_owned()))
}

fn names(file: &Value) -> Result<Names, Error> {
    let mut names = Names::default();
    for (at, name) in list(file, "states")?.iter().enumerate() {
        let refused = || wrong(&format!("states[{at}]"), "a name is expected".to_owned());
        names.states.push(name.as_str().ok_or_else(refused)?.to_owned());
    }
    for (at, parameter) in list(file, "parameters")?.iter().enumerate() {
        let refused = |reason: &str| wrong(&format!("parameters[{at}]"), reason.to_owned());
        let pair = (parameter[0].as_str(), parameter[1].as_str());
        let (Some(name), Some(value)) = pair else {
            return Err(refused("a name and a number as text are expected"));
        };
        names.parameters.push(name.to_owned());
        names.values.push(constant(value).ok_or_else(|| refused("the number is none"))?);
    }
    names.check()?;
    Ok(names)
}

/// A number as text: a decimal, or a double with an f before it.
fn written(constant: &Constant) -> String {
    match constant {
        Constant::Decimal(decimal) => decimal.text().to_owned(),
        Constant::Double(bits) => format!("f{:.16e}", f64::from_bits(*bits)),
        Constant::Pi => "pi".to_owned(),
        Constant::Euler => "e".to_owned(),
    }
}

fn constant(text: &str) -> Option<Constant> {
    match (text, text.strip_prefix('f')) {
        ("pi", _) => Some(Constant::Pi),
        ("e", _) => Some(Constant::Euler),
        (_, Some(double)) => {
            Decimal::new(double).map(|known| Constant::Decimal(known).value().into())
        }
        (_, None) => Decimal::new(text).map(Constant::Decimal),
    }
}

fn part(node: &Node) -> Value {
    match node {
        Node::Time => json!(["time"]),
        Node::State(at) => json!(["state", at]),
        Node::Parameter(at) => json!(["parameter", at]),
        Node::Constant(constant) => json!(["number", written(constant)]),
        // A sign has no name in text.
        Node::Unary(function, a) => json!([name_in(&UNARY, function).unwrap_or("negative"), a]),
        Node::Binary(function, a, b) => {
            let name = name_in(&OPERATORS, function).or_else(|| name_in(&BINARY, function));
            json!([name, a, b])
        }
        Node::Call(function, a) => json!(["call", function.name(), a]),
    }
}

/// A place among the first `count` of something.
fn place(value: &Value, count: usize) -> Result<usize, String> {
    let found = value.as_u64().and_then(|at| usize::try_from(at).ok()).filter(|&at| at < count);
    found.ok_or_else(|| format!("{value} is no place below {count}"))
}

/// The part at a place. Its operands are earlier: there are no cycles.
fn node(part: &Value, at: usize, names: &Names) -> Result<Node, String> {
    let entries = part.as_array().filter(|entries| entries.len() <= 3);
    let name = entries.and_then(|entries| entries.first()?.as_str());
    let (Some(entries), Some(name)) = (entries, name) else {
        return Err("a list with a name first, and at most two places, is expected".to_owned());
    };
    let takes = |count: usize| match entries.len() == count + 1 {
        true => Ok(()),
        false => Err(format!("{name} takes {count} entries behind its name")),
    };
    let operand = |entry: usize| place(&entries[entry], at);
    match name {
        "time" => takes(0).map(|()| Node::Time),
        "state" => takes(1).and_then(|()| place(&entries[1], names.states.len())).map(Node::State),
        "parameter" => {
            takes(1).and_then(|()| place(&entries[1], names.parameters.len())).map(Node::Parameter)
        }
        "number" => {
            takes(1)?;
            let found = entries[1].as_str().and_then(constant);
            found.map(Node::Constant).ok_or_else(|| format!("{} is no number as text", entries[1]))
        }
        "call" => {
            takes(2)?;
            let known = names.functions.iter().find(|known| entries[1] == known.name());
            let unknown =
                || format!("the function {} is needed: give it with the names", entries[1]);
            Ok(Node::Call(known.ok_or_else(unknown)?.clone(), operand(2)?))
        }
        "negative" => takes(1).and_then(|()| Ok(Node::Unary(Unary::Negative, operand(1)?))),
        _ => {
            if let Some(function) = named(&UNARY, name) {
                takes(1)?;
                return Ok(Node::Unary(function, operand(1)?));
            }
            let found = named(&OPERATORS, name).or_else(|| named(&BINARY, name));
            let function = found.ok_or_else(|| format!("there is no part {name:?}"))?;
            takes(2)?;
            Ok(Node::Binary(function, operand(1)?, operand(2)?))
        }
    }
}
