//! What the help of a command says beside its options: units, limits, the fields of its output, examples.

use crate::output::TableKind;

/// The second half of the help of a command.
#[derive(Debug)]
pub(crate) struct Page {
    /// The units of what it takes and gives.
    pub(crate) units: &'static str,
    /// The limits of what it takes.
    pub(crate) limits: &'static str,
    /// Whether it takes speeds from the input.
    pub(crate) is_filter: bool,
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
    /// The whole call, as a shell takes it. It has a line break where one fits.
    pub(crate) line: &'static str,
}

impl Page {
    /// The text at the end of the help.
    pub(crate) fn text(&self) -> String {
        let mut text =
            format!("Units:\n{}\nLimits:\n{}", indented(self.units), indented(self.limits));
        if self.is_filter {
            text += &indented(crate::options::input::LIMITS);
        }
        for table in self.tables {
            text += &format!("\nTable `{}`: {}\n", table.name, table.about);
            let widest = table.columns.iter().map(|column| column.name.len()).max().unwrap_or(0);
            for column in table.columns {
                let unit = if column.unit.is_empty() {
                    String::new()
                } else {
                    format!(" [{}]", column.unit)
                };
                let line = format!("  {:widest$}  {}{unit}", column.name, column.meaning);
                text += &format!("{}\n", hanging(&line, widest + 4));
            }
        }
        if !self.examples.is_empty() {
            text += "\nExamples:\n";
            for Example { about, line } in self.examples {
                let lines: String = line.lines().map(|line| format!("    {line}\n")).collect();
                text += &format!("  {about}\n{lines}");
            }
        }
        text
    }
}

/// The widest help: longer lines are hard to read.
pub(crate) const WIDEST: usize = 100;

/// A line as lines that fit the terminal, all but the first one indented.
fn hanging(line: &str, indent: usize) -> String {
    let terminal = terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    let given = || std::env::var("COLUMNS").ok().and_then(|columns| columns.parse().ok());
    let width = terminal.or_else(given).unwrap_or(WIDEST).min(WIDEST);
    let indent = " ".repeat(indent);
    textwrap::fill(line, textwrap::Options::new(width).subsequent_indent(&indent))
}

fn indented(text: &str) -> String {
    text.lines().map(|line| format!("  {line}\n")).collect()
}
