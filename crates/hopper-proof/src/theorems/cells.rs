//! The basins over a window of mass ratio and lift-off speed: every cell of a raster.
//!
//! A *cell* is a whole pixel: all its mass ratios and all its speeds. A column of cells is divided into strips of mass ratios, and the basins of
//! each strip are those of a [`ProvedLine`].

use crate::cell::Cell;
use crate::error::Error;
use crate::hop::strip::Strip;
use crate::line::ProvedLine;
use basin_of_attraction::{Grid, Interval, Label, PixelShares, columns_in_parallel};
use interval_arithmetic::Enclosure;
use std::ops::{ControlFlow, Range};

/// Parts of a sweep, most speeds of each, and the share of each that may stay open. They affect the time, and how much stays open.
const PARTS: usize = 64;
const SPEEDS: usize = 4000;
const OPEN: f64 = 0.004;

/// The mass ratios of a strip, and the basins at all of them.
pub type ProvedStrip = (Interval, ProvedLine);

/// The cells of a raster, with the area of each basin.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedCells {
    /// The raster.
    pub grid: Grid,
    /// The cells in rows, from the lowest speeds up.
    pub cells: Vec<Cell>,
    /// The share of the window's area that each basin has, in the order of the labels.
    pub areas: Vec<(Label, Enclosure)>,
    /// The strips, from the left; all columns have equally many.
    pub strips: Vec<ProvedStrip>,
}

fn edges(range: Interval, parts: usize) -> Result<Vec<f64>, Error> {
    Ok(PixelShares::edges(range, parts).map_err(hopper_basin::Error::from)?)
}

/// The mass ratios of all strips of a raster.
fn mass_ratios(grid: &Grid, strips: usize) -> Result<Vec<Interval>, Error> {
    let interval = |pair: &[f64]| Interval { left: pair[0], right: pair[1] };
    let mut all = Vec::with_capacity(grid.columns * strips);
    for column in edges(grid.x, grid.columns)?.windows(2).map(interval) {
        all.extend(edges(column, strips)?.windows(2).map(interval));
    }
    Ok(all)
}

/// The strips of some columns of a raster, in order: `strips` of each column. With more of them less stays open, and the time grows in
/// proportion. `progress` is as for [`columns_in_parallel`]; it counts strips.
///
/// # Errors
/// [`Error::Strips`] for columns that the raster has not; those of [`ProvedLine::new`] and of [`columns_in_parallel`].
pub fn proved_strips(
    grid: &Grid,
    strips: usize,
    columns: Range<usize>,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<Vec<ProvedStrip>, Error> {
    let all = mass_ratios(grid, strips)?;
    let range = columns.start.saturating_mul(strips)..columns.end.saturating_mul(strips);
    let missing = Error::Strips { found: range.end, needed: all.len() };
    let own = all.get(range).ok_or(missing)?;
    let strip = |at: usize| {
        let strip = Strip::between(own[at].left, own[at].right)?;
        Ok((own[at], ProvedLine::new(strip, grid.y, PARTS, OPEN, SPEEDS)?))
    };
    columns_in_parallel(own.len(), strip, progress)
}

/// What is known of a cell from the part of it in a further strip.
fn with_strip(before: Option<Cell>, found: Cell) -> Cell {
    match (before, found) {
        (None, found) => found,
        (Some(Cell::Cut), _) | (_, Cell::Cut) => Cell::Cut,
        (Some(Cell::Basin(own)), Cell::Basin(other)) if own == other => found,
        (Some(Cell::Basin(_)), Cell::Basin(_)) => Cell::Cut,
        _ => Cell::Open,
    }
}

/// Lower bounds of areas, in the order of the labels.
#[derive(Debug, Clone, Default)]
struct Areas(Vec<(Label, f64)>);

impl Areas {
    fn add(&mut self, label: Label, area: Enclosure) {
        let area = area.low.max(0.0);
        match self.0.binary_search_by_key(&label, |(own, _)| *own) {
            Ok(at) => {
                let sum = &mut self.0[at].1;
                *sum = (Enclosure::new(*sum, *sum) + area).low;
            }
            Err(at) => self.0.insert(at, (label, area)),
        }
    }

    /// The areas of a strip inside the window.
    fn add_strip(&mut self, (mass_ratios, line): &ProvedStrip, window: Interval) {
        let width = length(*mass_ratios);
        for (own, label) in line.intervals() {
            let (left, right) = (own.left.max(window.left), own.right.min(window.right));
            if left < right {
                self.add(*label, width * length(Interval { left, right }));
            }
        }
    }

    /// The shares of the whole, with all that is open in every upper bound.
    fn shares(&self, whole: Enclosure) -> Vec<(Label, Enclosure)> {
        let known = self.0.iter().fold(Enclosure::ZERO, |sum, &(_, area)| sum + area);
        let open = (whole - known).high.max(0.0);
        let most = |area: f64| (Enclosure::new(area, area) + open).high;
        let share =
            |&(label, area): &(Label, f64)| (label, Enclosure::new(area, most(area)) / whole);
        self.0.iter().map(share).collect()
    }
}

fn length(range: Interval) -> Enclosure {
    Enclosure::new(range.right, range.right) - range.left
}

impl ProvedCells {
    /// The cells of a raster, from `strips` strips of each column. `progress` is as for [`proved_strips`].
    ///
    /// # Errors
    /// Those of [`proved_strips`].
    pub fn new(
        grid: Grid,
        strips: usize,
        progress: impl Fn(usize) -> ControlFlow<()> + Sync,
    ) -> Result<Self, Error> {
        let strips = strips.max(1);
        ProvedCells::of_strips(grid, proved_strips(&grid, strips, 0..grid.columns, progress)?)
    }

    /// The cells of a raster from all its strips, as [`proved_strips`] gives them.
    ///
    /// # Errors
    /// [`Error::Strips`] if the strips are not those of the raster.
    pub fn of_strips(grid: Grid, strips: Vec<ProvedStrip>) -> Result<Self, Error> {
        let of_column = (strips.len() / grid.columns.max(1)).max(1);
        let wanted = mass_ratios(&grid, of_column)?;
        if !strips.iter().map(|(own, _)| own).eq(&wanted) {
            return Err(Error::Strips { found: strips.len(), needed: wanted.len() });
        }
        let rows = edges(grid.y, grid.rows)?;
        let mut areas = Areas::default();
        let mut cells = vec![None; grid.columns * grid.rows];
        for (at, strip) in strips.iter().enumerate() {
            areas.add_strip(strip, grid.y);
            for (row, ends) in rows.windows(2).enumerate() {
                let cell = &mut cells[row * grid.columns + at / of_column];
                *cell = Some(with_strip(*cell, strip.1.cell(ends[0], ends[1])));
            }
        }
        let cells = cells.into_iter().map(|cell| cell.unwrap_or(Cell::Open)).collect();
        let areas = areas.shares(length(grid.x) * length(grid.y));
        Ok(ProvedCells { grid, cells, areas, strips })
    }

    /// The share of each cell that is proved of each basin, in rows as the cells are.
    ///
    /// # Errors
    /// [`Error::Basin`] for a raster without rows.
    pub fn shares(&self) -> Result<Vec<Vec<(Label, f64)>>, Error> {
        let Grid { columns, rows, y, .. } = self.grid;
        let of_column = self.strips.len() / columns.max(1);
        let mut shares = vec![Areas::default(); columns * rows];
        for (at, (_, line)) in self.strips.iter().enumerate() {
            let found = PixelShares::of_intervals(line.intervals(), y, rows)
                .map_err(hopper_basin::Error::from)?;
            for row in 0..rows {
                let cell = &mut shares[row * columns + at / of_column];
                for &label in found.labels() {
                    let share = found.of(label, row).lower / of_column as f64;
                    if share > 0.0 {
                        cell.add(label, Enclosure::new(share, share));
                    }
                }
            }
        }
        Ok(shares.into_iter().map(|cell| cell.0).collect())
    }

    /// The share of the cells that are open or cut.
    pub fn undecided_cells(&self) -> f64 {
        let undecided = self.cells.iter().filter(|cell| !matches!(cell, Cell::Basin(_))).count();
        undecided as f64 / self.cells.len() as f64
    }

    /// The share of the cells that are open.
    pub fn open_cells(&self) -> f64 {
        let open = self.cells.iter().filter(|cell| matches!(cell, Cell::Open)).count();
        open as f64 / self.cells.len() as f64
    }

    /// The share of the window's area in which no basin is proved.
    pub fn open_area(&self) -> f64 {
        self.areas.first().map_or(1.0, |(_, share)| share.width())
    }
}
