//! `verify-invariance`: the claim of Eq. 23 alone, with its figure.

use super::{failed, line};
use crate::output::{Folder, repository};
use crate::plot::render::render;
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
    let folder =
        Folder::open(&options.out.clone().unwrap_or_else(|| repository().join("target/paper")))?;
    let claims = claims::invariance(&Progress)?;
    for (_, build) in figures::named(&["invariance".into()])? {
        let figure = build(&Progress)?;
        let rendered = render(figure.name, &figure.svg, 2.0)?;
        folder.write(&format!("{}.svg", figure.name), rendered.svg.as_bytes())?;
        folder.write(&format!("{}.png", figure.name), &rendered.png)?;
        figure.data.iter().try_for_each(|file| folder.write(&file.name, &file.bytes))?;
    }
    let mut out = std::io::stdout().lock();
    let write = |source| Error::File { path: "standard output".into(), source };
    for claim in &claims {
        writeln!(out, "{}", line(claim)).map_err(write)?;
    }
    writeln!(out, "figure     {}", folder.path().join("invariance.svg").display())
        .map_err(write)?;
    match failed(&claims) {
        0 => Ok(()),
        count => Err(Error::CheckFailed(format!("{count} claims fail"))),
    }
}
