//! The rasters of the basin figures, and their files.

use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use basin_of_attraction::{Grid, Interval, Label, LabelImage};
use hopper_basin::basin_raster;
use hopper_figures::{BasinWindow, PIXELS, draw_basins, fate_colors, label_png};
use journal_figures::DataFile;
use journal_figures::{Element, Order, npy_header};
use std::ops::ControlFlow;

/// Computes and draws a window.
pub(super) fn basin_figure(window: &BasinWindow, progress: &Progress) -> Result<Figure, Error> {
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
    let pixels = DataFile { name: format!("{}.npy", window.name), bytes: npy(&image) };
    let name = format!("{}_labels.png", window.name);
    let labels = DataFile { name, bytes: label_png(window.name, &image)? };
    let values = [("pixels", PIXELS.to_string()), ("fractions", basin_fractions(&image))];
    Figure::new(window.name, svg, vec![pixels, labels], &values)
}

/// The fraction of every label, in words.
fn basin_fractions(image: &LabelImage) -> String {
    let pixels = image.labels.len() as f64;
    let fraction = |(label, count): (Label, usize)| {
        format!("{} {:.2} %", fate_colors::name(label), 100.0 * count as f64 / pixels)
    };
    image.counts().into_iter().map(fraction).collect::<Vec<_>>().join(", ")
}

/// The labels as a NumPy file; rows start from the lowest α.
fn npy(image: &LabelImage) -> Vec<u8> {
    let mut bytes = npy_header(Order::C, Element::U16, image.grid.rows, image.grid.columns);
    bytes.extend(image.labels.iter().flat_map(|label| label.code().to_le_bytes()));
    bytes
}
