//! `compare-events`: the events of the same scenes by SciPy, heyoka, diffsol and this repository.

use crate::error::Error;
use crate::events::{answers, by_diffsol, by_python, by_us, csv, markdown, verdict};
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
    /// Renew the table of docs/performance.md and docs/events.csv with the measured values
    #[arg(long)]
    bless: bool,
}

/// Runs the command. A program that cannot be had is left out, with a line that begins with SKIPPED.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    // The environment is that of `compare-peers`: the packages are the same.
    let folder = results_folder(options.out.as_deref(), "peers")?;
    let _lock = Lock::take(folder.path(), "compare-peers")?;
    let mut found = by_us()?;
    let mut skipped = 0;
    let by_python = Python::with_packages(&options.python, folder.path())
        .and_then(|python| by_python(&python, folder.path()));
    for (name, theirs) in [("SciPy and heyoka", by_python), ("diffsol", by_diffsol(folder.path()))]
    {
        match theirs {
            Ok(theirs) => found.extend(theirs),
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
    folder.write("events.csv", &data.bytes)?;
    say(format_args!("{table}\n{}", folder.path().display()))?;
    if !options.bless {
        return Ok(());
    }
    if skipped > 0 {
        let reason = "the committed table has all programs; this run has skipped some".to_owned();
        return Err(Error::Peers { reason });
    }
    let docs = Folder::open(&repository().join("docs"))?;
    let text = read(&docs.path().join("performance.md"))?;
    docs.write("performance.md", replace_block(&text, "events", &table)?.as_bytes())?;
    docs.write("events.csv", &data.bytes)?;
    Ok(())
}
