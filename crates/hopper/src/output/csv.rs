//! Tables as comma-separated values (RFC 4180, with line feeds).

use crate::output::number::number;
use crate::output::table::{Cell, Table};
use std::io::{Result, Write};

/// Writes the names of the columns and the rows. What is missing is an empty field.
pub(crate) fn write(table: &Table, out: &mut dyn Write) -> Result<()> {
    let names: Vec<_> = table.kind.columns.iter().map(|column| column.name).collect();
    writeln!(out, "{}", names.join(","))?;
    for row in &table.rows {
        let fields: Vec<String> = row.iter().map(field).collect();
        writeln!(out, "{}", fields.join(","))?;
    }
    Ok(())
}

fn field(cell: &Cell) -> String {
    match cell {
        Cell::Number(value) => number(*value),
        Cell::Whole(value) => value.to_string(),
        Cell::Truth(truth) => truth.to_string(),
        Cell::Missing => String::new(),
        Cell::Text(text) if text.contains([',', '"', '\n', '\r']) => {
            format!("\"{}\"", text.replace('"', "\"\""))
        }
        Cell::Text(text) => text.clone(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_with_commas_are_quoted() {
        assert_eq!(field(&"a, \"b\"".into()), "\"a, \"\"b\"\"\"");
        assert_eq!(field(&Cell::Missing), "");
        assert_eq!(field(&0.5.into()), "0.5");
    }
}
