//! `model-figures`: pictures of the generic crates.

use super::figure_files::write_figure;
use crate::error::Error;
use crate::job::Job;
use crate::models;
use crate::repository::{Folder, repository, results_folder, say};
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Folder for the results [default: target/models in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Renew the figures in docs/figures
    #[arg(long)]
    bless: bool,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let folder = results_folder(options.out.as_deref(), "models")?;
    let job = Job::new(folder.path())?;
    for (name, draw) in models::ALL {
        let figure = draw(&job)?;
        let rendered = write_figure(&folder, &figure)?;
        if options.bless {
            let docs = Folder::open(&repository().join("docs/figures"))?;
            docs.write(&format!("{name}.png"), &rendered.png)?;
        }
        say(folder.path().join(format!("{name}.png")).display())?;
    }
    job.done()
}
