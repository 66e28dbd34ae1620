//! The number of hops until the fate is known, over the plane of mass ratio and lift-off speed.

use crate::basins::rasters::places;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::{Fates, HOP_BUDGET};
use basin_of_attraction::Grid;
use passive_hopper::MassRatio;
use std::ops::Range;

/// The numbers of hops of some columns of a raster, from the lowest speed up: for each pixel, the hops from its
/// middle until the orbit is in a trap or grounded, as [`Fates::fate_within`] counts them. An undecided orbit has
/// the number of hops after which it was given up; [`basin_columns`](crate::basin_columns) says which orbits these
/// are.
///
/// Orbits with one fate and one itinerary can enter the trap after different numbers of hops. Each pixel is
/// therefore followed alone, which takes more time than its label.
///
/// ```
/// use basin_of_attraction::{Grid, Interval};
/// use hopper_basin::hop_columns;
/// let (x, y) = (Interval::new(0.19, 0.21)?, Interval::new(4.54, 4.56)?);
/// // α = 4.55 at M = 0.2 is in the trap of α*_1 = 4.49….
/// let grid = Grid { x, y, columns: 1, rows: 1 };
/// assert_eq!(hop_columns(&grid, 0..1)?, [[0]]);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// As [`basin_columns`](crate::basin_columns).
pub fn hop_columns(grid: &Grid, columns: Range<usize>) -> Result<Vec<Vec<u64>>, Error> {
    let (ratios, speeds) = places(grid, columns)?;
    let column = |m: f64| Fates::new(MassRatio::new(m)?)?.hop_counts(&speeds);
    ratios.into_iter().map(column).collect()
}

impl Fates {
    /// The numbers of hops of these speeds, as in [`hop_columns`].
    ///
    /// # Errors
    /// As [`Fates::fates_within`].
    pub fn hop_counts(&self, speeds: &[f64]) -> Result<Vec<u64>, Error> {
        let found = self.fates_within(speeds, HOP_BUDGET)?;
        Ok(found.into_iter().map(|(_, hops)| hops as u64).collect())
    }
}
