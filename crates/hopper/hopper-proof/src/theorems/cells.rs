//! The basins over a window of mass ratio and lift-off speed: every cell of a raster.
//!
//! A *cell* is a whole pixel: all its mass ratios and all its speeds. A column of cells is divided into strips of
//! mass ratios, and the basins of each strip are those of a [`ProvedLine`].

use crate::cell::Cell;
use crate::error::Error;
use crate::hop::strip::Strip;
use crate::line::ProvedLine;
use basin_of_attraction::{Grid, Interval, Label, PixelShares, columns_in_parallel};
use interval_arithmetic::Enclosure;
use std::ops::{ControlFlow, Range};

/// Parts of a sweep, most speeds of each, and the share of each that may stay open. They affect the time, and how
/// much stays open.
const PARTS: usize = 64;
const SPEEDS: usize = 4000;
const OPEN: f64 = 0.004;

/// The mass ratios of a strip, and the basins at all of them.
pub type ProvedStrip = (Interval, ProvedLine);

/// The shares of a cell's area that are proved, of each basin that has one. The rest of the area is open.
pub type CellShares = Vec<(Label, f64)>;

/// The cells of a raster, with the area of each basin.
///
/// Columns are added from the left. What is not added yet is open. The strips, which may need more memory than
/// there is, are not kept.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedCells {
    grid: Grid,
    strips: usize,
    /// The edges of the rows.
    edges: Vec<f64>,
    columns_added: usize,
    cells: Vec<Cell>,
    areas: Areas,
}

fn edges(range: Interval, parts: usize) -> Result<Vec<f64>, Error> {
    Ok(PixelShares::edges(range, parts).map_err(hopper_basin::Error::from)?)
}

/// The mass ratios of the strips of some columns of a raster.
fn mass_ratios(grid: &Grid, strips: usize, columns: Range<usize>) -> Result<Vec<Interval>, Error> {
    let interval = |pair: &[f64]| Interval { left: pair[0], right: pair[1] };
    let missing = Error::Columns { wanted: columns.end, all: grid.columns };
    let edges_of_columns = edges(grid.x, grid.columns)?;
    let last = columns.end.checked_add(1).ok_or_else(|| missing.clone())?;
    let own = edges_of_columns.get(columns.start..last).ok_or(missing)?;
    let mut all = Vec::new();
    for column in own.windows(2).map(interval) {
        all.extend(edges(column, strips)?.windows(2).map(interval));
    }
    Ok(all)
}

/// The strips of some columns of a raster, in order: `strips` of each column. With more of them less stays open,
/// and the time grows in proportion. `progress` is as for [`columns_in_parallel`]; it counts strips.
///
/// # Errors
/// [`Error::Columns`] for columns that the raster has not; those of [`ProvedLine::new`] and of [`columns_in_parallel`].
pub fn proved_strips(
    grid: &Grid,
    strips: usize,
    columns: Range<usize>,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<Vec<ProvedStrip>, Error> {
    let own = mass_ratios(grid, strips, columns)?;
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
#[derive(Debug, Clone, Default, PartialEq)]
struct Areas(Vec<(Label, f64)>);

impl Areas {
    fn add(&mut self, label: Label, area: Enclosure) {
        let area = area.low().max(0.0);
        match self.0.binary_search_by_key(&label, |(own, _)| *own) {
            Ok(at) => {
                let sum = &mut self.0[at].1;
                *sum = (Enclosure::new(*sum, *sum) + area).low();
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
        let open = (whole - known).high().max(0.0);
        let most = |area: f64| (Enclosure::from(area) + open).high();
        let share =
            |&(label, area): &(Label, f64)| (label, Enclosure::new(area, most(area)) / whole);
        self.0.iter().map(share).collect()
    }
}

fn length(range: Interval) -> Enclosure {
    Enclosure::from(range.right) - range.left
}

impl ProvedCells {
    /// A raster of which nothing is proved yet, with `strips` strips of each column.
    ///
    /// # Errors
    /// [`Error::Basin`] for a raster without rows.
    pub fn new(grid: Grid, strips: usize) -> Result<Self, Error> {
        Ok(ProvedCells {
            edges: edges(grid.y, grid.rows)?,
            cells: vec![Cell::Open; grid.columns * grid.rows],
            columns_added: 0,
            areas: Areas::default(),
            grid,
            strips,
        })
    }

    /// Adds the next column, from its strips as [`proved_strips`] gives them: the proved shares of its cells, from
    /// the lowest speeds up.
    ///
    /// # Errors
    /// [`Error::Columns`] if all columns are there; [`Error::Strips`] if the strips are not those of the next one.
    pub fn add_column(&mut self, strips: &[ProvedStrip]) -> Result<Vec<CellShares>, Error> {
        let Grid { columns, rows, y, .. } = self.grid;
        let column = self.columns_added;
        let wanted = mass_ratios(&self.grid, self.strips, column..column + 1)?;
        if !strips.iter().map(|(own, _)| own).eq(&wanted) {
            return Err(Error::Strips { column, found: strips.len(), needed: wanted.len() });
        }
        let mut cells = vec![None; rows];
        let mut shares = vec![Areas::default(); rows];
        for strip in strips {
            self.areas.add_strip(strip, y);
            let found = PixelShares::of_intervals(strip.1.intervals(), y, rows)
                .map_err(hopper_basin::Error::from)?;
            for (row, ends) in self.edges.windows(2).enumerate() {
                cells[row] = Some(with_strip(cells[row], strip.1.cell(ends[0], ends[1])));
                for &label in found.labels() {
                    let share = found.of(label, row).lower / strips.len() as f64;
                    if share > 0.0 {
                        shares[row].add(label, Enclosure::from(share));
                    }
                }
            }
        }
        for (row, cell) in cells.into_iter().enumerate() {
            self.cells[row * columns + column] = cell.unwrap_or(Cell::Open);
        }
        self.columns_added += 1;
        Ok(shares.into_iter().map(|cell| cell.0).collect())
    }

    /// The raster.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The strips of each column.
    pub fn strips(&self) -> usize {
        self.strips
    }

    /// The edges of the rows, from the lowest speeds up.
    pub fn edges(&self) -> &[f64] {
        &self.edges
    }

    /// The columns that were added.
    pub fn columns_added(&self) -> usize {
        self.columns_added
    }

    /// The cells in rows, from the lowest speeds up.
    pub fn cells(&self) -> &[Cell] {
        &self.cells
    }

    /// The share of the window's area that each basin has, in the order of the labels.
    pub fn areas(&self) -> Vec<(Label, Enclosure)> {
        self.areas.shares(length(self.grid.x) * length(self.grid.y))
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
        self.areas().first().map_or(1.0, |(_, share)| share.width())
    }
}
