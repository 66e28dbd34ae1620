//! The basins over a window of mass ratio and lift-off speed: every point of a raster, and every cell.
//!
//! A *point* of a raster is the middle of a pixel. A *cell* is the whole pixel: all its mass ratios and all its speeds. A column of cells is
//! divided into strips of mass ratios, and the basins of each strip are those of a [`ProvedLine`].

use crate::cell::Cell;
use crate::certificate::BasinInterval;
use crate::error::Error;
use crate::hop::proved_images::ProvedImages;
use crate::hop::strip::Strip;
use crate::line::ProvedLine;
use basin_of_attraction::{
    Grid, Interval, Label, LabelImage, PixelShares, columns_in_parallel, raster_by_strips,
};
use hopper_basin::{HopperFate, ImagedSpeed, SpeedImage, SpeedImages};
use interval_arithmetic::Enclosure;
use std::ops::ControlFlow;

/// Parts of a sweep, most speeds of each, and the share of each that may stay open. They affect the time, and how much stays open: points need
/// less than areas, because single points are followed further.
const PARTS: usize = 64;
const SPEEDS: usize = 4000;
const OPEN_OF_POINTS: f64 = 0.2;
const OPEN_OF_CELLS: f64 = 0.004;

/// Most hops of a single speed until it lies in a known interval.
const MOST_HOPS: usize = 2000;

/// The label of a point without a proof.
const OPEN: Label = HopperFate::UNDECIDED_PRECISION;

/// The fate of one speed: its interval, or that of one of its images.
fn label_of(line: &ProvedLine, images: &ProvedImages, speed: f64) -> Label {
    let (mut low, mut high) = (speed, speed);
    for _ in 0..MOST_HOPS {
        if let Some(label) = line.label_of_all(low, high) {
            return label;
        }
        let image = if low == high {
            images.of_speed(low)
        } else {
            let end = |speed: f64| ImagedSpeed { speed, reached: images.of_speed(speed) };
            images.of_all_between(&end(low), &end(high))
        };
        match image {
            SpeedImage::Grounded => return HopperFate::GROUNDED,
            SpeedImage::Unknown => return OPEN,
            SpeedImage::Within(from, to) => (low, high) = (from, to),
        }
    }
    OPEN
}

/// The fate of every point of a raster that is proved; the others have the label [`HopperFate::UNDECIDED_PRECISION`]. `progress` is as for
/// [`raster_by_strips`].
///
/// # Errors
/// Those of [`ProvedLine::new`] and of [`raster_by_strips`].
pub fn proved_points(
    grid: Grid,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, Error> {
    let columns = |ratios: &[f64], speeds: &[f64]| {
        let column = |&ratio: &f64| {
            let strip = Strip::at(ratio)?;
            let line = ProvedLine::new(strip, grid.y, PARTS, OPEN_OF_POINTS, SPEEDS)?;
            let images = ProvedImages::new(strip, grid.y.right)?;
            Ok(speeds.iter().map(|&speed| label_of(&line, &images, speed)).collect())
        };
        ratios.iter().map(column).collect()
    };
    raster_by_strips(grid, 1, columns, progress)
}

/// The cells of a raster, with the area of each basin.
#[derive(Debug, Clone, PartialEq)]
pub struct ProvedCells {
    /// The raster.
    pub grid: Grid,
    /// The cells in rows, from the lowest speeds up.
    pub cells: Vec<Cell>,
    /// The share of the window's area that each basin has, in the order of the labels.
    pub areas: Vec<(Label, Enclosure)>,
    /// The strips of mass ratios, from the left, each with the basins at all its mass ratios.
    pub strips: Vec<(Interval, Vec<BasinInterval>)>,
}

/// One column of cells: the cells upwards, and a lower bound of the area of each basin.
struct Column {
    cells: Vec<Cell>,
    areas: Vec<(Label, f64)>,
    strips: Vec<(Interval, Vec<BasinInterval>)>,
}

fn add_area(areas: &mut Vec<(Label, f64)>, label: Label, area: f64) {
    match areas.binary_search_by_key(&label, |(own, _)| *own) {
        Ok(at) => areas[at].1 = (Enclosure::new(areas[at].1, areas[at].1) + area).low,
        Err(at) => areas.insert(at, (label, area)),
    }
}

/// The cells of the column with these mass ratios, from `strips` strips.
fn column_of(
    ratios: Interval,
    edges: &[f64],
    window: Interval,
    strips: usize,
) -> Result<Column, Error> {
    let borders = PixelShares::edges(ratios, strips).map_err(hopper_basin::Error::from)?;
    let (mut areas, mut lines) = (Vec::new(), Vec::new());
    let mut cells: Vec<Option<Cell>> = vec![None; edges.len() - 1];
    for pair in borders.windows(2) {
        let strip = Strip::between(pair[0], pair[1])?;
        let line = ProvedLine::new(strip, window, PARTS, OPEN_OF_CELLS, SPEEDS)?;
        let width = Enclosure::new(pair[1], pair[1]) - pair[0];
        for (own, label) in line.intervals() {
            let (left, right) = (own.left.max(window.left), own.right.min(window.right));
            if left < right {
                let area = width * (Enclosure::new(right, right) - left);
                add_area(&mut areas, *label, area.low.max(0.0));
            }
        }
        for (cell, ends) in cells.iter_mut().zip(edges.windows(2)) {
            let found = line.cell(ends[0], ends[1]);
            *cell = Some(match (*cell, found) {
                (None, found) => found,
                (Some(Cell::Cut), _) | (_, Cell::Cut) => Cell::Cut,
                (Some(Cell::Basin(own)), Cell::Basin(other)) if own == other => found,
                (Some(Cell::Basin(_)), Cell::Basin(_)) => Cell::Cut,
                _ => Cell::Open,
            });
        }
        lines.push((Interval { left: pair[0], right: pair[1] }, line.into_intervals()));
    }
    let cells = cells.into_iter().map(|cell| cell.unwrap_or(Cell::Open)).collect();
    Ok(Column { cells, areas, strips: lines })
}

impl ProvedCells {
    /// The cells of a raster. Each column is divided into `strips` strips of mass ratios: with more of them less stays open, and the time
    /// grows in proportion. `progress` is as for [`columns_in_parallel`].
    ///
    /// # Errors
    /// Those of [`ProvedLine::new`] and of [`columns_in_parallel`].
    pub fn new(
        grid: Grid,
        strips: usize,
        progress: impl Fn(usize) -> ControlFlow<()> + Sync,
    ) -> Result<Self, Error> {
        let edges = |range: Interval, parts: usize| {
            PixelShares::edges(range, parts).map_err(hopper_basin::Error::from)
        };
        let (ratios, speeds) = (edges(grid.x, grid.columns)?, edges(grid.y, grid.rows)?);
        let column = |at: usize| {
            let ratios = Interval { left: ratios[at], right: ratios[at + 1] };
            column_of(ratios, &speeds, grid.y, strips.max(1))
        };
        let columns = columns_in_parallel(grid.columns, column, progress)?;
        let cells =
            (0..grid.rows).flat_map(|row| columns.iter().map(move |column| column.cells[row]));
        let cells = cells.collect();
        let mut sums = Vec::new();
        for (label, area) in columns.iter().flat_map(|column| &column.areas) {
            add_area(&mut sums, *label, *area);
        }
        let length = |range: Interval| Enclosure::new(range.right, range.right) - range.left;
        let whole = length(grid.x) * length(grid.y);
        let known = sums.iter().fold(Enclosure::ZERO, |sum, &(_, area)| sum + area);
        let open = (whole - known).high.max(0.0);
        let share = |&(label, area): &(Label, f64)| {
            let area = Enclosure::new(area, (Enclosure::new(area, area) + open).high);
            (label, area / whole)
        };
        let areas = sums.iter().map(share).collect();
        let strips = columns.into_iter().flat_map(|column| column.strips).collect();
        Ok(ProvedCells { grid, cells, areas, strips })
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
