//! A table: named columns with units, and rows of cells.

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
    Text(String),
    Truth(bool),
    /// There is no such thing, such as the next speed of a grounded hopper: "–", an empty field, or null.
    Missing,
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

impl From<&str> for Cell {
    fn from(value: &str) -> Self {
        Cell::Text(value.to_owned())
    }
}

impl From<String> for Cell {
    fn from(value: String) -> Self {
        Cell::Text(value)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Cell::Missing, Into::into)
    }
}
