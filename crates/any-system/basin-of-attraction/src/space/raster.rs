//! Label images over a window of the plane, computed in parallel, column by column.

use crate::error::Error;
use crate::space::interval::Interval;
use crate::space::label::Label;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// A window of the plane, divided into pixels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// Horizontal range. A parameter of the map belongs here, because the pixels of a column can share work.
    pub x: Interval,
    /// Vertical range.
    pub y: Interval,
    /// Number of pixels across.
    pub columns: usize,
    /// Number of pixels up.
    pub rows: usize,
}

/// The largest number of pixels of a raster: 32 GiB of labels. More would fail to be allocated on most machines.
const MOST_PIXELS: u64 = 1 << 34;

impl Grid {
    /// The grid whose first and last pixels have their middles at the ends of the ranges, as in programs that
    /// sample a range with both of its ends. The middles are right to some ulps of the range.
    ///
    /// ```
    /// use basin_of_attraction::{Grid, Interval};
    /// let range = Interval::new(-2.0, 2.0)?;
    /// let grid = Grid::with_ends(range, range, 5, 3)?;
    /// assert_eq!([0, 1, 4].map(|column| grid.x_at(column)), [-2.0, -1.0, 2.0]);
    /// assert_eq!([0, 1, 2].map(|row| grid.y_at(row)), [-2.0, 0.0, 2.0]);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadRaster`] for fewer than two columns or rows; [`Error::BadInterval`] if a range is infinite, or
    /// reversed.
    pub fn with_ends(x: Interval, y: Interval, columns: usize, rows: usize) -> Result<Grid, Error> {
        if columns < 2 || rows < 2 {
            return Err(Error::BadRaster { columns, rows });
        }
        // The middle of pixel k of n is at (k + ½)/n of the range. The range grows by half a pixel on either side.
        let range = |of: Interval, pixels: usize| {
            let half = 0.5 * of.length() / (pixels - 1) as f64;
            Interval::new(of.left - half, of.right + half)
        };
        Ok(Grid { x: range(x, columns)?, y: range(y, rows)?, columns, rows })
    }

    /// The number of pixels.
    ///
    /// # Errors
    /// [`Error::BadRaster`] for no pixels, and for more than 2³⁴.
    pub fn pixels(&self) -> Result<usize, Error> {
        let Grid { columns, rows, .. } = *self;
        let pixels = columns.checked_mul(rows).filter(|&pixels| pixels > 0);
        let accepted = pixels.filter(|&pixels| pixels as u64 <= MOST_PIXELS);
        accepted.ok_or(Error::BadRaster { columns, rows })
    }

    /// x at the middle of a column.
    pub fn x_at(&self, column: usize) -> f64 {
        self.x.left + self.x.length() * ((column as f64 + 0.5) / self.columns as f64)
    }

    /// y at the middle of a row, counted from below.
    pub fn y_at(&self, row: usize) -> f64 {
        self.y.left + self.y.length() * ((row as f64 + 0.5) / self.rows as f64)
    }
}

/// Labels on a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct LabelImage {
    /// The grid.
    pub grid: Grid,
    /// Row by row from below, each from left to right.
    pub labels: Vec<Label>,
}

impl LabelImage {
    /// Returns an error unless the image has one label for each pixel, and at least one pixel.
    ///
    /// # Errors
    /// [`Error::BadImage`].
    pub fn check(&self) -> Result<(), Error> {
        let (Grid { columns, rows, .. }, labels) = (self.grid, self.labels.len());
        if labels > 0 && columns.checked_mul(rows) == Some(labels) {
            return Ok(());
        }
        Err(Error::BadImage { labels, columns, rows })
    }

    /// The same image with a region of interest: pixels whose middle (x, y) is not `inside` become [`Label::OUTSIDE`].
    ///
    /// # Errors
    /// [`Error::BadImage`] as for [`check`](Self::check).
    pub fn masked(mut self, inside: impl Fn(f64, f64) -> bool) -> Result<LabelImage, Error> {
        self.check()?;
        let grid = self.grid;
        for (at, label) in self.labels.iter_mut().enumerate() {
            if !inside(grid.x_at(at % grid.columns), grid.y_at(at / grid.columns)) {
                *label = Label::OUTSIDE;
            }
        }
        Ok(self)
    }

    /// The label of a pixel; `None` outside the image. Rows count from below.
    pub fn at(&self, column: usize, row: usize) -> Option<Label> {
        let inside = column < self.grid.columns && row < self.grid.rows;
        inside.then(|| self.labels.get(row * self.grid.columns + column).copied())?
    }

    /// The number of pixels of each label, in increasing order of labels.
    pub fn counts(&self) -> Vec<(Label, usize)> {
        let mut counts = std::collections::BTreeMap::new();
        for &label in &self.labels {
            *counts.entry(label).or_insert(0) += 1;
        }
        counts.into_iter().collect()
    }
}

/// Labels every pixel of `grid` by its middle. Columns are computed in parallel, each pixel by pixel.
///
/// `prepare` does the work that the pixels of a column share. `label` labels a point of the column. `progress` is
/// called with the number of finished columns, and may stop the work. The image does not depend on the number of
/// threads.
///
/// ```
/// use basin_of_attraction::{Grid, Interval, Label, raster};
/// use std::ops::ControlFlow::Continue;
/// let unit = Interval::new(0.0, 1.0)?;
/// let grid = Grid { x: unit, y: unit, columns: 4, rows: 4 };
/// let image = raster(grid, |x| x, |&x, y| Label::from(y > x), |_| Continue(()))?;
/// assert_eq!(image.counts(), [(Label::from(0), 10), (Label::from(1), 6)]);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadRaster`] as for [`Grid::pixels`]; [`Error::BadInterval`] for a range that is reversed or not finite;
/// [`Error::Interrupted`] if `progress` stops the work.
pub fn raster<C>(
    grid: Grid,
    prepare: impl Fn(f64) -> C + Sync,
    label: impl Fn(&C, f64) -> Label + Sync,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, Error> {
    let column = |&x: &f64, ys: &[f64]| {
        let shared = prepare(x);
        ys.iter().map(|&y| label(&shared, y)).collect()
    };
    let strip = |xs: &[f64], ys: &[f64]| Ok(xs.iter().map(|x| column(x, ys)).collect());
    raster_by_strips(grid, 1, strip, progress)
}

/// Rows of the image that are filled together: 32 labels of two bytes are one cache line of 64 bytes. With fewer rows
/// each line of a column would be read several times. With more rows the code is not faster.
const BAND: usize = 32;

/// Labels every pixel of `grid` by its middle. Strips of `width` neighbouring columns are computed in parallel.
///
/// `strip` receives the x of neighbouring columns and all y of the grid, both in increasing order. It returns the
/// labels of every column, from the lowest y up. This form is for maps that label many points together faster than one
/// by one. `progress` is as for [`raster`].
///
/// ```
/// use basin_of_attraction::{Error, Grid, Interval, Label, raster_by_strips};
/// use std::ops::ControlFlow::Continue;
/// let unit = Interval::new(0.0, 1.0)?;
/// let grid = Grid { x: unit, y: unit, columns: 4, rows: 4 };
/// let column = |x: f64, ys: &[f64]| ys.iter().map(|&y| Label::from(y > x)).collect();
/// let strip = |xs: &[f64], ys: &[f64]| Ok(xs.iter().map(|&x| column(x, ys)).collect());
/// let image = raster_by_strips::<Error>(grid, 2, strip, |_| Continue(()))?;
/// assert_eq!(image.counts(), [(Label::from(0), 10), (Label::from(1), 6)]);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// As [`raster`]; [`Error::BadStrip`] if `strip` gives another number of columns or of labels; errors of `strip`.
pub fn raster_by_strips<E: From<Error> + Send>(
    grid: Grid,
    width: usize,
    strip: impl Fn(&[f64], &[f64]) -> Result<Vec<Vec<Label>>, E> + Sync,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, E> {
    let Grid { columns, rows, .. } = grid;
    for range in [grid.x, grid.y] {
        Interval::new(range.left, range.right)?;
    }
    let pixels = grid.pixels()?;
    let ys: Vec<f64> = (0..rows).map(|row| grid.y_at(row)).collect();
    let xs: Vec<f64> = (0..columns).map(|column| grid.x_at(column)).collect();
    let width = width.max(1);
    let strips = columns.div_ceil(width);
    let labelled = |at: usize| {
        let xs = &xs[at * width..columns.min((at + 1) * width)];
        let labels = strip(xs, &ys)?;
        if labels.len() != xs.len() || labels.iter().any(|column| column.len() != rows) {
            let found = labels.iter().map(Vec::len).sum();
            return Err(E::from(Error::BadStrip { found, columns: xs.len(), rows }));
        }
        Ok(labels)
    };
    let finished = AtomicUsize::new(0);
    let count = |labels: &Vec<Vec<Label>>| {
        progress(finished.fetch_add(labels.len(), Ordering::Relaxed) + labels.len())
    };
    let Some(by_strip) = in_parallel(strips, labelled, count)? else {
        return Err(Error::Interrupted { finished: finished.into_inner(), parts: columns }.into());
    };
    let by_column: Vec<Vec<Label>> = by_strip.into_iter().flatten().collect();
    let mut labels = vec![Label::OUTSIDE; pixels];
    // The columns are transposed into rows, band by band, so that every cache line of a column is read once.
    labels.par_chunks_mut(BAND * columns).enumerate().for_each(|(band, lines)| {
        for (at, column) in by_column.iter().enumerate() {
            let places = lines.iter_mut().skip(at).step_by(columns);
            for (place, &label) in places.zip(&column[band * BAND..]) {
                *place = label;
            }
        }
    });
    Ok(LabelImage { grid, labels })
}

/// One value of any type for each column of a raster, in order, computed in parallel. `progress` is as for [`raster`].
///
/// ```
/// use basin_of_attraction::{Error, columns_in_parallel};
/// use std::ops::ControlFlow::Continue;
/// let squares = columns_in_parallel::<_, Error>(4, |column| Ok(column * column), |_| Continue(()))?;
/// assert_eq!(squares, [0, 1, 4, 9]);
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// Those of `column`; [`Error::Interrupted`] if `progress` stops the work.
pub fn columns_in_parallel<T: Send, E: From<Error> + Send>(
    columns: usize,
    column: impl Fn(usize) -> Result<T, E> + Sync,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<Vec<T>, E> {
    let finished = AtomicUsize::new(0);
    let count = |_: &T| progress(finished.fetch_add(1, Ordering::Relaxed) + 1);
    let found = in_parallel(columns, column, count)?;
    let finished = || finished.load(Ordering::Relaxed);
    found.ok_or_else(|| Error::Interrupted { finished: finished(), parts: columns }.into())
}

/// The values of all pieces in order; `None` if `finished` stops the work, which is called once for each piece.
fn in_parallel<T: Send, E: Send>(
    pieces: usize,
    piece: impl Fn(usize) -> Result<T, E> + Sync,
    finished: impl Fn(&T) -> ControlFlow<()> + Sync,
) -> Result<Option<Vec<T>>, E> {
    let interrupted = AtomicBool::new(false);
    let found: Vec<Option<T>> = (0..pieces)
        .into_par_iter()
        .map(|at| {
            if interrupted.load(Ordering::Relaxed) {
                return Ok(None);
            }
            let value = piece(at)?;
            if finished(&value).is_break() {
                interrupted.store(true, Ordering::Relaxed);
            }
            Ok(Some(value))
        })
        .collect::<Result<_, E>>()?;
    Ok(if interrupted.into_inner() { None } else { found.into_iter().collect() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ops::ControlFlow::{Break, Continue};

    fn grid() -> Grid {
        let unit = Interval::new(0.0, 1.0).unwrap();
        Grid { x: unit, y: unit, columns: 64, rows: 48 }
    }

    #[test]
    fn the_image_does_not_depend_on_the_number_of_threads() {
        let compute = || {
            raster(grid(), |x| x, |&x, y| Label::from((x * 250.0 * y) as u8), |_| Continue(()))
                .unwrap()
        };
        let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool(1).install(compute), pool(7).install(compute));
    }

    #[test]
    fn a_raster_can_be_interrupted() {
        let stop = |done| if done >= 5 { Break(()) } else { Continue(()) };
        let error = raster(grid(), |_| (), |(), _| Label::from(0), stop).unwrap_err();
        assert!(matches!(error, Error::Interrupted { parts: 64, .. }));
    }

    #[test]
    fn a_reversed_range_is_an_error() {
        for (left, right) in [(1.0, 0.0), (f64::NAN, 1.0), (0.0, f64::INFINITY)] {
            let bad = Grid { y: Interval { left, right }, ..grid() };
            let found = raster(bad, |_| (), |(), _| Label::from(0), |_| Continue(()));
            assert!(matches!(found, Err(Error::BadInterval { .. })));
        }
    }

    #[test]
    fn an_empty_raster_is_an_error() {
        let empty = Grid { columns: 0, ..grid() };
        assert!(raster(empty, |_| (), |(), _| Label::from(0), |_| Continue(())).is_err());
    }
}
