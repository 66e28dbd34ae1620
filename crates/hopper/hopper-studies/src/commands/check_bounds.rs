//! `check-bounds`: is every error bound at least the actual error?

use crate::bounds::measured::Measured;
use crate::bounds::{expansions, fates, hops, sines, table};
use crate::error::Error;
use crate::repository::{Folder, Progress, read, repository, say};
use crate::text::replace_block;
use std::time::Instant;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Hops on which the bounds of landings are measured. Sines take a tenth of this number for each class,
    /// expansions and fates a hundredth
    #[arg(long, value_name = "N", default_value_t = 10_000_000, value_parser = clap::value_parser!(u64).range(1000..))]
    hops: u64,
    /// Seed of the random hops and arguments
    #[arg(long, value_name = "SEED", default_value_t = 1)]
    seed: u64,
    /// Measure one group of bounds only
    #[arg(long, value_enum)]
    group: Option<Group>,
    /// Multiply every bound by this number before it is compared. A small number must make the check fail
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0, value_parser = factor)]
    bound_factor: f64,
    /// Renew the table of docs/accuracy.md and docs/bounds.csv with the measured ratios
    #[arg(long, conflicts_with_all = ["group", "bound_factor"])]
    bless: bool,
}

/// A group of bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum Group {
    /// Landings of a hop, and the next speed
    Hops,
    /// Sines and cosines
    Sines,
    /// Expansions and local hops
    Expansions,
    /// Traps and orbits
    Fates,
}

/// Reads the value of `--bound-factor`.
fn factor(text: &str) -> Result<f64, String> {
    let factor: Option<f64> = text.parse().ok();
    let factor = factor.filter(|factor| *factor > 0.0 && factor.is_finite());
    factor.ok_or_else(|| "FACTOR must be a positive number".to_owned())
}

/// Hops for each sine of a class. With the three numbers, each group takes at most as long as the hops themselves.
const HOPS_PER_SINE: u64 = 10;
/// Hops for each input of a class of expansions, most of which are compared in 512 bits.
const HOPS_PER_EXPANSION: u64 = 1000;
/// Hops for each trap and each orbit of a class.
const HOPS_PER_ORBIT: u64 = 1000;

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let start = Instant::now();
    let &Options { hops: count, seed, group, bound_factor, bless } = options;
    let runs = |one| group.is_none_or(|chosen| chosen == one);
    let mut measured = Vec::new();
    let mut how_many = String::new();
    if runs(Group::Hops) {
        let found = hops::measure(count, seed, &Progress)?;
        let hops::HopBounds { measured: of_hops, compared, undecided } = found;
        how_many = format!(
            "{compared} hops were compared; {undecided} hops are undecided in all arithmetics."
        );
        measured.extend(of_hops);
    }
    if runs(Group::Sines) {
        measured.extend(sines::measure(count / HOPS_PER_SINE, seed)?);
    }
    if runs(Group::Expansions) {
        measured.extend(expansions::measure(count / HOPS_PER_EXPANSION)?);
    }
    if runs(Group::Fates) {
        measured.extend(fates::measure(count / HOPS_PER_ORBIT)?);
    }
    for found in &mut measured {
        found.median /= bound_factor;
        found.largest /= bound_factor;
    }
    let seconds = start.elapsed().as_secs();
    say(format_args!("{}\n{how_many} It took {seconds} s.", table::lines(&measured)))?;
    if bless {
        let docs = Folder::open(&repository().join("docs"))?;
        let text = read(&docs.path().join("accuracy.md"))?;
        let block = format!("{how_many} The seed is {seed}.\n\n{}", table::markdown(&measured));
        docs.write("accuracy.md", replace_block(&text, "bounds", &block)?.as_bytes())?;
        docs.write("bounds.csv", &table::csv(&measured)?.bytes)?;
    }
    all_hold(&measured)
}

/// An error that names every bound below the actual error.
fn all_hold(measured: &[Measured]) -> Result<(), Error> {
    // `!(≤)` counts a ratio that is no number as broken.
    let broken = measured.iter().filter(|found| !(found.largest <= 1.0));
    let lines: Vec<String> = broken
        .map(|found| {
            let Measured { bound, class, largest, at, .. } = found;
            format!("{bound} ({class}): the actual error is {largest:.3} times the bound, at {at}")
        })
        .collect();
    match lines.len() {
        0 => Ok(()),
        count => Err(Error::CheckFailed(format!(
            "{count} bounds are smaller than the actual error:\n{}",
            lines.join("\n")
        ))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ratio_above_one_and_one_that_is_no_number_fail() {
        let with = |largest| Measured {
            bound: "x′",
            statement: "section 13",
            class: "planted",
            count: 1,
            median: 0.0,
            largest,
            at: "M = 1, α = 2".into(),
        };
        assert!(all_hold(&[with(1.0), with(0.0)]).is_ok());
        for largest in [1.0f64.next_up(), f64::INFINITY, f64::NAN] {
            let error = all_hold(&[with(0.5), with(largest)]).unwrap_err().to_string();
            assert!(error.contains("1 bounds") && error.contains("M = 1, α = 2"), "{error}");
        }
    }
}
