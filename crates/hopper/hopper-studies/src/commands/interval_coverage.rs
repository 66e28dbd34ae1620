//! `interval-coverage`: how often does every interval of `basin-of-attraction` contain the true number?

use crate::coverage::tally::Row;
use crate::coverage::{
    boundaries, cantor_sets, exponents, interval_bounds, proportions, shocks, table,
};
use crate::error::Error;
use crate::repository::{Folder, read, repository, say};
use crate::text::replace_block;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Trials for each interval and scene
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = clap::value_parser!(u64).range(100..))]
    trials: u64,
    /// Renew the table of docs/basins-measured.md
    #[arg(long)]
    bless: bool,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let &Options { trials, bless } = options;
    let rows = [
        proportions::measure(trials)?,
        exponents::measure(trials)?,
        boundaries::measure(trials)?,
        interval_bounds::measure(trials)?,
        shocks::measure(trials)?,
        cantor_sets::measure(trials)?,
    ]
    .concat();
    let text = table::markdown(&rows)?;
    say(text.trim_end())?;
    if bless {
        let docs = Folder::open(&repository().join("docs"))?;
        let page = read(&docs.path().join("basins-measured.md"))?;
        docs.write("basins-measured.md", replace_block(&page, "coverage", &text)?.as_bytes())?;
    }
    all_hold(&rows)
}

/// An error that names every interval that contains the truth too rarely.
fn all_hold(rows: &[Row]) -> Result<(), Error> {
    let broken: Vec<String> = rows
        .iter()
        .filter(|row| !row.holds())
        .map(|row| {
            let Row { interval, scene, covered, given, .. } = row;
            format!("{interval} ({scene}): {covered} of {given}")
        })
        .collect();
    match broken.len() {
        0 => Ok(()),
        count => Err(Error::CheckFailed(format!(
            "{count} intervals contain the true number too rarely:\n{}",
            broken.join("\n")
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::coverage::tally::Promise;

    #[test]
    fn an_interval_that_covers_too_rarely_fails() {
        let row = |covered| Row {
            interval: "planted",
            scene: "one".into(),
            promise: Promise::Probable,
            given: 1000,
            refused: 0,
            covered,
            mean_half_width: 1.0,
            over_wilson: None,
        };
        assert!(all_hold(&[row(930), row(1000)]).is_ok());
        let error = all_hold(&[row(950), row(929)]).unwrap_err().to_string();
        assert!(
            error.contains("1 intervals") && error.contains("planted (one): 929 of 1000"),
            "{error}"
        );
    }
}
