//! The CPU time of every tile of a raster.

use super::cpu_time::thread_seconds;
use crate::error::Error;
use basin_of_attraction::{Grid, Interval};
use hopper_basin::{basin_columns, first_humps};
use journal_figures::{Element, Order, npy_header};
use pxfm::{f_exp2, f_log2};
use rayon::prelude::*;

/// Columns of a tile, as in `hopper basins`.
pub(crate) const TILE: usize = 16;

/// What a raster cost.
#[derive(Debug, Clone)]
pub(crate) struct Raster {
    /// Pixels along each side.
    pub(crate) side: usize,
    /// CPU seconds of every tile, from the smallest M on.
    pub(crate) tiles: Vec<f64>,
    /// Bytes of the labels as `.npy`.
    pub(crate) bytes: usize,
}

impl Raster {
    /// CPU seconds of all tiles.
    pub(crate) fn seconds(&self) -> f64 {
        self.tiles.iter().sum()
    }

    /// CPU seconds of the longest tile.
    pub(crate) fn longest(&self) -> f64 {
        self.tiles.iter().copied().fold(0.0, f64::max)
    }
}

/// Computes the raster of Fig. 6 from M = 0.1 on with side² pixels, and drops its labels. A tile is the work of one
/// thread.
pub(crate) fn measure(side: usize) -> Result<Raster, Error> {
    let humps = first_humps(5);
    let (x, y) = (Interval::new(0.1, 1.0)?, Interval::new(humps.left, humps.right)?);
    let grid = Grid { x, y, columns: side, rows: side };
    let header = npy_header(Order::Fortran, Element::U16, side, side).len();
    let tile = |tile: usize| {
        let columns = tile * TILE..side.min((tile + 1) * TILE);
        let begin = thread_seconds()?;
        let labels = basin_columns(&grid, columns)?;
        let seconds = thread_seconds()? - begin;
        let bytes = labels.iter().map(|column| 2 * column.len()).sum::<usize>();
        Ok::<_, Error>((seconds, bytes))
    };
    let found: Vec<_> =
        (0..side.div_ceil(TILE)).into_par_iter().map(tile).collect::<Result<_, _>>()?;
    let (tiles, bytes): (Vec<f64>, Vec<usize>) = found.into_iter().unzip();
    Ok(Raster { side, tiles, bytes: header + bytes.iter().sum::<usize>() })
}

/// The factor of the CPU time for one doubling of the side: 2 to the slope of the least-squares line through (log
/// side, log time). None for fewer than two sizes, or if a time is zero.
pub(crate) fn growth_per_doubling(points: &[(usize, f64)]) -> Option<f64> {
    let logs = || points.iter().map(|&(side, time)| (f_log2(side as f64), f_log2(time)));
    let count = points.len() as f64;
    let (x, y) = logs().fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
    let spread: f64 = logs().map(|p| (p.0 - x) * (p.0 - x)).sum();
    let slope = logs().map(|p| (p.0 - x) * (p.1 - y)).sum::<f64>() / spread;
    slope.is_finite().then(|| f_exp2(slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_has_its_growth() {
        let points = [(256, 1.0), (512, 3.0), (1024, 9.0), (4096, 81.0)];
        assert!((growth_per_doubling(&points).unwrap() - 3.0).abs() < 1e-12);
        assert_eq!(growth_per_doubling(&points[..1]), None);
        assert_eq!(growth_per_doubling(&[(256, 0.0), (512, 1.0)]), None);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn every_tile_of_a_raster_is_measured() {
        let raster = measure(40).unwrap();
        assert_eq!(raster.tiles.len(), 3);
        assert_eq!(raster.bytes, 128 + 2 * 40 * 40);
        assert!(raster.seconds() >= raster.longest());
    }
}
