//! `work-precision`: time against error of every method that computes a hop.

use crate::error::Error;
use crate::repository::{Folder, Progress, read, repository, results_folder, say};
use crate::text::{duration, replace_block};
use crate::timing::sin_cos_time;
use crate::work_precision::{measure, scenes, table, work_precision_figure};
use journal_figures::render;
use std::path::PathBuf;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Folder for the results [default: target/work-precision in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Renew the tables and the figure of docs/accuracy.md with the measured values
    #[arg(long)]
    bless: bool,
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
    let folder = results_folder(options.out.as_deref(), "work-precision")?;
    let before = sin_cos_time();
    let scores = measure(&Progress)?;
    // A processor is slower just after an idle time. Therefore the smaller of two times is used.
    let unit = before.min(sin_cos_time());
    let scenes = scenes(&scores)?;
    let svg = work_precision_figure(&scores, unit);
    let rendered = render("work_precision", &svg, 2.0)?;
    let csv = table::csv(&scores, unit)?.bytes;
    folder.write("work_precision.csv", &csv)?;
    folder.write("work_precision.svg", rendered.svg.as_bytes())?;
    folder.write("work_precision.png", &rendered.png)?;
    let (methods, scenes) = (table::methods(&scores, unit), table::scenes(&scenes));
    let sin_cos = duration(unit.as_secs_f64());
    say(format_args!(
        "f64::sin_cos: {sin_cos}\n\n{methods}\n{scenes}\n{}",
        folder.path().display()
    ))?;
    if !options.bless {
        return Ok(());
    }
    let docs = Folder::open(&repository().join("docs"))?;
    let text = read(&docs.path().join("accuracy.md"))?;
    let unit = format!("One `f64::sin_cos` took {sin_cos} in the same run.");
    let text = replace_block(&text, "methods", &format!("{unit}\n\n{methods}"))?;
    let text = replace_block(&text, "scenes", &scenes)?;
    docs.write("accuracy.md", text.as_bytes())?;
    docs.write("work_precision.csv", &csv)?;
    docs.write("figures/work_precision.svg", rendered.svg.as_bytes())?;
    Ok(())
}
