//! Tables for people: a table with one row as a list, other tables as aligned columns.

use crate::output::number::append_certain;
use crate::output::table::{Cell, Table, TableKind};

/// Between two columns.
const GAP: &str = "  ";

/// Appends a table.
pub(crate) fn append_table(table: &Table, text: &mut String) {
    match &table.rows[..] {
        [] => {
            *text += table.kind.name;
            *text += ": none\n";
        }
        [row] => append_list(table.kind, row, text),
        rows => append_columns(table.kind, rows, text),
    }
}

/// Name, value, unit and meaning of each cell, one under another.
fn append_list(kind: &TableKind, row: &[Cell], text: &mut String) {
    let values: Vec<String> = row.iter().map(cell_text).collect();
    let widest = |texts: &mut dyn Iterator<Item = &str>| texts.map(width).max().unwrap_or(0);
    let names = widest(&mut kind.columns.iter().map(|column| column.name));
    let numbers = widest(&mut values.iter().map(String::as_str));
    let units = widest(&mut kind.columns.iter().map(|column| column.unit));
    for (column, value) in kind.columns.iter().zip(&values) {
        let cells =
            [(column.name, names), (value, numbers), (column.unit, units), (column.meaning, 0)];
        append_line(cells.into_iter(), text);
    }
}

/// A line of names, a line of units, and a line for each row.
fn append_columns(kind: &TableKind, rows: &[Vec<Cell>], text: &mut String) {
    let lines: Vec<Vec<String>> =
        rows.iter().map(|row| row.iter().map(cell_text).collect()).collect();
    let widest = |at: usize| lines.iter().filter_map(|line| line.get(at)).map(|t| width(t)).max();
    let widths: Vec<usize> = (0..kind.columns.len()).map(|at| widest(at).unwrap_or(0)).collect();
    let widths = append_names(kind, &widths, text);
    for line in &lines {
        append_line(line.iter().map(String::as_str).zip(widths.iter().copied()), text);
    }
}

/// Appends the names of the columns and, if there are any, their units. Gives the widths of the columns: at least
/// those given.
pub(crate) fn append_names(kind: &TableKind, widths: &[usize], text: &mut String) -> Vec<usize> {
    let own = kind.columns.iter().map(|column| width(column.name).max(width(column.unit)));
    let widths: Vec<usize> = own.zip(widths).map(|(own, &given)| own.max(given)).collect();
    let names = kind.columns.iter().map(|column| column.name);
    append_line(names.zip(widths.iter().copied()), text);
    if kind.columns.iter().any(|column| !column.unit.is_empty()) {
        let units = kind.columns.iter().map(|column| column.unit);
        append_line(units.zip(widths.iter().copied()), text);
    }
    widths
}

/// Appends a row with columns of these widths.
pub(crate) fn append_row(row: &[Cell], widths: &[usize], text: &mut String) {
    let begin = text.len();
    for (cell, &to) in row.iter().zip(widths) {
        let from = text.len();
        append_cell(cell, text);
        let own = width(&text[from..]);
        text.extend(std::iter::repeat_n(' ', to.saturating_sub(own)));
        *text += GAP;
    }
    end_line(begin, text);
}

fn append_line<'a>(cells: impl Iterator<Item = (&'a str, usize)>, text: &mut String) {
    let begin = text.len();
    for (cell, to) in cells {
        *text += cell;
        text.extend(std::iter::repeat_n(' ', to.saturating_sub(width(cell))));
        *text += GAP;
    }
    end_line(begin, text);
}

/// Ends the line that begins at `begin`, without spaces at its end.
fn end_line(begin: usize, text: &mut String) {
    let end = text[begin..].trim_end().len();
    text.truncate(begin + end);
    text.push('\n');
}

fn cell_text(cell: &Cell) -> String {
    let mut text = String::new();
    append_cell(cell, &mut text);
    text
}

fn append_cell(cell: &Cell, text: &mut String) {
    match cell {
        Cell::Text(own) => *text += own,
        Cell::Truth(truth) => *text += if *truth { "yes" } else { "no" },
        Cell::Missing => *text += "–",
        Cell::Measured(value, error) => append_certain(*value, *error, text),
        cell => cell.append_number(text),
    }
}

/// The width of a text on a terminal. All its characters are one place wide.
fn width(text: &str) -> usize {
    text.chars().count()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::table::Column;

    static KIND: TableKind = TableKind {
        name: "pairs",
        about: "",
        long: false,
        columns: &[Column::new("a", "m₂gω/k", "first"), Column::new("second", "", "second")],
    };

    #[test]
    fn one_row_is_a_list_and_more_rows_have_columns() {
        let mut table = Table::new(&KIND);
        let mut text = String::new();
        append_table(&table, &mut text);
        table.push([1.5.into(), "x".into()]);
        append_table(&table, &mut text);
        table.push([Cell::Missing, false.into()]);
        append_table(&table, &mut text);
        let lines = [
            "pairs: none",
            "a       1.5  m₂gω/k  first",
            "second  x            second",
            "a       second",
            "m₂gω/k",
            "1.5     x",
            "–       no",
            "",
        ];
        assert_eq!(text, lines.join("\n"));
    }
}
