//! `model-figures`: pictures of the generic crates.

use super::{results_folder_named, write_figure};
use crate::output::{Folder, repository};
use crate::{Error, beyond, models};
use std::io::Write;
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub struct Options {
    /// Folder for the results [default: target/models in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Renew the figures in docs/figures
    #[arg(long)]
    bless: bool,
}

/// Runs the command.
pub fn run(options: &Options) -> Result<(), Error> {
    let folder = results_folder_named(options.out.as_deref(), "models")?;
    let job = beyond::Job::new(folder.path())?;
    for (name, draw) in models::ALL {
        let figure = draw(&job)?;
        let rendered = write_figure(&folder, &figure)?;
        if options.bless {
            let docs = Folder::open(&repository().join("docs/figures"))?;
            docs.write(&format!("{name}.png"), &rendered.png)?;
        }
        writeln!(std::io::stdout(), "{}", folder.path().join(format!("{name}.png")).display())
            .map_err(|source| Error::File { path: "standard output".into(), source })?;
    }
    job.done()
}
