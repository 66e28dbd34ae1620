//! Figures written into a folder.

use crate::error::Error;
use crate::figure::Figure;
use crate::figures::Build;
use crate::repository::{Folder, Progress};
use journal_figures::{Rendered, render};

/// Pixels of the PNG for a CSS pixel of the drawing (1/96 inch): 192 dpi. Text of 10 points is then sharp on a screen,
/// and no PNG exceeds a megabyte.
const PIXELS_PER_CSS_PIXEL: f64 = 2.0;

/// Builds a figure and writes it in both forms, with its data.
pub(super) fn make_figure(folder: &Folder, build: Build) -> Result<(Figure, Rendered), Error> {
    let figure = build(&Progress)?;
    let rendered = write_figure(folder, &figure)?;
    Ok((figure, rendered))
}

/// Writes a figure in both forms, with its data.
pub(super) fn write_figure(folder: &Folder, figure: &Figure) -> Result<Rendered, Error> {
    let rendered = render(figure.name, &figure.svg, PIXELS_PER_CSS_PIXEL)?;
    folder.write(&format!("{}.svg", figure.name), rendered.svg.as_bytes())?;
    folder.write(&format!("{}.png", figure.name), &rendered.png)?;
    figure.data.iter().try_for_each(|file| folder.write(&file.name, &file.bytes))?;
    Ok(rendered)
}
