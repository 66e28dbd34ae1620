//! Commands that take speeds as arguments, and are filters without any.

use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::options::line_form::{Columns, LineForm, Start};
use crate::options::{lines, values};
use crate::output::{Cell, Column, Form, TableKind};
use crate::refusal::one_line;
use crate::streams::Streams;
use passive_hopper::MassRatio;
use std::sync::atomic::{AtomicU64, Ordering};

/// Where the mass ratio and the speeds come from, beside the arguments.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct InputOptions {
    /// The mass ratio M = m₂/m₁, lower mass over upper mass
    #[arg(short = 'M', long, value_name = "M", value_parser = values::mass_ratio, allow_hyphen_values = true)]
    #[arg(required_unless_present_any = ["pairs", "columns"])]
    mass_ratio: Option<MassRatio>,
    /// Read M and α from each line of the input: two numbers, with a space, a tab or a comma between them
    #[arg(long, help_heading = "Input", conflicts_with_all = ["mass_ratio", "columns"])]
    pairs: bool,
    /// Read CSV with a line of names: α from the column of this name; with two names, M and α
    #[arg(long, value_name = "NAMES", help_heading = "Input", value_delimiter = ',', value_parser = |name: &str| Ok::<_, String>(name.trim().to_owned()))]
    columns: Vec<String>,
    /// Pass over lines of the input that are no speed; a note says how many, and the first one
    #[arg(long, help_heading = "Input")]
    skip_invalid: bool,
    /// Exit with status 1 if something is undecided
    #[arg(long)]
    strict: bool,
}

/// What the help says of the input.
pub(crate) const LIMITS: &str = "Of the input, empty lines, lines that begin with # and a byte order mark are passed \
                                 over. A line that does not have what is asked for ends the call with status 2 and the \
                                 number of the line; the rows of the lines before it have been written. With \
                                 --skip-invalid it is passed over, unless it is longer than 1 MiB or a quote in it is not \
                                 closed. A filter prints one table: the first, or that of --table. Where the lines have M, \
                                 the column mass_ratio is before the others; the orbits of many speeds have the column \
                                 start.";

/// The column before those of a table if the mass ratio comes from the input.
pub(crate) const MASS_RATIO: Column = Column::new("mass_ratio", "", "M = m₂/m₁");

/// The starts of a call.
#[derive(Debug)]
pub(crate) enum Starts {
    /// Those of the arguments.
    Given(MassRatio, Vec<f64>),
    /// Those of the input.
    Input(LineForm),
}

impl InputOptions {
    /// The starts of a call with these speeds among its arguments.
    ///
    /// # Errors
    /// [`Error::Misuse`] if arguments and input are asked for, or no mass ratio.
    pub(crate) fn starts(&self, speeds: &[values::SpeedOrInput]) -> Result<Starts, Error> {
        let input = values::from_input("SPEED", speeds)?;
        let from_lines = match (&self.columns[..], self.mass_ratio, self.pairs) {
            ([], _, true) => Some(LineForm::Pair),
            ([], ..) => None,
            ([speed], Some(ratio), _) => {
                Some(LineForm::Columns(Columns::new(speed.clone(), Ok(ratio))))
            }
            ([mass_ratio, speed], None, _) => {
                Some(LineForm::Columns(Columns::new(speed.clone(), Err(mass_ratio.clone()))))
            }
            (names, given, _) => {
                let reason = match given {
                    Some(_) => "with -M the input has one column, α; give its name",
                    None => "give two names, of M and α, as in M,alpha; or one, with -M",
                };
                return Err(Error::misuse("--columns", names.join(","), reason));
            }
        };
        match (from_lines, self.mass_ratio, input) {
            (Some(form), _, true) => Ok(Starts::Input(form)),
            (Some(_), _, false) => Err(Error::Misuse(
                "SPEED: speeds are given, and are to be read with --pairs or --columns; leave one out".into(),
            )),
            (None, Some(ratio), true) => Ok(Starts::Input(LineForm::Speed(ratio))),
            (None, Some(ratio), false) => Ok(Starts::Given(ratio, values::speeds(speeds).collect())),
            (None, None, _) => Err(Error::Misuse("-M: the mass ratio is missing; give it".into())),
        }
    }

    /// Whether something undecided is an error.
    pub(crate) fn is_strict(&self) -> bool {
        self.strict
    }

    /// An error if something is undecided, and that is one.
    pub(crate) fn judged(&self, undecided: u64) -> Result<(), Error> {
        match self.strict && undecided > 0 {
            true => Err(Error::Undecided { count: undecided }),
            false => Ok(()),
        }
    }
}

/// A table whose rows come from the lines of the input.
pub(crate) struct Filter<'a> {
    pub(crate) input: &'a InputOptions,
    pub(crate) output: &'a OutputOptions,
    pub(crate) form: Form,
    pub(crate) lines: &'a LineForm,
    /// The table without and with the column [`MASS_RATIO`].
    pub(crate) kinds: [&'static TableKind; 2],
    /// Widths of the columns of the first one in plain text.
    pub(crate) widths: &'a [usize],
    /// The most bytes of lines that are computed together, if they are not one line: 1 for long rows.
    pub(crate) largest_part: usize,
}

/// The width of a number in plain text: most have 18 characters.
pub(crate) const NUMBER: usize = 18;

/// The rows of some starts, in their order.
pub(crate) struct FilteredRows<'a> {
    add: &'a mut dyn FnMut(&Start, &[Cell]),
    undecided: u64,
}

impl FilteredRows<'_> {
    /// Adds a row.
    pub(crate) fn push(&mut self, start: &Start, row: &[Cell]) {
        (self.add)(start, row);
    }

    /// Counts something undecided.
    pub(crate) fn count_undecided(&mut self) {
        self.undecided += 1;
    }
}

impl Filter<'_> {
    /// Writes the rows that `rows` makes of the starts.
    ///
    /// # Errors
    /// As [`lines::filter`]; those of `rows`; [`Error::Undecided`] if that is one.
    pub(crate) fn run(
        &self,
        streams: &mut Streams<'_>,
        rows: impl Fn(&[Start], &mut FilteredRows<'_>) -> Result<(), Error> + Sync,
    ) -> Result<(), Error> {
        let shows_mass_ratio = self.lines.mass_ratio().is_none();
        let [plain, with_mass_ratio] = self.kinds;
        let (kind, widths) = match shows_mass_ratio {
            false => (plain, self.widths.to_vec()),
            true => (with_mass_ratio, [&[NUMBER], self.widths].concat()),
        };
        let (table, head) = self.form.rows(kind, &widths);
        let undecided = AtomicU64::new(0);
        let part = |starts: &[Start], first: bool| {
            let mut table = table.continued(!first);
            // A row of CSV has about 64 bytes.
            let mut text = String::with_capacity(64 * starts.len());
            let mut add = |start: &Start, row: &[Cell]| match shows_mass_ratio {
                false => table.append(row, &mut text),
                true => {
                    table.append(&[&[start.mass_ratio.value().into()], row].concat(), &mut text)
                }
            };
            let mut own = FilteredRows { add: &mut add, undecided: 0 };
            rows(starts, &mut own)?;
            undecided.fetch_add(own.undecided, Ordering::Relaxed);
            Ok(text)
        };
        let own = (head.as_str(), self.largest_part);
        let read = lines::filter(streams, self.input.skip_invalid, self.lines, own, part);
        if let Ok(_) | Err(Error::Input { .. }) = &read {
            // What was written before a wrong line is whole.
            streams.output.write_all(table.end().as_bytes()).map_err(Error::output)?;
        }
        let skipped = read?;
        if let Some((line, text, reason)) = skipped.first {
            let count = skipped.count;
            let lines = if count == 1 { "line was" } else { "lines were" };
            let note = format!(
                "{count} {lines} passed over; the first is line {line}, '{text}': {reason}"
            );
            self.output.note(streams, one_line(&note));
        }
        self.input.judged(undecided.into_inner())
    }
}

/// Runs of starts with the same mass ratio.
pub(crate) fn by_mass_ratio(starts: &[Start]) -> impl Iterator<Item = &[Start]> {
    starts.chunk_by(|one, other| one.mass_ratio == other.mass_ratio)
}
