//! Numbers over a window of the plane, such as the number of steps to a trap.

use crate::error::Error;
use crate::space::interval::Interval;
use crate::space::raster::{Grid, columns_in_parallel};
use std::ops::ControlFlow;

/// Any values on a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct ValueImage<T> {
    /// The grid.
    pub grid: Grid,
    /// Row by row from below, each from left to right.
    pub values: Vec<T>,
}

impl<T> ValueImage<T> {
    /// The value of a pixel; `None` outside the image. Rows count from below.
    pub fn at(&self, column: usize, row: usize) -> Option<&T> {
        let inside = column < self.grid.columns && row < self.grid.rows;
        inside.then(|| self.values.get(row * self.grid.columns + column))?
    }
}

/// The values at the middles of all pixels, computed in parallel. `prepare` does the work that the pixels of a
/// column share; `progress` is as for [`raster`](crate::raster).
///
/// ```
/// use basin_of_attraction::{Fate, Grid, Interval, Label, TrapSet, classify, value_raster};
/// use std::ops::ControlFlow::Continue;
/// // Steps of x → c x to the trap [−0.1, 0.1], over c and x; `None` if the trap is not reached.
/// let traps = TrapSet::new(vec![(Interval::new(-0.1, 0.1)?, Label::from(1))])?;
/// let steps = |&c: &f64, x: f64| match classify(&|x: f64| Some(c * x), &traps, x, 1000) {
///     (Fate::Trapped(_), steps) => Some(steps),
///     _ => None,
/// };
/// let grid = Grid { x: Interval::new(0.0, 2.0)?, y: Interval::new(0.0, 1.0)?, columns: 4, rows: 2 };
/// let image = value_raster(grid, |c| c, steps, |_| Continue(()))?;
/// assert_eq!(image.values, [Some(1), Some(4), None, None, Some(2), Some(8), None, None]);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadRaster`] as for [`Grid::pixels`]; [`Error::BadInterval`] for a range that is reversed or not finite;
/// [`Error::Interrupted`] if `progress` stops the work.
pub fn value_raster<C, T: Send + Clone>(
    grid: Grid,
    prepare: impl Fn(f64) -> C + Sync,
    value: impl Fn(&C, f64) -> T + Sync,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<ValueImage<T>, Error> {
    for range in [grid.x, grid.y] {
        Interval::new(range.left, range.right)?;
    }
    let pixels = grid.pixels()?;
    let column = |at: usize| {
        let shared = prepare(grid.x_at(at));
        Ok((0..grid.rows).map(|row| value(&shared, grid.y_at(row))).collect::<Vec<T>>())
    };
    let columns = columns_in_parallel::<_, Error>(grid.columns, column, progress)?;
    let mut values = Vec::with_capacity(pixels);
    for row in 0..grid.rows {
        values.extend(columns.iter().filter_map(|column| column.get(row).cloned()));
    }
    Ok(ValueImage { grid, values })
}
