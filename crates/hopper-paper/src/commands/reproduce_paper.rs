//! `reproduce-paper`: computes every figure and every number of the paper, and writes a report.

use super::claim_lines::{all_hold, line};
use super::figure_files::make_figure;
use crate::claims::{self, Claim};
use crate::error::Error;
use crate::figure::Figure;
use crate::figures;
use crate::report;
use journal_figures::Rendered;
use repository_tools::{Folder, Progress, read, repository, results_folder, say};
use resumable_job::digest;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub struct Options {
    /// Folder for the results [default: target/paper in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Make only these figures, and check no claims
    #[arg(long, value_name = "FIGURE", value_delimiter = ',')]
    only: Vec<String>,
    /// Compare the data of the figures with the committed digests
    #[arg(long)]
    check: bool,
    /// Update the committed figures and digests in docs/figures
    #[arg(long, conflicts_with_all = ["check", "only"])]
    bless: bool,
}

/// The figures of the README, each with its file format.
const COMMITTED: &[(&str, Form)] = &[
    ("fig_02_map", Form::Svg),
    ("fig_03_segments", Form::Svg),
    ("fig_06_basin", Form::Png),
    ("invariance", Form::Svg),
    ("printed_against_stable", Form::Svg),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Form {
    Svg,
    Png,
}

/// The file of digests in docs/figures.
const DIGESTS: &str = "digests.json";

/// Runs the command.
pub fn run(options: &Options) -> Result<(), Error> {
    let begin = Instant::now();
    let chosen = figures::named(&options.only)?;
    let folder = results_folder(options.out.as_deref(), "paper")?;
    let mut made = Vec::new();
    for (name, build) in chosen {
        let (figure, rendered) = make_figure(&folder, build)?;
        say(format_args!(
            "{name:10} {}",
            folder.path().join(format!("{}.png", figure.name)).display()
        ))?;
        made.push((figure, rendered));
    }
    let claims = if options.only.is_empty() { Some(claims::all(&Progress)?) } else { None };
    if let Some(claims) = &claims {
        let json = serde_json::to_vec_pretty(claims)
            .map_err(|e| Error::Render { what: "claims.json".into(), reason: e.to_string() })?;
        folder.write("claims.json", &json)?;
        claims.iter().try_for_each(|claim| say(line(claim)))?;
    }
    let seconds = begin.elapsed().as_secs_f64();
    folder.write("report.html", report::page(&made, claims.as_deref(), seconds).as_bytes())?;
    say(format_args!("report     {}", folder.path().join("report.html").display()))?;
    let mut differing = Vec::new();
    if options.check {
        let comparison = compare(&made, options.only.is_empty())?;
        say(format_args!("check      {} files compared with docs/figures", comparison.compared))?;
        if comparison.compared == 0 {
            return Err(Error::CheckFailed(
                "--check compared nothing: of the figures in --only, none has data with a digest or \
                 a copy in docs/figures"
                    .into(),
            ));
        }
        differing = comparison.differing;
    }
    say(format_args!("{:.1} s", begin.elapsed().as_secs_f64()))?;
    verdict(claims.as_deref().unwrap_or(&[]), &differing)?;
    if options.bless { bless(&made) } else { Ok(()) }
}

fn verdict(claims: &[Claim], differing: &[String]) -> Result<(), Error> {
    if !differing.is_empty() {
        return Err(Error::CheckFailed(format!(
            "figure data differ from docs/figures/{DIGESTS}: {}. If that is meant: cargo xtask reproduce-paper --bless",
            differing.join(", ")
        )));
    }
    all_hold(claims)
}

/// Digests of all files of numbers. Images are left out: their bytes depend on the encoder too.
fn digests(made: &[(Figure, Rendered)]) -> BTreeMap<String, String> {
    let files = made.iter().flat_map(|(figure, _)| &figure.data);
    let numbers = files.filter(|file| !file.name.ends_with(".png"));
    numbers.map(|file| (file.name.clone(), digest(&file.bytes))).collect()
}

/// The committed files of a figure: name and contents.
fn committed<'a>(figure: &Figure, rendered: &'a Rendered) -> Vec<(String, &'a [u8])> {
    let forms = COMMITTED.iter().filter(|(name, _)| *name == figure.name).map(|(_, form)| form);
    let file = |form: &Form| match form {
        Form::Svg => (format!("{}.svg", figure.name), rendered.svg.as_bytes()),
        Form::Png => (format!("{}.png", figure.name), rendered.png.as_slice()),
    };
    forms.map(file).collect()
}

fn bless(made: &[(Figure, Rendered)]) -> Result<(), Error> {
    let folder = Folder::open(&repository().join("docs/figures"))?;
    for (figure, rendered) in made {
        for (name, bytes) in committed(figure, rendered) {
            folder.write(&name, bytes)?;
        }
    }
    let json = serde_json::to_string_pretty(&digests(made))
        .map_err(|e| Error::Render { what: DIGESTS.into(), reason: e.to_string() })?;
    folder.write(DIGESTS, format!("{json}\n").as_bytes())?;
    Ok(())
}

/// The files that were compared with docs/figures.
struct Comparison {
    compared: usize,
    differing: Vec<String>,
}

/// Compares the digests of the data with the committed digests, and the figures of the README with the figures drawn
/// now. If `all` figures are made, a committed digest without data counts as a difference.
fn compare(made: &[(Figure, Rendered)], all: bool) -> Result<Comparison, Error> {
    let folder = repository().join("docs/figures");
    let path = folder.join(DIGESTS);
    let known: BTreeMap<String, String> = serde_json::from_str(&read(&path)?)
        .map_err(|e| Error::Render { what: path.display().to_string(), reason: e.to_string() })?;
    let ours = digests(made);
    let mut compared = ours.len();
    let stale = known.keys().filter(|name| all && !ours.contains_key(*name)).cloned();
    let changed = ours.iter().filter(|(name, digest)| known.get(*name) != Some(digest));
    let mut differing: Vec<String> = stale.chain(changed.map(|(name, _)| name.clone())).collect();
    for (figure, rendered) in made {
        for (name, bytes) in committed(figure, rendered) {
            compared += 1;
            if std::fs::read(folder.join(&name)).ok().as_deref() != Some(bytes) {
                differing.push(name);
            }
        }
    }
    Ok(Comparison { compared, differing })
}
