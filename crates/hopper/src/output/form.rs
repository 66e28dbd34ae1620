//! The form in which tables are printed.

use crate::error::Error;
use crate::output::table::{Table, TableKind};
use crate::output::{csv, json, plain};
use std::io::Write;

/// Plain text, CSV or JSON, and which tables.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Form {
    style: Style,
    only: Option<&'static TableKind>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Style {
    Plain,
    Csv,
    Json,
}

impl Form {
    /// Aligned columns: every table that is not long.
    pub(crate) const fn plain() -> Self {
        Form { style: Style::Plain, only: None }
    }

    /// Comma-separated values: the first table.
    pub(crate) const fn csv() -> Self {
        Form { style: Style::Csv, only: None }
    }

    /// An object with all tables.
    pub(crate) const fn json() -> Self {
        Form { style: Style::Json, only: None }
    }

    /// The same form, with this table alone.
    pub(crate) fn only(self, table: &'static TableKind) -> Self {
        Form { only: Some(table), ..self }
    }

    /// Whether the output has this table. A command then need not compute it.
    pub(crate) fn shows(&self, table: &TableKind, first: &TableKind) -> bool {
        match (self.only, self.style) {
            (Some(only), _) => only == table,
            (None, Style::Plain) => !table.long,
            (None, Style::Csv) => table == first,
            (None, Style::Json) => true,
        }
    }

    /// Prints those of the tables that the form has. The first one is the main one.
    ///
    /// # Errors
    /// [`Error::ClosedOutput`] if the reader has gone; [`Error::File`] for another failure of the stream.
    pub(crate) fn print(&self, tables: &[Table], out: &mut dyn Write) -> Result<(), Error> {
        let Some(first) = tables.first() else { return Ok(()) };
        let shown: Vec<&Table> =
            tables.iter().filter(|table| self.shows(table.kind, first.kind)).collect();
        let written = match self.style {
            Style::Plain => plain::write(&shown, out),
            Style::Csv => shown.iter().try_for_each(|table| csv::write(table, out)),
            Style::Json => json::write(&shown, out),
        };
        written.map_err(Error::output)
    }
}
