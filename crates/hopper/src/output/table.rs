//! A table: named columns with units, and rows of cells.

use crate::output::number::append_number;
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
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Column {
    /// Its name, the same in all forms.
    pub(crate) name: &'static str,
    /// The unit, empty for a plain number or a text.
    pub(crate) unit: &'static str,
    /// Its meaning.
    pub(crate) meaning: &'static str,
}

/// A cell.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Cell {
    Number(f64),
    Whole(u64),
    Text(Cow<'static, str>),
    Truth(bool),
    /// There is no such thing, such as the next speed of a grounded hopper: "–", an empty field, or null.
    Missing,
}

impl Cell {
    /// Appends a number or a whole number. The other cells look different in every form, and append nothing here.
    pub(crate) fn append_number(&self, text: &mut String) {
        match self {
            Cell::Number(value) => append_number(*value, text),
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
