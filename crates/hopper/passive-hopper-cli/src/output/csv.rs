//! Tables as comma-separated values (RFC 4180, with line feeds).

use crate::output::table::{Accuracy, Cell, Table, TableKind};

/// Appends the names of the columns.
pub(crate) fn append_names(kind: &TableKind, text: &mut String) {
    let mut names: Vec<_> = kind.columns.iter().map(|column| column.name.to_owned()).collect();
    let measured = kind.columns.iter().filter(|column| column.accuracy == Accuracy::Measured);
    names.extend(measured.map(|column| format!("{}_error", column.name)));
    *text += &names.join(",");
    text.push('\n');
}

/// Appends a row, and the errors of its numbers. What is missing is an empty field.
pub(crate) fn append_row(kind: &TableKind, row: &[Cell], text: &mut String) {
    for (at, cell) in row.iter().enumerate() {
        if at > 0 {
            text.push(',');
        }
        append_field(cell, text);
    }
    for (_, error) in Table::errors(kind, row) {
        text.push(',');
        append_field(&error, text);
    }
    text.push('\n');
}

fn append_field(cell: &Cell, text: &mut String) {
    match cell {
        Cell::Truth(truth) => *text += if *truth { "true" } else { "false" },
        Cell::Text(own) if own.contains([',', '"', '\n', '\r']) => {
            text.push('"');
            *text += &own.replace('"', "\"\"");
            text.push('"');
        }
        Cell::Text(own) => *text += own,
        cell => cell.append_number(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::table::Column;

    #[test]
    fn texts_with_commas_are_quoted() {
        let mut text = String::new();
        let row = ["a, \"b\"".into(), Cell::Missing, 0.5.into()];
        append_row(&KIND, &row, &mut text);
        assert_eq!(text, "\"a, \"\"b\"\"\",,0.5,,\n");
    }

    static KIND: TableKind = TableKind {
        name: "pairs",
        about: "",
        long: false,
        columns: &[
            Column::new("a", "", "").measured(),
            Column::new("b", "", ""),
            Column::new("c", "", "").measured(),
        ],
    };

    #[test]
    fn errors_follow_the_columns() {
        let mut text = String::new();
        append_names(&KIND, &mut text);
        append_row(&KIND, &[Cell::measured(0.5, 1e-9), "x".into(), Cell::Missing], &mut text);
        append_row(
            &KIND,
            &[Cell::measured(0.5, f64::INFINITY), "x".into(), Cell::measured(2.0, 0.0)],
            &mut text,
        );
        assert_eq!(text, "a,b,c,a_error,c_error\n0.5,x,,1e-9,\n0.5,x,2,,0\n");
    }
}
