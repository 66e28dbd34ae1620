//! Tables as comma-separated values (RFC 4180, with line feeds).

use crate::output::table::{Cell, TableKind};

/// Appends the names of the columns.
pub(crate) fn append_names(kind: &TableKind, text: &mut String) {
    let names: Vec<_> = kind.columns.iter().map(|column| column.name).collect();
    *text += &names.join(",");
    text.push('\n');
}

/// Appends a row. What is missing is an empty field.
pub(crate) fn append_row(row: &[Cell], text: &mut String) {
    for (at, cell) in row.iter().enumerate() {
        if at > 0 {
            text.push(',');
        }
        append_field(cell, text);
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

    #[test]
    fn texts_with_commas_are_quoted() {
        let mut text = String::new();
        append_row(&["a, \"b\"".into(), Cell::Missing, 0.5.into(), true.into()], &mut text);
        assert_eq!(text, "\"a, \"\"b\"\"\",,0.5,true\n");
    }
}
