//! The form in which tables are printed.

use crate::error::Error;
use crate::output::table::{Cell, Table, TableKind};
use crate::output::{csv, json, plain};
use std::io::Write;

/// Plain text, CSV, JSON or lines of JSON, and which tables.
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
    Ndjson,
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

    /// An object on a line of its own for each row of the first table.
    pub(crate) const fn ndjson() -> Self {
        Form { style: Style::Ndjson, only: None }
    }

    /// The same form, with this table alone.
    pub(crate) fn only(self, table: &'static TableKind) -> Self {
        Form { only: Some(table), ..self }
    }

    /// Whether the output has this one of the tables of a command. A table that it has not need not be computed.
    pub(crate) fn shows(&self, table: &TableKind, tables: &[&'static TableKind]) -> bool {
        match (self.only, self.style) {
            (Some(only), _) => only == table,
            (None, Style::Plain) => !table.long,
            (None, Style::Csv | Style::Ndjson) => {
                tables.first().is_some_and(|first| *first == table)
            }
            (None, Style::Json) => true,
        }
    }

    /// Whether a filter, which has one table, has this one: the first of its command, or the one that is asked for.
    pub(crate) fn is_first(&self, table: &TableKind) -> bool {
        self.only.is_none_or(|only| only == table)
    }

    /// Prints those of the tables that the form has. The first one is the main one.
    ///
    /// # Errors
    /// [`Error::ClosedOutput`] if the reader has gone; [`Error::File`] for another failure of the stream.
    pub(crate) fn print(&self, tables: &[Table], out: &mut dyn Write) -> Result<(), Error> {
        let kinds: Vec<_> = tables.iter().map(|table| table.kind).collect();
        let shown = tables.iter().filter(|table| self.shows(table.kind, &kinds));
        let mut text = String::new();
        for (at, table) in shown.enumerate() {
            if at > 0 {
                text += if self.style == Style::Json { "," } else { "\n" };
            }
            match self.style {
                Style::Plain => plain::append_table(table, &mut text),
                Style::Csv => {
                    csv::append_names(table.kind, &mut text);
                    table.rows.iter().for_each(|row| csv::append_row(table.kind, row, &mut text));
                }
                Style::Ndjson => {
                    let mut rows = Rows::new(*self, table.kind, &[]);
                    table.rows.iter().for_each(|row| rows.append(row, &mut text));
                }
                Style::Json => {
                    text += if at == 0 { "{" } else { "" };
                    let mut rows = Rows::new(*self, table.kind, &[]);
                    rows.append_start(&mut text);
                    table.rows.iter().for_each(|row| rows.append(row, &mut text));
                    rows.append_end(&mut text);
                }
            }
        }
        if self.style == Style::Json {
            text += "\n}\n";
        }
        out.write_all(text.as_bytes()).map_err(Error::output)
    }

    /// One table, whose rows come one by one: the start of its output. `widths` are those of its columns in plain text.
    pub(crate) fn rows(self, kind: &'static TableKind, widths: &[usize]) -> (Rows, String) {
        let mut rows = Rows::new(self, kind, widths);
        let mut text = String::new();
        match self.style {
            Style::Plain => rows.widths = plain::append_names(kind, widths, &mut text),
            Style::Csv => csv::append_names(kind, &mut text),
            Style::Json => {
                text.push('{');
                rows.append_start(&mut text);
            }
            Style::Ndjson => {}
        }
        (rows, text)
    }
}

/// The rows of a table that come one by one.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    style: Style,
    kind: &'static TableKind,
    widths: Vec<usize>,
    /// Whether a row has come: in JSON a comma is before every other one.
    begun: bool,
}

impl Rows {
    fn new(form: Form, kind: &'static TableKind, widths: &[usize]) -> Self {
        Rows { style: form.style, kind, widths: widths.to_vec(), begun: false }
    }

    fn append_start(&self, text: &mut String) {
        *text += "\n  \"";
        *text += self.kind.name;
        *text += "\": [";
    }

    fn append_end(&self, text: &mut String) {
        *text += "\n  ]";
    }

    /// Appends the next row.
    pub(crate) fn append(&mut self, row: &[Cell], text: &mut String) {
        match self.style {
            Style::Plain => plain::append_row(row, &self.widths, text),
            Style::Csv => csv::append_row(self.kind, row, text),
            Style::Json => {
                *text += if self.begun { ",\n    " } else { "\n    " };
                json::append_row(self.kind, row, text);
            }
            Style::Ndjson => {
                json::append_row(self.kind, row, text);
                text.push('\n');
            }
        }
        self.begun = true;
    }

    /// The rows after the first one, for a part of the output that another thread writes.
    pub(crate) fn continued(&self, begun: bool) -> Self {
        Rows { begun, ..self.clone() }
    }

    /// The end of the output.
    pub(crate) fn end(&self) -> &'static str {
        if self.style == Style::Json { "\n  ]\n}\n" } else { "" }
    }
}
