//! `beyond-paper`: results that the paper does not have, with a report.

use super::figure_files::write_figure;
use crate::error::Error;
use crate::job::Job;
use crate::repository::{results_folder, say};
use crate::{beyond, report};
use std::path::PathBuf;
use std::time::Instant;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Folder for the results [default: target/beyond in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Make only these results
    #[arg(long, value_name = "RESULT", value_delimiter = ',')]
    only: Vec<String>,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let begin = Instant::now();
    let chosen = beyond::named(&options.only)?;
    let folder = results_folder(options.out.as_deref(), "beyond")?;
    let job = Job::new(folder.path())?;
    let mut made = Vec::new();
    for (name, find) in chosen {
        let finding = find(&job)?;
        let rendered = write_figure(&folder, &finding.figure)?;
        let path = folder.path().join(format!("{}.png", finding.figure.name));
        let seconds = begin.elapsed().as_secs_f64();
        say(format_args!("{name:14} {seconds:6.1} s  {}", path.display()))?;
        made.push((finding, rendered));
    }
    let page = report::findings_page(&made);
    // A report of some results must not replace the report of all.
    let name = if options.only.is_empty() { "report.html" } else { "report_part.html" };
    folder.write(name, page.as_bytes())?;
    job.done()?;
    say(format_args!("report {}", folder.path().join(name).display()))?;
    Ok(())
}
