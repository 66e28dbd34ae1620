//! What the shares of a coverage raster stand on, and how much of it is undecided.

use crate::circle::share_raster::ShareRaster;
use crate::coverage::coverage_limits::{CoverageGround, CoverageLimits};
use crate::error::Error;
use passive_hopper::MassRatio;

/// What the shares of a coverage raster stand on, and how much of it is undecided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoverageSummary {
    /// The undecided share of the whole raster.
    pub mean_undecided: f64,
    /// The largest undecided share of a pixel.
    pub most_undecided: f64,
    /// The number of pixels whose undecided share is above the tolerance.
    pub above_tolerance: usize,
    /// The number of columns that stand on [`CoverageGround::Laps`], and miss no basin.
    pub columns_by_laps: usize,
    /// Of the other columns, the largest distance of two followed speeds; `None` if there are no others.
    pub spacing: Option<f64>,
}

/// Shares are stored in `f32`. A pixel is above the tolerance if it is by more than their rounding.
const ROUNDING: f64 = 1e-6;

impl CoverageSummary {
    /// Sums up a raster whose columns are [`CoverageColumn`](crate::CoverageColumn)s with these limits.
    ///
    /// ```
    /// use basin_of_attraction::{Grid, Interval};
    /// use hopper_basin::{CoverageColumn, CoverageLimits, CoverageSummary, ShareColumn, ShareRaster, Upwards};
    /// let (x, y) = (Interval::new(0.17, 0.18)?, Interval::new(17.0, 17.8)?);
    /// let (grid, limits) = (Grid { x, y, columns: 3, rows: 20 }, CoverageLimits::default());
    /// let column = |at| Ok(Some(ShareColumn::from(&CoverageColumn::of_grid(&grid, at, limits)?)));
    /// let columns = (0..3).map(column).collect::<Result<_, hopper_basin::Error>>()?;
    /// let raster = ShareRaster::from_columns(grid, Upwards::LiftOffSpeed, columns)?;
    /// let found = CoverageSummary::new(&raster, limits)?;
    /// assert_eq!((found.columns_by_laps, found.spacing, found.above_tolerance), (3, None, 0));
    /// assert!(found.mean_undecided <= found.most_undecided && found.most_undecided < 0.051);
    /// # Ok::<(), hopper_basin::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`CoverageGround::of`].
    pub fn new(raster: &ShareRaster, limits: CoverageLimits) -> Result<Self, Error> {
        let grid = raster.grid();
        let (mut columns_by_laps, mut spacing) = (0, None);
        for at in 0..grid.columns {
            match CoverageGround::of(MassRatio::new(grid.x_at(at))?, grid.y, grid.rows, limits)? {
                CoverageGround::Laps => columns_by_laps += 1,
                CoverageGround::Spacing { speeds } => spacing = Some(speeds),
            }
        }
        let (mut sum, mut most_undecided, mut above_tolerance) = (0.0, 0.0, 0);
        for row in 0..grid.rows {
            for column in 0..grid.columns {
                let open = raster.undecided(column, row);
                sum += open;
                most_undecided = f64::max(most_undecided, open);
                above_tolerance += usize::from(open > limits.tolerance + ROUNDING);
            }
        }
        let mean_undecided = sum / (grid.columns * grid.rows) as f64;
        Ok(CoverageSummary {
            mean_undecided,
            most_undecided,
            above_tolerance,
            columns_by_laps,
            spacing,
        })
    }
}
