//! What a line of the input is: a speed, a mass ratio and a speed, or a row of CSV.

use crate::options::values;
use crate::refusal::shortened;
use passive_hopper::MassRatio;
use std::sync::OnceLock;

/// Where a hop or an orbit starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Start {
    pub(crate) mass_ratio: MassRatio,
    /// The lift-off speed α.
    pub(crate) speed: f64,
}

/// How a line is read.
#[derive(Debug)]
pub(crate) enum LineForm {
    /// A speed, at this mass ratio.
    Speed(MassRatio),
    /// A mass ratio and a speed, with a space, a tab, a comma or a semicolon between them.
    Pair,
    /// Columns of CSV, found by the line of names.
    Columns(Columns),
}

/// Columns of CSV: one with speeds, and one with mass ratios unless one is given for all.
#[derive(Debug)]
pub(crate) struct Columns {
    speed: String,
    mass_ratio: Result<MassRatio, String>,
    found: OnceLock<Found>,
}

/// The most names of columns in a message.
const LISTED: usize = 20;

/// The separator of the fields, and the places of the columns from 0.
#[derive(Debug, Clone, Copy)]
struct Found {
    separator: char,
    /// The number of names, which is that of the fields of each line.
    fields: usize,
    speed: usize,
    mass_ratio: Option<usize>,
}

impl Columns {
    /// The column of the speeds, at this mass ratio or with that of the column of this name.
    pub(crate) fn new(speed: String, mass_ratio: Result<MassRatio, String>) -> Self {
        Columns { speed, mass_ratio, found: OnceLock::new() }
    }

    /// Finds the columns in the line of names.
    fn find(&self, line: &str) -> Result<(), String> {
        // The separator that gives the most names; a comma if none does.
        let count = |separator: &char| fields(line, *separator).map_or(0, |names| names.len());
        let separator = ['\t', ';', ','].into_iter().max_by_key(count).unwrap_or(',');
        let names = fields(line, separator)?;
        let place = |wanted: &str| {
            let mut places = (0..names.len()).filter(|&at| names[at] == wanted);
            match (places.next(), places.next()) {
                (Some(place), None) => Ok(place),
                (Some(_), Some(_)) => Err(format!(
                    "two columns have the name '{}'; give each its own",
                    shortened(wanted)
                )),
                (None, _) => {
                    let shown: Vec<_> =
                        names.iter().take(LISTED).map(|name| shortened(name)).collect();
                    let more = if names.len() > LISTED { ", …" } else { "" };
                    let (wanted, shown) = (shortened(wanted), shown.join(", "));
                    Err(format!("there is no column '{wanted}'; give one of: {shown}{more}"))
                }
            }
        };
        let speed = place(&self.speed)?;
        let mass_ratio = self.mass_ratio.as_ref().err().map(|name| place(name)).transpose()?;
        if mass_ratio == Some(speed) {
            return Err("the columns of M and α are the same; give two names".into());
        }
        let fields = names.len();
        self.found.get_or_init(|| Found { separator, fields, speed, mass_ratio });
        Ok(())
    }
}

impl LineForm {
    /// The mass ratio of all lines, if they have one.
    pub(crate) fn mass_ratio(&self) -> Option<MassRatio> {
        match self {
            LineForm::Speed(mass_ratio) => Some(*mass_ratio),
            LineForm::Pair => None,
            LineForm::Columns(columns) => columns.mass_ratio.as_ref().ok().copied(),
        }
    }

    /// Whether the next line has the names of the columns.
    pub(crate) fn wants_names(&self) -> bool {
        matches!(self, LineForm::Columns(columns) if columns.found.get().is_none())
    }

    /// Reads the line of names.
    ///
    /// # Errors
    /// The reason why the columns are not in it, with the names that are.
    pub(crate) fn read_names(&self, line: &str) -> Result<(), String> {
        match self {
            LineForm::Columns(columns) => columns.find(line),
            LineForm::Speed(_) | LineForm::Pair => Ok(()),
        }
    }

    /// Reads a line.
    ///
    /// # Errors
    /// What is wrong, and the remedy.
    pub(crate) fn read(&self, line: &str) -> Result<Start, String> {
        match self {
            LineForm::Speed(mass_ratio) => {
                Ok(Start { mass_ratio: *mass_ratio, speed: values::speed(line.trim_ascii())? })
            }
            LineForm::Pair => {
                let is_between = |c: char| c.is_whitespace() || c == ',' || c == ';';
                let words: Vec<&str> = line.split(is_between).filter(|w| !w.is_empty()).collect();
                let [mass_ratio, speed] = words[..] else {
                    return Err(format!(
                        "it has {} numbers; give two, M and α, such as: 0.2 7",
                        words.len()
                    ));
                };
                let mass_ratio = values::mass_ratio(mass_ratio).map_err(|why| named("M", why))?;
                let speed = values::speed(speed).map_err(|why| named("α", why))?;
                Ok(Start { mass_ratio, speed })
            }
            LineForm::Columns(columns) => columns.read(line),
        }
    }
}

impl Columns {
    fn read(&self, line: &str) -> Result<Start, String> {
        let Some(found) = self.found.get() else {
            return Err("the line with the names of the columns is missing".into());
        };
        let fields = fields(line, found.separator)?;
        if fields.len() != found.fields {
            let (own, names) = (fields.len(), found.fields);
            return Err(format!("it has {own} fields, and there are {names} names of columns"));
        }
        let speed = values::speed(&fields[found.speed]).map_err(|why| named(&self.speed, why))?;
        let mass_ratio = match (&self.mass_ratio, found.mass_ratio) {
            (Err(name), Some(at)) => {
                values::mass_ratio(&fields[at]).map_err(|why| named(name, why))?
            }
            (Ok(given), _) => *given,
            (Err(_), None) => return Err("the column of the mass ratios is not known".into()),
        };
        Ok(Start { mass_ratio, speed })
    }
}

/// A reason with the column that it is about.
fn named(column: &str, reason: String) -> String {
    format!("{}: {reason}", shortened(column))
}

/// A field that goes on in the next line: what follows it cannot be read either, whether wrong lines are passed over or not.
pub(crate) const UNCLOSED: &str = "a quote in it is not closed; a field must not have a line break";

/// The fields of a line of CSV, without the quotes and the spaces around them.
fn fields(line: &str, separator: char) -> Result<Vec<String>, String> {
    let mut fields = Vec::new();
    let mut rest = line;
    loop {
        let start = rest.trim_start_matches(' ');
        let (field, after) = match start.strip_prefix('"') {
            Some(quoted) => quoted_field(quoted)?,
            None => {
                let end = start.find(separator).unwrap_or(start.len());
                let (field, after) = start.split_at(end);
                if field.contains('"') {
                    return Err("a quote is within a field; quote the whole field".into());
                }
                (field.to_owned(), after)
            }
        };
        fields.push(field.trim().to_owned());
        let after = after.trim_start_matches(' ');
        match after.strip_prefix(separator) {
            Some(others) => rest = others,
            None if after.is_empty() => return Ok(fields),
            None => return Err("something is behind a closed quote; quote the whole field".into()),
        }
    }
}

/// A field up to its closing quote, and what is behind it. Two quotes within are one.
fn quoted_field(text: &str) -> Result<(String, &str), String> {
    let (mut field, mut rest) = (String::new(), text);
    loop {
        let (part, after) = rest.split_once('"').ok_or(UNCLOSED)?;
        field += part;
        match after.strip_prefix('"') {
            Some(others) => {
                field.push('"');
                rest = others;
            }
            None => return Ok((field, after)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn start(mass_ratio: f64, speed: f64) -> Result<Start, String> {
        Ok(Start { mass_ratio: MassRatio::new(mass_ratio).unwrap(), speed })
    }

    #[test]
    fn pairs_may_have_any_sign_between_them() {
        for line in ["0.2 7", "0.2,7", "0.2\t 7", "0.2; 7"] {
            assert_eq!(LineForm::Pair.read(line), start(0.2, 7.0), "{line}");
        }
        for (line, why) in [("7", "1 numbers"), ("0 7", "M: "), ("0.2 -7", "α: ")] {
            assert!(LineForm::Pair.read(line).unwrap_err().contains(why), "{line}");
        }
    }

    #[test]
    fn columns_are_found_by_their_names() {
        let columns = |names: &str| {
            let form = LineForm::Columns(Columns::new("alpha".into(), Err("M".into())));
            assert!(form.wants_names());
            form.read_names(names).map(|()| form)
        };
        let form = columns("run;\"alpha\"; M").unwrap();
        assert!(!form.wants_names());
        assert_eq!(form.read("\"a;\"\"b\"; 7 ;0.2"), start(0.2, 7.0));
        assert_eq!(form.read("a; 7;\"0.2\" "), start(0.2, 7.0));
        for (line, why) in [
            ("a;7", "it has 2 fields, and there are 3"),
            ("a;7;0.2;1", "it has 4 fields"),
            ("a;7\"8\";0.2", "within a field"),
            ("\"a\"b;7;0.2", "behind a closed quote"),
            (";7", "2 fields"),
        ] {
            assert!(form.read(line).unwrap_err().contains(why), "{line}");
        }
        // An empty field at the beginning stays a field.
        let tabs = LineForm::Columns(Columns::new("alpha".into(), Ok(MassRatio::ONE)));
        tabs.read_names("\tx\talpha").unwrap();
        assert_eq!(tabs.read("0\t5\t7"), start(1.0, 7.0));
        assert!(tabs.read("\t5\t").unwrap_err().starts_with("alpha: "));
        assert!(columns("M,alpha,alpha").unwrap_err().contains("two columns"));
        assert!(columns("\"a;b;c;d\",alpha,M").is_ok());
        assert!(form.read("a;seven;0.2").unwrap_err().starts_with("alpha: "));
        assert!(form.read("\"a;7;0.2").unwrap_err().contains("not closed"));
        let missing = columns("run,speed,M").unwrap_err();
        assert_eq!(missing, "there is no column 'alpha'; give one of: run, speed, M");
        let one = LineForm::Columns(Columns::new("alpha".into(), Ok(MassRatio::ONE)));
        one.read_names("alpha").unwrap();
        assert_eq!(one.read("7"), start(1.0, 7.0));
    }
}
