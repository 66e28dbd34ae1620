//! A result beyond the paper: a figure and a table.

use crate::figure::Figure;

/// A result.
#[derive(Debug, Clone)]
pub(crate) struct Finding {
    /// Its figure, with the paper's statement and our statement as texts.
    pub figure: Figure,
    /// Its table.
    pub table: Table,
}

/// A table with markup in its cells.
#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    /// Names of the columns.
    pub header: Vec<String>,
    /// Rows, with as many cells as the header.
    pub rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(header: &[&str]) -> Self {
        Table { header: header.iter().map(|&name| name.to_owned()).collect(), rows: Vec::new() }
    }

    pub(super) fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }
}
