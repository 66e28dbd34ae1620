//! `speed`: the figures of speed; the output of each is checked before its time is measured.

use crate::error::Error;
use crate::repository::{Progress, say};
use crate::speed::{Measured, measure};
use std::fmt::Write as _;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Print one JSON object instead of a table
    #[arg(long)]
    json: bool,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let figures = measure(&Progress)?;
    let text = if options.json { json(&figures)? } else { table(&figures) };
    say(text)?;
    Ok(())
}

fn json(figures: &[Measured]) -> Result<String, Error> {
    let object: serde_json::Map<_, _> =
        figures.iter().map(|f| (f.name.to_owned(), f.value.into())).collect();
    serde_json::to_string_pretty(&object)
        .map_err(|e| Error::Render { what: "figures".into(), reason: e.to_string() })
}

fn table(figures: &[Measured]) -> String {
    let mut text = String::new();
    for Measured { name, value, unit, checked } in figures {
        let value = if *value >= 1e5 { format!("{value:.2e}") } else { format!("{value:.2}") };
        let _ = writeln!(text, "{name:28} {value:>9} {unit:8} {checked}");
    }
    text.trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_one_line_for_each_figure() {
        let figure = |name, value| Measured { name, value, unit: "ms", checked: "all".into() };
        let figures = [figure("first", 1.234), figure("second", 1.234e8)];
        let text = table(&figures);
        assert!(text.lines().count() == 2 && text.contains("1.23 ms") && text.contains("1.23e8"));
        let object: serde_json::Value = serde_json::from_str(&json(&figures).unwrap()).unwrap();
        assert_eq!(object["second"], 1.234e8);
    }
}
