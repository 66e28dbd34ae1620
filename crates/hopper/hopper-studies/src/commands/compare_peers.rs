//! `compare-peers`: the same hops and basins by heyoka, SciPy, NumPy, numba and this repository, in Rust and in Python.

use crate::error::Error;
use crate::peers::{
    Python, array_times, arrays_markdown, basin_times, basins_markdown, csv, markdown, measure,
    peers_figure, system_times, systems_markdown,
};
use crate::repository::{Folder, Progress, read, repository, results_folder, say};
use crate::text::replace_block;
use journal_figures::render;
use resumable_job::Lock;
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// The Python that makes the virtual environment for the peers
    #[arg(long, value_name = "PROGRAM", default_value = "python3")]
    python: String,
    /// Folder for the environment and the results [default: target/peers in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Renew the tables and the figure of docs/performance.md with the measured values
    #[arg(long)]
    bless: bool,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let folder = results_folder(options.out.as_deref(), "peers")?;
    // Two runs would install into the same environment and read each other's results.
    let _lock = Lock::take(folder.path(), "compare-peers")?;
    let package = repository().join("crates/both/python-package");
    let python = Python::with_packages(&options.python, folder.path())?
        .with_own_package(&package, &folder.path().join("build"))?;
    let peers = measure(&python, folder.path(), &Progress)?;
    let arrays = arrays_markdown(&array_times(&python, folder.path(), &Progress)?);
    let systems = systems_markdown(&system_times(&python, folder.path(), &Progress)?);
    let basins = basins_markdown(&basin_times(&python, folder.path(), &Progress)?);
    let rendered = render("peers", &peers_figure(&peers), 2.0)?;
    folder.write("peers.csv", &csv(&peers)?.bytes)?;
    folder.write("peers.svg", rendered.svg.as_bytes())?;
    folder.write("peers.png", &rendered.png)?;
    let table = markdown(&peers);
    say(format_args!("{table}\n{arrays}\n{systems}\n{basins}\n{}", folder.path().display()))?;
    if !options.bless {
        return Ok(());
    }
    let docs = Folder::open(&repository().join("docs"))?;
    let text = read(&docs.path().join("performance.md"))?;
    let text = replace_block(&text, "peers", &table)?;
    let text = replace_block(&text, "arrays", &arrays)?;
    let text = replace_block(&text, "systems", &systems)?;
    docs.write("performance.md", replace_block(&text, "basins", &basins)?.as_bytes())?;
    docs.write("figures/peers.svg", rendered.svg.as_bytes())?;
    Ok(())
}
