//! Basins over the plane of mass ratio and lift-off speed.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::raster::common_circles::CommonCircles;
use crate::raster::labels::labels_of_columns;
use basin_of_attraction::{Grid, Label, LabelImage, raster_by_strips};
use passive_hopper::{MassRatio, alpha_star};
use std::ops::{ControlFlow, Range};

/// The version of the labels of [`basin_raster`] and [`basin_columns`], and of the numbers of
/// [`hop_columns`](crate::hop_columns).
///
/// It is raised when a change of the libraries changes one of them in some window, so that finished parts of a
/// raster are not joined with parts from before the change. A test compares digests of some windows with those of
/// this version.
pub const RASTER_VERSION: u32 = 1;

/// The basins over a window of the (M, α) plane: M to the right, α upwards, labels as in [`HopperFate::label`].
///
/// The label of a pixel is the fate of its middle. The result does not depend on the number of threads.
///
/// # Errors
/// [`Error::Window`] if the window goes below zero, or contains fixed points without labels; errors of
/// [`MassRatio::new`] and of [`raster_by_strips`].
pub fn basin_raster(
    grid: Grid,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, Error> {
    check_speeds(&grid)?;
    let common = common_circles(&grid)?;
    let strip = |ratios: &[f64], speeds: &[f64]| strip(ratios, speeds, common.as_ref());
    raster_by_strips(grid, strip_width(&grid), strip, progress)
}

/// The largest number of columns in a strip. More columns would not make the vectors of a processor fuller.
const WIDEST_STRIP: usize = 16;

/// The largest number of pixels of a strip with more than one column: its orbits and tables, some 50 bytes a pixel,
/// then stay in a processor's second-level cache. Taller rasters have narrower strips.
const LARGEST_STRIP: usize = 16_384;

/// A raster has at least this many strips, if it has as many columns, so that many threads have work.
const FEWEST_STRIPS: usize = 16;

/// A raster of fewer columns has no common circles: a circle for many mass ratios takes as long as those of some
/// dozen columns.
const FEWEST_COLUMNS: usize = 32;

/// A taller raster has no common circles. Few of its orbits come near to one fixed point, and a window with M from
/// 0.2 to 0.20002 and speeds from 8 to 9 takes eight times as long with them.
const TALLEST: f64 = 0.01;

/// The number of columns whose orbits hop together. It affects the time only.
fn strip_width(grid: &Grid) -> usize {
    (LARGEST_STRIP / grid.rows.max(1)).min(grid.columns / FEWEST_STRIPS).clamp(1, WIDEST_STRIP)
}

/// The labels of some columns of a [`basin_raster`], from the lowest speed up, for rasters too large for memory. An
/// empty range gives an empty vector.
///
/// Sixteen neighbouring columns take less time together than one by one, because their orbits hop together.
///
/// ```
/// use basin_of_attraction::{Grid, Interval};
/// use hopper_basin::{basin_columns, basin_raster};
/// use std::ops::ControlFlow::Continue;
/// let (x, y) = (Interval::new(0.1, 1.0)?, Interval::new(4.5, 20.0)?);
/// let grid = Grid { x, y, columns: 100, rows: 50 };
/// let columns = basin_columns(&grid, 16..32)?;
/// let raster = basin_raster(grid, |_| Continue(()))?;
/// assert_eq!(Some(columns[3][20]), raster.at(16 + 3, 20));
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// As [`basin_raster`]; [`Error::ColumnRange`] if `columns` ends beyond the last column of the grid.
pub fn basin_columns(grid: &Grid, columns: Range<usize>) -> Result<Vec<Vec<Label>>, Error> {
    let (ratios, speeds) = places(grid, columns)?;
    let mut found = Vec::with_capacity(ratios.len());
    let common = common_circles(grid)?;
    for some in ratios.chunks(strip_width(grid)) {
        found.extend(strip(some, &speeds, common.as_ref())?);
    }
    Ok(found)
}

/// The mass ratios of some columns, and the speeds of all rows.
///
/// # Errors
/// As [`basin_columns`].
pub(crate) fn places(grid: &Grid, columns: Range<usize>) -> Result<(Vec<f64>, Vec<f64>), Error> {
    check_speeds(grid)?;
    grid.pixels()?;
    if columns.end > grid.columns {
        let (first, end) = (columns.start, columns.end);
        return Err(Error::ColumnRange { columns: grid.columns, first, end });
    }
    let ratios = columns.map(|column| grid.x_at(column)).collect();
    Ok((ratios, (0..grid.rows).map(|row| grid.y_at(row)).collect()))
}

/// The circles that all columns share; `None` for a raster that does not need them.
fn common_circles(grid: &Grid) -> Result<Option<CommonCircles>, Error> {
    if grid.columns < FEWEST_COLUMNS || grid.y.length() > TALLEST {
        return Ok(None);
    }
    CommonCircles::new(grid.x_at(0), grid.x_at(grid.columns - 1), grid.y.right)
}

/// The labels of `speeds` at every mass ratio, with circles that they share.
fn strip(
    ratios: &[f64],
    speeds: &[f64],
    common: Option<&CommonCircles>,
) -> Result<Vec<Vec<Label>>, Error> {
    let fates = |&m: &f64| Fates::new(MassRatio::new(m)?);
    let fates = ratios.iter().map(fates).collect::<Result<Vec<_>, Error>>()?;
    labels_of_columns(&fates.iter().collect::<Vec<_>>(), speeds, common)
}

/// Returns an error if speeds of `grid` are negative, or their fixed points have no labels.
fn check_speeds(grid: &Grid) -> Result<(), Error> {
    let largest = alpha_star(HopperFate::LARGEST_LABEL);
    if grid.y.left >= 0.0 && grid.y.right <= largest {
        return Ok(());
    }
    Err(Error::Window { bottom: grid.y.left, top: grid.y.right, largest })
}
