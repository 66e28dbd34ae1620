//! The drawing of a coverage raster: every pixel has the colours of its basins, mixed by their shares.

use crate::basins::{BasinWindow, draw_pixels};
use crate::error::Error;
use crate::fate_colors::mixed;
use basin_of_attraction::Label;
use hopper_basin::{HopperFate, ShareRaster};
use journal_figures::{Svg, rgb_png};

/// The undecided part of a pixel up to which it takes the mixture of its decided part. A larger part is yellow: it
/// is seen that something is not known. At this part the colour of a pixel of two basins errs by an eighth of their
/// difference at most.
const SHARED_OUT: f64 = 0.125;

/// The drawing of a window with axes and legend.
///
/// # Errors
/// As [`coverage_png`].
pub fn draw_coverage(window: &BasinWindow, raster: &ShareRaster) -> Result<Svg, Error> {
    let pixels = coverage_png(window.name, raster)?;
    let grid = raster.grid();
    let all = (0..grid.rows).flat_map(|row| (0..grid.columns).map(move |column| (column, row)));
    let open = all.filter(|&(column, row)| raster.undecided(column, row) > SHARED_OUT).count();
    let yellow = (open > 0).then_some(HopperFate::UNDECIDED);
    Ok(draw_pixels(window, &pixels, raster.labels().iter().copied().chain(yellow)))
}

/// The pixels as a PNG, the highest row first.
///
/// # Errors
/// [`Error::Figure`] for a raster without pixels.
pub fn coverage_png(name: &str, raster: &ShareRaster) -> Result<Vec<u8>, Error> {
    let grid = raster.grid();
    Ok(rgb_png(name, grid.columns, grid.rows, &coverage_pixels(raster))?)
}

/// Red, green and blue of every pixel, the highest row first. A small undecided part takes the mixture of the
/// decided part; a larger one is yellow.
pub(crate) fn coverage_pixels(raster: &ShareRaster) -> Vec<u8> {
    let grid = raster.grid();
    let mut pixels = Vec::with_capacity(3 * grid.columns * grid.rows);
    for row in (0..grid.rows).rev() {
        for column in 0..grid.columns {
            let decided = 1.0 - raster.undecided(column, row);
            let whole = if decided >= 1.0 - SHARED_OUT { decided } else { 1.0 };
            let shares = raster.at(column, row).unwrap_or_default();
            let parts = raster.labels().iter().zip(shares);
            let part = |(&label, &share): (&Label, &f32)| (label, f64::from(share) / whole);
            pixels.extend(mixed(parts.map(part)));
        }
    }
    pixels
}
