//! A table: named columns with units, and rows of cells.

use crate::output::number::{append_bound, append_number};
use passive_hopper::Enclosed;
use std::borrow::Cow;
use std::fmt::Write;

/// What a table is about. Its text is part of the help of its command.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct TableKind {
    /// Its name, for --table and in JSON.
    pub(crate) name: &'static str,
    /// What a row is.
    pub(crate) about: &'static str,
    /// Whether it is too long for a terminal. Plain text then has it only with --table.
    pub(crate) long: bool,
    /// Its columns.
    pub(crate) columns: &'static [Column],
}

/// A column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Column {
    /// Its name, the same in all forms.
    pub(crate) name: &'static str,
    /// The unit, empty for a plain number or a text.
    pub(crate) unit: &'static str,
    /// Its meaning.
    pub(crate) meaning: &'static str,
    /// Where the error of its numbers is.
    pub(crate) accuracy: Accuracy,
}

/// Where the error of the numbers of a column is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Accuracy {
    /// They are given, or counts.
    Exact,
    /// Each is a bound itself: what is said of it holds for this number.
    Bound,
    /// Each is a bound on an error.
    Error,
    /// In the column NAME_error, after all others.
    Measured,
    /// In the column of this name.
    In(&'static str),
}

impl Column {
    /// A column of texts, counts, or numbers that were given.
    pub(crate) const fn new(name: &'static str, unit: &'static str, meaning: &'static str) -> Self {
        Column { name, unit, meaning, accuracy: Accuracy::Exact }
    }

    /// The same for computed numbers, whose errors are in a column of their own after all others.
    pub(crate) const fn measured(self) -> Self {
        Column { accuracy: Accuracy::Measured, ..self }
    }

    /// The same for computed numbers, whose errors are in another column of the table.
    pub(crate) const fn with_error(self, name: &'static str) -> Self {
        Column { accuracy: Accuracy::In(name), ..self }
    }

    /// The same for numbers that are bounds themselves.
    pub(crate) const fn bound(self) -> Self {
        Column { accuracy: Accuracy::Bound, ..self }
    }

    /// The same for bounds on errors.
    pub(crate) const fn error(self) -> Self {
        Column { accuracy: Accuracy::Error, ..self }
    }
}

/// Columns with one more before them: M is N + 1.
pub(crate) const fn after<const N: usize, const M: usize>(
    first: Column,
    others: [Column; N],
) -> [Column; M] {
    let (mut all, mut at) = ([first; M], 0);
    while at < N && at + 1 < M {
        all[at + 1] = others[at];
        at += 1;
    }
    all
}

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell {
    Number(f64),
    /// A computed number, with a bound on its error; infinite if none is known.
    Measured(f64, f64),
    /// A bound on an error.
    Error(f64),
    Whole(u64),
    Text(Cow<'static, str>),
    Truth(bool),
    /// There is no such thing, such as the next speed of a grounded hopper: "–", an empty field, or null.
    Missing,
}

impl Cell {
    /// A computed number; missing if it is not finite.
    pub(crate) fn measured(value: f64, error: f64) -> Self {
        if value.is_finite() { Cell::Measured(value, error) } else { Cell::Missing }
    }

    /// A computed number, if there is one, and what is known of its error.
    pub(crate) fn of(value: impl Into<Option<f64>>, known: Option<Enclosed>) -> Self {
        let Some(value) = value.into() else { return Cell::Missing };
        Cell::measured(value, known.map_or(f64::INFINITY, |known| known.error_of(value)))
    }

    /// The same cell, if of its error no more than this bound was known.
    pub(crate) fn or_bound(self, bound: Option<f64>) -> Self {
        match (self, bound) {
            (Cell::Measured(value, error), Some(bound)) => Cell::Measured(value, error.min(bound)),
            (cell, _) => cell,
        }
    }

    /// The bound on the error of this cell; missing if none is known.
    pub(crate) fn error(&self) -> Cell {
        match self {
            Cell::Measured(_, error) if error.is_finite() => Cell::Error(*error),
            _ => Cell::Missing,
        }
    }

    /// Appends a number or a whole number. The other cells look different in every form, and append nothing here.
    pub(crate) fn append_number(&self, text: &mut String) {
        match self {
            Cell::Number(value) | Cell::Measured(value, _) => append_number(*value, text),
            Cell::Error(bound) => append_bound(*bound, text),
            // Writing to a string does not fail.
            Cell::Whole(value) => drop(write!(text, "{value}")),
            Cell::Text(_) | Cell::Truth(_) | Cell::Missing => {}
        }
    }
}

/// A table with rows.
#[derive(Debug, Clone)]
pub(crate) struct Table {
    pub(crate) kind: &'static TableKind,
    pub(crate) rows: Vec<Vec<Cell>>,
}

impl Table {
    /// A table without rows.
    pub(crate) fn new(kind: &'static TableKind) -> Self {
        Table { kind, rows: Vec::new() }
    }

    /// The errors of a row that stand in columns of their own.
    pub(crate) fn errors<'a>(
        kind: &'a TableKind,
        row: &'a [Cell],
    ) -> impl Iterator<Item = (&'static str, Cell)> {
        let measured = kind
            .columns
            .iter()
            .zip(row)
            .filter(|(column, _)| column.accuracy == Accuracy::Measured);
        measured.map(|(column, cell)| (column.name, cell.error()))
    }

    /// Adds a row, with as many cells as there are columns.
    pub(crate) fn push<const N: usize>(&mut self, cells: [Cell; N]) {
        self.rows.push(cells.into());
    }
}

impl From<f64> for Cell {
    /// A number that is not finite is missing: no table has one on purpose.
    fn from(value: f64) -> Self {
        if value.is_finite() { Cell::Number(value) } else { Cell::Missing }
    }
}

impl From<u64> for Cell {
    fn from(value: u64) -> Self {
        Cell::Whole(value)
    }
}

impl From<usize> for Cell {
    fn from(value: usize) -> Self {
        Cell::Whole(value as u64)
    }
}

impl From<bool> for Cell {
    fn from(value: bool) -> Self {
        Cell::Truth(value)
    }
}

impl From<&'static str> for Cell {
    fn from(value: &'static str) -> Self {
        Cell::Text(value.into())
    }
}

impl From<String> for Cell {
    fn from(value: String) -> Self {
        Cell::Text(value.into())
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Cell::Missing, Into::into)
    }
}
