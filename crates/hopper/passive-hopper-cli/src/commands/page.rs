//! What the help of a command says beside its options: units, limits, the fields of its output, examples.

use crate::output::TableKind;

/// The second half of the help of a command.
#[derive(Debug)]
pub(crate) struct Page {
    /// The units of what it takes and gives.
    pub(crate) units: &'static str,
    /// The limits of what it takes.
    pub(crate) limits: &'static str,
    /// The tables that it prints.
    pub(crate) tables: &'static [&'static TableKind],
    /// Calls that run. A test runs them.
    pub(crate) examples: &'static [Example],
}

/// A call, and what it shows.
#[derive(Debug)]
pub(crate) struct Example {
    /// What it shows.
    pub(crate) about: &'static str,
    /// The whole line, as a shell takes it.
    pub(crate) line: &'static str,
}

impl Page {
    /// The text at the end of the help.
    pub(crate) fn text(&self) -> String {
        let mut text =
            format!("Units:\n{}\nLimits:\n{}", indented(self.units), indented(self.limits));
        for table in self.tables {
            text += &format!("\nTable `{}`: {}\n", table.name, table.about);
            let widest = table.columns.iter().map(|column| column.name.len()).max().unwrap_or(0);
            for column in table.columns {
                let unit = if column.unit.is_empty() {
                    String::new()
                } else {
                    format!(" [{}]", column.unit)
                };
                text += &format!("  {:widest$}  {}{unit}\n", column.name, column.meaning);
            }
        }
        if !self.examples.is_empty() {
            text += "\nExamples:\n";
            for Example { about, line } in self.examples {
                text += &format!("  {about}\n    {line}\n");
            }
        }
        text
    }
}

fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}\n")).collect()
}
