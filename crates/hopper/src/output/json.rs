//! Tables as JSON: an object with an array for each table, one object a row, names in the order of the columns.

use crate::output::number::number;
use crate::output::table::{Cell, Table};
use std::io::{Result, Write};

/// Writes all tables as one object. What is missing is null.
pub(crate) fn write(tables: &[&Table], out: &mut dyn Write) -> Result<()> {
    write!(out, "{{")?;
    for (at, table) in tables.iter().enumerate() {
        write!(out, "{}\n  \"{}\": [", if at > 0 { "," } else { "" }, table.kind.name)?;
        for (at, row) in table.rows.iter().enumerate() {
            let named = table.kind.columns.iter().zip(row);
            let fields: Vec<String> = named
                .map(|(column, cell)| format!("\"{}\": {}", column.name, value(cell)))
                .collect();
            write!(out, "{}\n    {{{}}}", if at > 0 { "," } else { "" }, fields.join(", "))?;
        }
        write!(out, "\n  ]")?;
    }
    writeln!(out, "\n}}")
}

fn value(cell: &Cell) -> String {
    match cell {
        Cell::Number(value) => number(*value),
        Cell::Whole(value) => value.to_string(),
        Cell::Truth(truth) => truth.to_string(),
        Cell::Missing => "null".into(),
        Cell::Text(text) => serde_json::Value::from(text.as_str()).to_string(),
    }
}
