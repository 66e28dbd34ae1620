//! Figs. 8 and 9 with the shares of the basins in every pixel, in place of the fate of its middle.

use super::fig_06_to_09_basins::{window_8, window_9};
use crate::error::Error;
use crate::figure::Figure;
use crate::repository::Progress;
use basin_of_attraction::{Grid, Interval};
use hopper_basin::{CoverageLimits, coverage_raster};
use hopper_figures::{BasinWindow, coverage_png, draw_coverage, share_words};
use journal_figures::DataFile;
use journal_figures::{Element, Order, npy_header};
use std::ops::ControlFlow;

/// Pixels across and up: half as many as in the figures of single fates, because no pixel needs a neighbour to show
/// a needle. With more the figures take longer than all others together.
const PIXELS: usize = 600;

/// The part of a pixel that may stay undecided. Where a pixel has two basins, its colour errs by at most as much of
/// their difference.
const TOLERANCE: f64 = 0.1;

/// Fig. 8 with the shares of its pixels.
pub(super) fn figure_8(progress: &Progress) -> Result<Figure, Error> {
    figure(&window_8("fig_08_basin_coverage"), progress)
}

/// Fig. 9 with the shares of its pixels.
pub(super) fn figure_9(progress: &Progress) -> Result<Figure, Error> {
    figure(&window_9("fig_09_basin_coverage"), progress)
}

fn figure(window: &BasinWindow, progress: &Progress) -> Result<Figure, Error> {
    let (x, y) = (window.mass_ratio, window.alpha);
    let grid = Grid {
        x: Interval::new(x.0, x.1)?,
        y: Interval::new(y.0, y.1)?,
        columns: PIXELS,
        rows: PIXELS,
    };
    let bar = progress.bar(window.name, PIXELS as u64);
    let limits = CoverageLimits { tolerance: TOLERANCE, ..CoverageLimits::default() };
    let raster = coverage_raster(grid, limits, |done| {
        bar.set(done as u64);
        ControlFlow::Continue(())
    })?
    .shares;
    bar.finish();
    let mut data = vec![DataFile {
        name: format!("{}_pixels.png", window.name),
        bytes: coverage_png(window.name, &raster)?,
    }];
    for (at, label) in raster.labels().iter().enumerate() {
        let name = format!("{}_share_{}.npy", window.name, label.code());
        let mut bytes = npy_header(Order::C, Element::U16, PIXELS, PIXELS);
        bytes.extend(share_words(&raster, at));
        data.push(DataFile { name, bytes });
    }
    let decided: f64 = raster.means().iter().map(|(_, mean)| mean).sum();
    let undecided = format!("{:.2}", 100.0 * (1.0 - decided));
    let values = [("pixels", PIXELS.to_string()), ("undecided", undecided)];
    Figure::new(window.name, draw_coverage(window, &raster)?, data, &values)
}
