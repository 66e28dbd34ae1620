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

/// The separator of the fields, and the places of the columns from 0.
#[derive(Debug, Clone, Copy)]
struct Found {
    separator: char,
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
        // The separator that the line has most of; a comma if it has none.
        let count = |separator: &char| line.matches(*separator).count();
        let separator = ['\t', ';', ','].into_iter().max_by_key(count).unwrap_or(',');
        let names = fields(line, separator)?;
        let place = |wanted: &str| {
            names.iter().position(|name| name == wanted).ok_or_else(|| {
                let shown: Vec<_> = names.iter().map(|name| shortened(name)).collect();
                let wanted = shortened(wanted);
                format!("there is no column '{wanted}'; give one of: {}", shown.join(", "))
            })
        };
        let speed = place(&self.speed)?;
        let mass_ratio = self.mass_ratio.as_ref().err().map(|name| place(name)).transpose()?;
        self.found.get_or_init(|| Found { separator, speed, mass_ratio });
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
                Ok(Start { mass_ratio: *mass_ratio, speed: values::speed(line)? })
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
        let field = |at: usize| {
            fields.get(at).map(String::as_str).ok_or_else(|| {
                format!("it has {} fields, and the column is number {}", fields.len(), at + 1)
            })
        };
        let speed = values::speed(field(found.speed)?).map_err(|why| named(&self.speed, why))?;
        let mass_ratio = match (&self.mass_ratio, found.mass_ratio) {
            (Err(name), Some(at)) => {
                values::mass_ratio(field(at)?).map_err(|why| named(name, why))?
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

/// The fields of a line of CSV, without the quotes and the spaces around them.
fn fields(line: &str, separator: char) -> Result<Vec<String>, String> {
    let mut fields = vec![String::new()];
    let (mut quoted, mut characters) = (false, line.chars().peekable());
    while let Some(character) = characters.next() {
        let field = fields.last_mut();
        match (character, field) {
            // Two quotes within quotes are one.
            ('"', Some(field)) if quoted && characters.next_if_eq(&'"').is_some() => {
                field.push('"');
            }
            ('"', _) => quoted = !quoted,
            (own, _) if own == separator && !quoted => fields.push(String::new()),
            (own, Some(field)) => field.push(own),
            (_, None) => {}
        }
    }
    if quoted {
        return Err("a quote in it is not closed; a field must not have a line break".into());
    }
    Ok(fields.into_iter().map(|field| field.trim().to_owned()).collect())
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
        assert!(form.read("a;7").unwrap_err().contains("2 fields"));
        assert!(form.read("a;seven;0.2").unwrap_err().starts_with("alpha: "));
        assert!(form.read("\"a;7;0.2").unwrap_err().contains("not closed"));
        let missing = columns("run,speed,M").unwrap_err();
        assert_eq!(missing, "there is no column 'alpha'; give one of: run, speed, M");
        let one = LineForm::Columns(Columns::new("alpha".into(), Ok(MassRatio::ONE)));
        one.read_names("alpha").unwrap();
        assert_eq!(one.read("7"), start(1.0, 7.0));
    }
}
