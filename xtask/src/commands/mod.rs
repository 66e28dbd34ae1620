//! The commands, one file each.

pub mod basin_raster;
pub mod beyond_paper;
pub mod check_reference;
pub mod compare_peers;
pub mod model_figures;
pub mod reproduce_paper;
pub mod speed;
pub mod tidy;
pub mod verify_invariance;
pub mod work_precision;

use crate::Error;
use crate::claims::{Claim, Verdict};
use crate::figures::{Build, Figure};
use crate::output::{Folder, repository};
use crate::plot::label::html;
use crate::plot::render::{Rendered, render};
use crate::progress::Progress;
use std::path::Path;

/// The folder for results: the one asked for, or target/paper in the repository.
fn results_folder(out: Option<&Path>) -> Result<Folder, Error> {
    results_folder_named(out, "paper")
}

/// The folder for results: the one asked for, or one in target in the repository.
fn results_folder_named(out: Option<&Path>, name: &str) -> Result<Folder, Error> {
    let default = || Folder::open(&repository().join("target").join(name));
    out.map_or_else(default, Folder::open)
}

/// Builds a figure and writes it in both forms, with its data.
fn make_figure(folder: &Folder, build: Build) -> Result<(Figure, Rendered), Error> {
    let figure = build(&Progress)?;
    let rendered = write_figure(folder, &figure)?;
    Ok((figure, rendered))
}

/// Writes a figure in both forms, with its data.
fn write_figure(folder: &Folder, figure: &Figure) -> Result<Rendered, Error> {
    let rendered = render(figure.name, &figure.svg, 2.0)?;
    folder.write(&format!("{}.svg", figure.name), rendered.svg.as_bytes())?;
    folder.write(&format!("{}.png", figure.name), &rendered.png)?;
    figure.data.iter().try_for_each(|file| folder.write(&file.name, &file.bytes))?;
    Ok(rendered)
}

/// A claim on a line of the terminal, without markup.
fn line(claim: &Claim) -> String {
    let word = match claim.verdict {
        Verdict::Confirmed => "confirmed",
        Verdict::Corrected => "corrected",
        Verdict::Fails => "FAILS    ",
    };
    format!("{word}  {:38} {}", plain(&claim.name), plain(&claim.error))
}

/// Markup as plain text.
fn plain(markup: &str) -> String {
    let mut text = String::new();
    let mut inside = false;
    for c in html(markup).chars() {
        match c {
            '<' => inside = true,
            '>' => inside = false,
            c if !inside => text.push(c),
            _ => {}
        }
    }
    text.replace("&lt;", "<").replace("&gt;", ">").replace("&quot;", "\"").replace("&amp;", "&")
}

/// An error if a claim fails.
fn all_hold(claims: &[Claim]) -> Result<(), Error> {
    match claims.iter().filter(|claim| claim.verdict == Verdict::Fails).count() {
        0 => Ok(()),
        count => Err(Error::CheckFailed(format!("{count} claims fail"))),
    }
}
