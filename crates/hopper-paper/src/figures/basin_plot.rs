//! Raster, legend, inset frame and files of the basin figures.

use crate::error::Error;
use crate::fate_colors;
use crate::figure::Figure;
use basin_of_attraction::{Grid, Interval, Label, LabelImage};
use hopper_basin::{HopperFate, basin_raster};
use journal_figures::{Anchor, DataFile, Frame, Pen, Svg, indexed_png, ticks};
use repository_tools::Progress;
use resumable_job::{Order, npy_header};
use std::ops::ControlFlow;

/// (M, α) ranges of the figure that enlarges a part, and its number.
pub(crate) type Inset = ((f64, f64), (f64, f64), &'static str);

/// A window of (M, α), with the name and the layout of its figure.
pub(crate) struct Window {
    pub(crate) name: &'static str,
    pub(crate) mass_ratio: (f64, f64),
    pub(crate) alpha: (f64, f64),
    pub(crate) inset: Option<Inset>,
    pub(crate) tick_counts: (usize, usize),
}

/// Pixels across and up: 2.4 for each point of the frame, about what a print resolves.
pub(crate) const PIXELS: usize = 1200;

/// Computes and draws a window.
pub(super) fn basin_figure(
    window: &Window,
    progress: &Progress,
    texts: (String, String, String),
) -> Result<Figure, Error> {
    let (x, y) = (window.mass_ratio, window.alpha);
    let grid = Grid {
        x: Interval::new(x.0, x.1)?,
        y: Interval::new(y.0, y.1)?,
        columns: PIXELS,
        rows: PIXELS,
    };
    let bar = progress.bar(window.name, PIXELS as u64);
    let image = basin_raster(grid, |done| {
        bar.set(done as u64);
        ControlFlow::Continue(())
    })?;
    bar.finish();
    let svg = draw_basins(window, &image)?;
    let (title, paper, notes) = texts;
    Ok(Figure {
        name: window.name,
        title,
        paper,
        notes: format!(
            "{notes} {PIXELS} × {PIXELS} pixels, each judged by its middle. {}",
            basin_fractions(&image)
        ),
        svg,
        data: vec![
            DataFile { name: format!("{}.npy", window.name), bytes: npy(&image) },
            DataFile {
                name: format!("{}_labels.png", window.name),
                bytes: png(window.name, &image)?,
            },
        ],
    })
}

/// The drawing of an image with axes and legend.
pub(crate) fn draw_basins(window: &Window, image: &LabelImage) -> Result<Svg, Error> {
    let pixels = png(window.name, image)?;
    Ok(draw_pixels(window, &pixels, image.counts().into_iter().map(|(label, _)| label)))
}

/// The drawing of the pixels of a window with axes and a legend.
pub(crate) fn draw_pixels(
    window: &Window,
    pixels: &[u8],
    labels: impl Iterator<Item = Label>,
) -> Svg {
    let (x, y) = (window.mass_ratio, window.alpha);
    let mut svg = Svg::new(580.0, 560.0);
    let frame = Frame::linear(66.0, 44.0, 490.0, 460.0, x, y);
    svg.image(frame.left, frame.top, frame.width, frame.height, pixels);
    frame.axes(
        &mut svg,
        &ticks(x, window.tick_counts.0),
        &ticks(y, window.tick_counts.1),
        "mass ratio $M$ = $m$_{2}/$m$_{1}",
        "lift-off speed $α$ (dimensionless)",
    );
    if let Some((m, alpha, name)) = window.inset {
        let (x0, y1) = frame.at((m.0, alpha.0));
        let (x1, y0) = frame.at((m.1, alpha.1));
        svg.rect(x0, y0, x1 - x0, y1 - y0, Pen::solid("#ffffff", 3.0));
        svg.rect(x0, y0, x1 - x0, y1 - y0, Pen::solid("#000000", 1.4));
        svg.fill_rect(x1 + 3.0, y1 - 16.0, 37.0, 15.0, "#ffffff");
        svg.text(x1 + 5.0, y1 - 5.0, Anchor::Start, 11.5, name);
    }
    legend(&mut svg, frame.left, labels);
    svg
}

/// The legend, with one entry for each colour: fixed points beyond the last colour share it. Returns where the next entry begins.
pub(crate) fn legend(svg: &mut Svg, left: f64, labels: impl Iterator<Item = Label>) -> f64 {
    let mut x = left;
    let mut last = "";
    for label in labels {
        let color = fate_colors::css(label);
        if color == last {
            continue;
        }
        last = color;
        svg.fill_rect(x, 18.0, 12.0, 12.0, color);
        svg.rect(x, 18.0, 12.0, 12.0, Pen::solid("#000", 0.6));
        svg.text(x + 17.0, 28.5, Anchor::Start, 11.5, &fate_colors::name(label));
        x += if HopperFate::is_incessant(label) { 58.0 } else { 84.0 };
    }
    x
}

/// The fraction of every label, in words.
fn basin_fractions(image: &LabelImage) -> String {
    let pixels = image.labels.len() as f64;
    let fraction = |(label, count): (Label, usize)| {
        format!("{} {:.2} %", fate_colors::name(label), 100.0 * count as f64 / pixels)
    };
    format!(
        "Basin fractions: {}.",
        image.counts().into_iter().map(fraction).collect::<Vec<_>>().join(", ")
    )
}

/// A PNG with one byte a pixel, the highest row first; its palette is in the order of the labels that occur.
fn png(name: &str, image: &LabelImage) -> Result<Vec<u8>, Error> {
    let mut colors: Vec<[u8; 3]> = Vec::new();
    let mut places = std::collections::BTreeMap::new();
    for (label, _) in image.counts() {
        let color = fate_colors::rgb(label);
        let known = colors.iter().position(|other| *other == color);
        places.insert(label, known.unwrap_or(colors.len()) as u8);
        if known.is_none() {
            colors.push(color);
        }
    }
    let rows = image.labels.chunks(image.grid.columns).rev();
    let pixels: Vec<u8> =
        rows.flatten().map(|label| places.get(label).copied().unwrap_or(0)).collect();
    Ok(indexed_png(name, image.grid.columns, image.grid.rows, &colors, &pixels)?)
}

/// The labels as a NumPy file; rows start from the lowest α.
fn npy(image: &LabelImage) -> Vec<u8> {
    let mut bytes = npy_header(Order::C, image.grid.rows, image.grid.columns);
    bytes.extend(image.labels.iter().flat_map(|label| label.code().to_le_bytes()));
    bytes
}
