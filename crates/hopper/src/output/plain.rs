//! Tables for people: a table with one row as a list, other tables as aligned columns.

use crate::output::number::number;
use crate::output::table::{Cell, Table};
use std::io::{Result, Write};

/// Writes the tables, with an empty line between two.
pub(crate) fn write(tables: &[&Table], out: &mut dyn Write) -> Result<()> {
    for (at, table) in tables.iter().enumerate() {
        if at > 0 {
            writeln!(out)?;
        }
        if let [row] = &table.rows[..] {
            write_list(table, row, out)?
        } else {
            write_columns(table, out)?
        }
    }
    Ok(())
}

/// Name, value, unit and meaning of each cell, one under another.
fn write_list(table: &Table, row: &[Cell], out: &mut dyn Write) -> Result<()> {
    let columns = table.kind.columns;
    let texts: Vec<String> = row.iter().map(text).collect();
    let names = columns.iter().map(|column| width(column.name)).max().unwrap_or(0);
    let values = texts.iter().map(|text| width(text)).max().unwrap_or(0);
    let units = columns.iter().map(|column| width(column.unit)).max().unwrap_or(0);
    for (column, text) in columns.iter().zip(&texts) {
        let (name, value) = (padded(column.name, names), padded(text, values));
        let unit = padded(column.unit, units);
        writeln!(out, "{name}  {value}  {unit}  {}", column.meaning)?;
    }
    Ok(())
}

/// A line of names, a line of units if there are any, and a line for each row.
fn write_columns(table: &Table, out: &mut dyn Write) -> Result<()> {
    let columns = table.kind.columns;
    if table.rows.is_empty() {
        return writeln!(out, "{}: none", table.kind.name);
    }
    let mut lines = vec![columns.iter().map(|column| column.name.to_owned()).collect::<Vec<_>>()];
    if columns.iter().any(|column| !column.unit.is_empty()) {
        lines.push(columns.iter().map(|column| column.unit.to_owned()).collect());
    }
    lines.extend(table.rows.iter().map(|row| row.iter().map(text).collect()));
    let widest = |at: usize| lines.iter().filter_map(|line| line.get(at)).map(|t| width(t)).max();
    let widths: Vec<usize> = (0..columns.len()).map(|at| widest(at).unwrap_or(0)).collect();
    for line in &lines {
        let cells: Vec<String> =
            line.iter().zip(&widths).map(|(text, &width)| padded(text, width)).collect();
        writeln!(out, "{}", cells.join("  ").trim_end())?;
    }
    Ok(())
}

/// A cell as text.
pub(crate) fn text(cell: &Cell) -> String {
    match cell {
        Cell::Number(value) => number(*value),
        Cell::Whole(value) => value.to_string(),
        Cell::Text(text) => text.clone(),
        Cell::Truth(true) => "yes".into(),
        Cell::Truth(false) => "no".into(),
        Cell::Missing => "–".into(),
    }
}

/// The width of a text on a terminal: its characters without the marks that stand on another one.
fn width(text: &str) -> usize {
    text.chars().count()
}

fn padded(text: &str, to: usize) -> String {
    format!("{text}{}", " ".repeat(to.saturating_sub(width(text))))
}
