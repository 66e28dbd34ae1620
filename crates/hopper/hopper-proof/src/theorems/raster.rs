//! The basins over a window of mass ratio and lift-off speed: every point of a raster, which is the middle of a pixel.

use crate::error::Error;
use crate::points::ProvedPoints;
use basin_of_attraction::{Grid, LabelImage, raster_by_strips};
use std::ops::ControlFlow;

/// The fate of every point of a raster that is proved; the others have the label
/// [`HopperFate::UNDECIDED_PRECISION`](hopper_basin::HopperFate::UNDECIDED_PRECISION). `progress` is as for
/// [`raster_by_strips`].
///
/// # Errors
/// Those of [`ProvedPoints`] and of [`raster_by_strips`].
pub fn proved_points(
    grid: Grid,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, Error> {
    let columns = |ratios: &[f64], speeds: &[f64]| {
        let column = |&ratio: &f64| {
            let mut points = ProvedPoints::new(ratio)?;
            speeds.iter().map(|&speed| points.label(speed)).collect()
        };
        ratios.iter().map(column).collect()
    };
    raster_by_strips(grid, 1, columns, progress)
}
