//! `compare-events`: the events of the same scenes, and motions at equal errors, by SciPy, heyoka, diffsol and this repository.

use crate::error::Error;
use crate::events::{answers, by_diffsol, by_python, by_us, csv, markdown, totals, verdict};
use crate::motions;
use crate::peers::Python;
use crate::repository::{Folder, read, repository, results_folder, say};
use crate::text::replace_block;
use resumable_job::Lock;
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// The Python that makes the virtual environment for SciPy and heyoka
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: String,
    /// Folder for the environment and the results [default: target/peers in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Renew the tables of docs/performance.md and docs/note.md, docs/events.csv and docs/motions.csv with the measured values
    #[arg(long)]
    bless: bool,
}

/// Runs the command. A program that cannot be had is left out, with a line that begins with SKIPPED.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    // The environment is that of `compare-peers`: the packages are the same.
    let folder = results_folder(options.out.as_deref(), "peers")?;
    let _lock = Lock::take(folder.path(), "compare-peers")?;
    let mut found = by_us()?;
    let mut points = motions::by_us()?;
    let mut skipped = 0;
    let python = Python::with_packages(&options.python, folder.path());
    let by_python = python.and_then(|python| {
        Ok((by_python(&python, folder.path())?, motions::by_python(&python, folder.path())?))
    });
    let by_diffsol = by_diffsol(folder.path())
        .and_then(|events| Ok((events, motions::by_diffsol(folder.path())?)));
    for (name, theirs) in [("SciPy and heyoka", by_python), ("diffsol", by_diffsol)] {
        match theirs {
            Ok((events, motions)) => {
                found.extend(events);
                points.extend(motions);
            }
            Err(error) => {
                skipped += 1;
                say(format_args!("SKIPPED {name}: {error}"))?;
            }
        }
    }
    let mut verdicts = Vec::new();
    for answer in answers()? {
        let scene = found.iter().filter(|found| found.is_of(&answer.scene));
        verdicts.extend(scene.map(|found| verdict(found, &answer)));
    }
    let (table, data) = (markdown(&verdicts), csv(&verdicts)?);
    let (motions_table, motions_data) = (motions::markdown(&points), motions::csv(&points)?);
    folder.write("events.csv", &data.bytes)?;
    folder.write("motions.csv", &motions_data.bytes)?;
    let hard = motions::hard_motions();
    say(format_args!("{table}\n{motions_table}\n{hard}\n{}", folder.path().display()))?;
    if !options.bless {
        return Ok(());
    }
    if skipped > 0 {
        let reason = "the committed table has all programs; this run has skipped some".to_owned();
        return Err(Error::Peers { reason });
    }
    let docs = Folder::open(&repository().join("docs"))?;
    let text = read(&docs.path().join("performance.md"))?;
    let text = replace_block(&text, "events", &table)?;
    let text = replace_block(&text, "motions", &motions_table)?;
    docs.write("performance.md", text.as_bytes())?;
    let text = read(&docs.path().join("accuracy.md"))?;
    docs.write("accuracy.md", replace_block(&text, "hard motions", &hard)?.as_bytes())?;
    let text = read(&docs.path().join("note.md"))?;
    docs.write("note.md", replace_block(&text, "totals", &totals(&verdicts))?.as_bytes())?;
    docs.write("events.csv", &data.bytes)?;
    docs.write("motions.csv", &motions_data.bytes)?;
    Ok(())
}
