//! Tables as JSON: an object with an array for each table, one object a row, names in the order of the columns.

use crate::output::table::{Cell, Table, TableKind};

/// Appends a row as an object, with the errors of its numbers. What is missing is null.
pub(crate) fn append_row(kind: &TableKind, row: &[Cell], text: &mut String) {
    text.push('{');
    for (at, (column, cell)) in kind.columns.iter().zip(row).enumerate() {
        *text += if at > 0 { ", \"" } else { "\"" };
        *text += column.name;
        *text += "\": ";
        append_value(cell, text);
    }
    for (name, error) in Table::errors(kind, row) {
        *text += &format!(", \"{name}_error\": ");
        append_value(&error, text);
    }
    text.push('}');
}

fn append_value(cell: &Cell, text: &mut String) {
    match cell {
        Cell::Truth(truth) => *text += if *truth { "true" } else { "false" },
        Cell::Missing => *text += "null",
        Cell::Text(own) => *text += &serde_json::Value::from(own.as_ref()).to_string(),
        cell => cell.append_number(text),
    }
}
