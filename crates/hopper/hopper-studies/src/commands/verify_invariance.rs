//! `verify-invariance`: only the claim of Eq. 23, with its figure.

use super::claim_lines::{all_hold, line};
use super::figure_files::make_figure;
use crate::error::Error;
use crate::repository::{Progress, results_folder, say};
use crate::{claims, figures};
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Folder for the figure and its data [default: target/paper in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let folder = results_folder(options.out.as_deref(), "paper")?;
    let claims = claims::invariance(&Progress)?;
    for (_, build) in figures::named(&["invariance".into()])? {
        make_figure(&folder, build)?;
    }
    for claim in &claims {
        say(line(claim))?;
    }
    say(format_args!("figure     {}", folder.path().join("invariance.svg").display()))?;
    all_hold(&claims)
}
