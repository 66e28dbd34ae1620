//! Rasters of shares: left of α*_n, over mass ratio and phase or over mass ratio and distance; and about an edge.

use crate::circle::circle_limits::CircleLimits;
use crate::circle::share_column::ShareColumn;
use crate::circle::upwards::Upwards;
use crate::error::Error;
use basin_of_attraction::{Grid, Label, columns_in_parallel};
use std::ops::ControlFlow;

/// The share of every fate in each pixel of a raster.
#[derive(Debug, Clone, PartialEq)]
pub struct ShareRaster {
    grid: Grid,
    upwards: Upwards,
    /// In increasing order.
    labels: Vec<Label>,
    /// Row by row from below, each from left to right; one number for every label.
    shares: Vec<f32>,
    /// The columns without shares.
    blank: Vec<bool>,
}

impl ShareRaster {
    /// A raster of columns, from left to right. `None` is a blank column: there is no edge at its mass ratio.
    ///
    /// # Errors
    /// [`Error::BasinOfAttraction`] unless there are as many columns as the grid has, each with the shares of all rows.
    pub fn from_columns(
        grid: Grid,
        upwards: Upwards,
        columns: Vec<Option<ShareColumn>>,
    ) -> Result<Self, Error> {
        let pixels = grid.pixels()?;
        let whole = |own: &ShareColumn| own.shares.len() == grid.rows * own.labels.len();
        if columns.len() != grid.columns || !columns.iter().flatten().all(whole) {
            let (columns, rows) = (columns.len(), grid.rows);
            return Err(basin_of_attraction::Error::BadRaster { columns, rows }.into());
        }
        let all = columns.iter().flatten();
        let mut labels: Vec<Label> = all.flat_map(|column| column.labels.clone()).collect();
        labels.sort_unstable();
        labels.dedup();
        let mut shares = vec![0.0; pixels * labels.len()];
        for (x, column) in columns.iter().enumerate() {
            let Some(column) = column else { continue };
            for (at, label) in column.labels.iter().enumerate() {
                let Ok(place) = labels.binary_search(label) else { continue };
                for row in 0..grid.rows {
                    let pixel = row * grid.columns + x;
                    shares[pixel * labels.len() + place] =
                        column.shares[row * column.labels.len() + at];
                }
            }
        }
        let blank = columns.iter().map(Option::is_none).collect();
        Ok(ShareRaster { grid, upwards, labels, shares, blank })
    }

    /// True for a column without an edge, and for one outside the raster.
    pub fn is_blank(&self, column: usize) -> bool {
        self.blank.get(column).copied().unwrap_or(true)
    }

    /// The grid.
    pub fn grid(&self) -> Grid {
        self.grid
    }

    /// The meaning of its vertical axis.
    pub fn upwards(&self) -> Upwards {
        self.upwards
    }

    /// The labels that occur, in increasing order.
    pub fn labels(&self) -> &[Label] {
        &self.labels
    }

    /// The certain shares of a pixel, one for every [label](Self::labels); their sum is less than 1 by the
    /// undecided share. `None` outside the raster. Rows count from below.
    pub fn at(&self, column: usize, row: usize) -> Option<&[f32]> {
        let count = self.labels.len();
        let first = (row * self.grid.columns + column) * count;
        let inside = column < self.grid.columns && row < self.grid.rows;
        inside.then(|| self.shares.get(first..first + count))?
    }

    /// The share of a pixel that no label has; 1 for a blank column and outside the raster.
    pub fn undecided(&self, column: usize, row: usize) -> f64 {
        let shares = self.at(column, row).unwrap_or_default();
        1.0 - shares.iter().map(|&share| f64::from(share)).sum::<f64>()
    }

    /// The mean share of every label over the columns that are not blank.
    pub fn means(&self) -> Vec<(Label, f64)> {
        let count = self.labels.len();
        let columns = self.blank.iter().filter(|blank| !**blank).count();
        let pixels = (columns * self.grid.rows).max(1) as f64;
        let mean = |at: usize| {
            let shares = self.shares.iter().skip(at).step_by(count);
            shares.map(|&share| f64::from(share)).sum::<f64>() / pixels
        };
        self.labels.iter().enumerate().map(|(at, &label)| (label, mean(at))).collect()
    }
}

/// The shares left of α*_n: M to the right; upwards the phase, or the depth.
///
/// A pixel has the shares of all phases that it covers, so that no structure between its middle and its edges is
/// missed. In a column the circle is that of its middle. The phases at an offset move with M, by the leading order
/// 1/(A |δ|^{1/3}) of Ψ; with [`Upwards::Depth`] a pixel covers the phases of its whole width. Offsets beyond the
/// [domain](crate::PhaseBasins::domain) are undecided; it begins some tenths below α*_n.
///
/// `progress` is called with the number of finished columns, and may stop the work. The result does not depend on
/// the number of threads. A column takes as long as [`PhaseBasins::new`](crate::PhaseBasins::new).
///
/// ```
/// use basin_of_attraction::{Grid, Interval};
/// use hopper_basin::{CircleLimits, HopperFate, Upwards, share_raster};
/// use std::ops::ControlFlow::Continue;
/// // From 10⁻² to 10⁻³⁰⁰ below α*_1, all speeds decay at small M.
/// let (x, y) = (Interval::new(0.1, 0.3)?, Interval::new(2.0, 300.0)?);
/// let grid = Grid { x, y, columns: 2, rows: 50 };
/// let raster = share_raster(1, grid, Upwards::Depth, CircleLimits::default(), |_| Continue(()))?;
/// assert_eq!(raster.labels(), [HopperFate::Decaying.label()]);
/// assert!(raster.means()[0].1 > 0.999_999);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// Those of [`PhaseBasins::new`](crate::PhaseBasins::new), [`MassRatio::new`](passive_hopper::MassRatio::new) and
/// [`Offset::new`](hopper_asymptotics::Offset::new); [`Error::BasinOfAttraction`] for an empty grid, and if
/// `progress` stops the work.
pub fn share_raster(
    n: u64,
    grid: Grid,
    upwards: Upwards,
    limits: CircleLimits,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<ShareRaster, Error> {
    grid.pixels()?;
    let column = |at: usize| ShareColumn::left_of(n, &grid, upwards, limits, at).map(Some);
    let columns = columns_in_parallel(grid.columns, column, progress)?;
    ShareRaster::from_columns(grid, upwards, columns)
}
