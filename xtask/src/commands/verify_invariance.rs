//! `verify-invariance`: the claim of Eq. 23 alone, with its figure.

use super::{all_hold, line, make_figure, results_folder};
use crate::progress::Progress;
use crate::{Error, claims, figures};
use std::io::Write;
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub struct Options {
    /// Folder for the figure and its data [default: target/paper in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Runs the command.
pub fn run(options: &Options) -> Result<(), Error> {
    let folder = results_folder(options.out.as_deref())?;
    let claims = claims::invariance(&Progress)?;
    for (_, build) in figures::named(&["invariance".into()])? {
        make_figure(&folder, build)?;
    }
    let mut out = std::io::stdout().lock();
    let write = |source| Error::File { path: "standard output".into(), source };
    for claim in &claims {
        writeln!(out, "{}", line(claim)).map_err(write)?;
    }
    writeln!(out, "figure     {}", folder.path().join("invariance.svg").display())
        .map_err(write)?;
    all_hold(&claims)
}
