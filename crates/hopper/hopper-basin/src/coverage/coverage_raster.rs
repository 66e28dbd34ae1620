//! Rasters over mass ratio and lift-off speed whose pixels have the shares of the basins.

use crate::circle::share_column::ShareColumn;
use crate::circle::share_raster::ShareRaster;
use crate::circle::upwards::Upwards;
use crate::coverage::coverage_column::CoverageColumn;
use crate::coverage::coverage_limits::{CoverageGround, CoverageLimits};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use basin_of_attraction::{Grid, columns_in_parallel};
use passive_hopper::MassRatio;
use std::ops::ControlFlow;

/// A raster of shares, with what each of its columns stands on.
#[derive(Debug, Clone, PartialEq)]
pub struct CoverageRaster {
    /// The certain shares; what is missing to 1 is undecided.
    pub shares: ShareRaster,
    /// One for every column.
    pub grounds: Vec<CoverageGround>,
}

/// The share of every basin in the pixels of a window of the (M, α) plane: M to the right, α upwards, labels as in
/// [`HopperFate::label`](crate::HopperFate::label).
///
/// A pixel has the shares of all its speeds at the mass ratio of its column's middle. So a basin that is lower than
/// a pixel makes a faint line without gaps, where [`basin_raster`](crate::basin_raster) shows dashes.
///
/// `progress` is called with the number of finished columns, and may stop the work. The result does not depend on
/// the number of threads.
///
/// ```
/// use basin_of_attraction::{Grid, Interval};
/// use hopper_basin::{CoverageLimits, coverage_raster};
/// use std::ops::ControlFlow::Continue;
/// let (x, y) = (Interval::new(0.17, 0.18)?, Interval::new(17.0, 17.8)?);
/// let grid = Grid { x, y, columns: 2, rows: 50 };
/// let raster = coverage_raster(grid, CoverageLimits::default(), |_| Continue(()))?;
/// let certain: f32 = raster.shares.at(0, 20).unwrap_or_default().iter().sum();
/// assert!(certain >= 0.95);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// Those of [`CoverageColumn::new`] and [`MassRatio::new`]; [`Error::BasinOfAttraction`] for an empty grid, and if
/// `progress` stops the work.
pub fn coverage_raster(
    grid: Grid,
    limits: CoverageLimits,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<CoverageRaster, Error> {
    grid.pixels()?;
    let column = |at: usize| {
        let own = CoverageColumn::of_grid(&grid, at, limits)?;
        Ok::<_, Error>((Some(ShareColumn::from(&own)), own.ground()))
    };
    let found = columns_in_parallel(grid.columns, column, progress)?;
    let (columns, grounds) = found.into_iter().unzip();
    let shares = ShareRaster::from_columns(grid, Upwards::LiftOffSpeed, columns)?;
    Ok(CoverageRaster { shares, grounds })
}

impl CoverageColumn {
    /// Column `at` of a [`coverage_raster`], for rasters that are computed in parts.
    ///
    /// # Errors
    /// As [`coverage_raster`].
    pub fn of_grid(grid: &Grid, at: usize, limits: CoverageLimits) -> Result<Self, Error> {
        let fates = Fates::new(MassRatio::new(grid.x_at(at))?)?;
        CoverageColumn::new(&fates, grid.y, grid.rows, limits)
    }
}
