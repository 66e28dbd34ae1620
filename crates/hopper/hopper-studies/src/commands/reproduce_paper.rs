//! `reproduce-paper`: computes every figure and every number of the paper, and writes a report.

use super::claim_lines::{all_hold, line};
use super::figure_files::make_figure;
use crate::claims::{self, Claim};
use crate::comparison::difference;
use crate::comparison::table::Table;
use crate::comparison::table_digest::TableDigest;
use crate::error::Error;
use crate::figure::Figure;
use crate::figures;
use crate::report;
use crate::repository::{Folder, Progress, read, repository, results_folder, say};
use journal_figures::{DataFile, Rendered};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Options.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Options {
    /// Folder for the results [default: target/paper in the repository]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Make only these figures, and check no claims
    #[arg(long, value_name = "FIGURE", value_delimiter = ',')]
    only: Vec<String>,
    /// Compare numbers and pixels with the committed digests and figures in docs/figures
    #[arg(long)]
    check: bool,
    /// Update the committed figures and digests in docs/figures
    #[arg(long, conflicts_with_all = ["check", "only"])]
    bless: bool,
}

/// The figures of the README, each with its file format.
const COMMITTED: &[(&str, FileFormat)] = &[
    ("fig_02_map", FileFormat::Svg),
    ("fig_03_segments", FileFormat::Svg),
    ("fig_06_basin", FileFormat::Png),
    ("invariance", FileFormat::Svg),
    ("printed_against_stable", FileFormat::Svg),
];

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum FileFormat {
    Svg,
    Png,
}

/// The file of digests in docs/figures.
const DIGESTS: &str = "digests.json";

/// The folder of the committed figures.
fn committed_folder() -> PathBuf {
    repository().join("docs/figures")
}

/// Runs the command.
pub(crate) fn run(options: &Options) -> Result<(), Error> {
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
        let comparison = compare(&made, &committed_folder(), options.only.is_empty())?;
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
    if options.bless { bless(&made, &committed_folder()) } else { Ok(()) }
}

fn verdict(claims: &[Claim], differing: &[String]) -> Result<(), Error> {
    if !differing.is_empty() {
        return Err(Error::CheckFailed(format!(
            "figures differ from docs/figures: {}. If that is meant: cargo xtask reproduce-paper --bless",
            differing.join("; ")
        )));
    }
    all_hold(claims)
}

/// The digests of all data files: numbers of tables and arrays, pixels of images.
fn digests(made: &[(Figure, Rendered)]) -> Result<BTreeMap<String, TableDigest>, Error> {
    let files = made.iter().flat_map(|(figure, _)| &figure.data);
    let digest = |file: &DataFile| {
        Ok((file.name.clone(), TableDigest::of(&Table::read(&file.name, &file.bytes)?)))
    };
    files.map(digest).collect()
}

/// The committed files of a figure: name and contents.
fn committed<'a>(figure: &Figure, rendered: &'a Rendered) -> Vec<(String, &'a [u8])> {
    let formats =
        COMMITTED.iter().filter(|(name, _)| *name == figure.name).map(|(_, format)| format);
    let file = |format: &FileFormat| match format {
        FileFormat::Svg => (format!("{}.svg", figure.name), rendered.svg.as_bytes()),
        FileFormat::Png => (format!("{}.png", figure.name), rendered.png.as_slice()),
    };
    formats.map(file).collect()
}

/// Writes the committed figures and the digests into a folder.
fn bless(made: &[(Figure, Rendered)], folder: &Path) -> Result<(), Error> {
    let folder = Folder::open(folder)?;
    for (figure, rendered) in made {
        for (name, bytes) in committed(figure, rendered) {
            folder.write(&name, bytes)?;
        }
    }
    // One line for each file, so that a comparison of versions shows the files that changed.
    let line = |(name, digest): (&String, &TableDigest)| {
        let json = serde_json::to_string(digest)
            .map_err(|e| Error::Render { what: DIGESTS.into(), reason: e.to_string() })?;
        Ok(format!("  \"{name}\": {json}"))
    };
    let lines: Result<Vec<String>, Error> = digests(made)?.iter().map(line).collect();
    folder.write(DIGESTS, format!("{{\n{}\n}}\n", lines?.join(",\n")).as_bytes())?;
    Ok(())
}

/// The files that were compared with docs/figures.
struct FileComparison {
    compared: usize,
    /// The name of each file that differs, with the difference.
    differing: Vec<String>,
}

/// Compares the digests of the data with the digests in `folder`, and the figures of the README with their copies
/// there. If `all` figures are made, a committed digest without data counts as a difference.
fn compare(made: &[(Figure, Rendered)], folder: &Path, all: bool) -> Result<FileComparison, Error> {
    let path = folder.join(DIGESTS);
    let known: BTreeMap<String, TableDigest> = serde_json::from_str(&read(&path)?)
        .map_err(|e| Error::Render { what: path.display().to_string(), reason: e.to_string() })?;
    let ours = digests(made)?;
    let mut compared = ours.len();
    let mut differing: Vec<String> = known
        .keys()
        .filter(|name| all && !ours.contains_key(*name))
        .map(|name| format!("{name}: it has a digest, and no figure makes it"))
        .collect();
    for (name, new) in &ours {
        match known.get(name) {
            None => differing.push(format!("{name}: it has no digest")),
            Some(old) => {
                differing.extend(old.difference(new).map(|found| format!("{name}: {found}")))
            }
        }
    }
    for (figure, rendered) in made {
        for (name, new) in committed(figure, rendered) {
            compared += 1;
            let path = folder.join(&name);
            let old = std::fs::read(&path).map_err(|source| Error::File { path, source })?;
            differing.extend(difference(&name, &old, new)?.map(|found| format!("{name}: {found}")));
        }
    }
    Ok(FileComparison { compared, differing })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::figures::Build;

    /// A figure with a CSV file and a copy in docs/figures.
    const FIG_2: &str = "fig2";

    fn made(folder: &Path) -> Vec<(Figure, Rendered)> {
        let builds: Vec<(_, Build)> = figures::named(&[FIG_2.to_owned()]).unwrap();
        let folder = Folder::open(folder).unwrap();
        builds.into_iter().map(|(_, build)| make_figure(&folder, build).unwrap()).collect()
    }

    /// Changes the last digit of a file.
    fn change_the_last_digit(bytes: &mut [u8]) {
        let last = bytes.iter_mut().rev().find(|byte| byte.is_ascii_digit()).unwrap();
        *last = if *last == b'7' { b'3' } else { b'7' };
    }

    #[test]
    fn one_changed_number_of_a_figure_is_found_in_its_file() {
        let name = format!("hopper_paper_compare_{}", std::process::id());
        let folder = std::env::temp_dir().join(name);
        let mut made = made(&folder);
        bless(&made, &folder).unwrap();
        let compared = compare(&made, &folder, true).unwrap();
        assert_eq!((compared.compared, compared.differing), (2, vec![]));
        // A number of the data.
        let data = made[0].0.data[0].bytes.clone();
        change_the_last_digit(&mut made[0].0.data[0].bytes);
        let found = compare(&made, &folder, true).unwrap().differing;
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("fig_02_map.csv: differs in column alpha_next; rows "));
        assert!(verdict(&[], &found).unwrap_err().to_string().contains("--bless"));
        made[0].0.data[0].bytes = data;
        // A number of the drawing.
        let path = folder.join("fig_02_map.svg");
        let mut drawing = std::fs::read(&path).unwrap();
        change_the_last_digit(&mut drawing);
        std::fs::write(&path, drawing).unwrap();
        let found = compare(&made, &folder, true).unwrap().differing;
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].starts_with("fig_02_map.svg: line ") && found[0].contains(" was "));
        // Data that no figure makes, and data without a digest.
        let data = made[0].0.data.remove(0);
        let found = compare(&made, &folder, true).unwrap().differing;
        assert!(found[0].contains("no figure makes it"), "{found:?}");
        made[0].0.data.push(DataFile { name: "new.csv".into(), ..data });
        let found = compare(&made, &folder, false).unwrap().differing;
        assert!(found[0].contains("new.csv: it has no digest"), "{found:?}");
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
