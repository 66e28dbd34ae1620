//! Every cell of a figure, proved: computed in pieces that are kept, and drawn.

use crate::error::Error;
use crate::job::Job;
use basin_of_attraction::{Grid, Interval, Label};
use hopper_basin::{FigureWindow, HopperFate, first_humps};
use hopper_figures::{Window, draw_pixels, fate_colors};
use hopper_proof::{ProvedCells, ProvedLine, ProvedStrip, proved_strips};
use journal_figures::{Svg, rgb_png};
use std::ops::ControlFlow;

/// Columns that are stored together: a run that is killed loses at most so many.
const COLUMNS: usize = 16;

/// Fig. 6, with the mass ratios that are illegible in our copy taken from 0.02.
pub(crate) fn fig_6() -> FigureWindow {
    let speeds = first_humps(5);
    ((0.02, 1.0), (speeds.left, speeds.right))
}

/// The cells of a raster, from `strips` strips of each column. Columns that an earlier run finished are read.
pub(crate) fn proved_cells(
    name: &'static str,
    grid: Grid,
    strips: usize,
    job: &Job,
) -> Result<ProvedCells, Error> {
    let Grid { columns, rows, .. } = grid;
    let block = |k: usize| {
        let range = k * COLUMNS..columns.min((k + 1) * COLUMNS);
        let found = proved_strips(&grid, strips, range, |_| ControlFlow::Continue(()))?;
        Ok(found.iter().flat_map(numbers).collect())
    };
    let scan = format!("{name} {columns} by {rows}, {strips} strips");
    let mut found = Vec::with_capacity(columns * strips);
    for block in job.scan_with(name, &scan, columns.div_ceil(COLUMNS), block)? {
        let mut numbers = block.into_iter();
        found.extend(std::iter::from_fn(|| strip(&mut numbers)));
    }
    // It refuses strips that are not those of the raster.
    Ok(ProvedCells::of_strips(grid, found)?)
}

/// A strip as numbers: its ends, how many intervals, and the ends and the label of each.
fn numbers((own, line): &ProvedStrip) -> Vec<f64> {
    let intervals = line.intervals();
    let head = [own.left, own.right, intervals.len() as f64];
    let each =
        intervals.iter().flat_map(|(own, label)| [own.left, own.right, f64::from(label.code())]);
    head.into_iter().chain(each).collect()
}

/// The next strip of such numbers; `None` at their end.
fn strip(numbers: &mut impl Iterator<Item = f64>) -> Option<ProvedStrip> {
    let (left, right, count) = (numbers.next()?, numbers.next()?, numbers.next()?);
    let mut interval = || {
        let (left, right, label) = (numbers.next()?, numbers.next()?, numbers.next()?);
        Some((Interval { left, right }, Label::from_code(label as u16)))
    };
    let intervals = (0..count as usize).map(|_| interval()).collect::<Option<Vec<_>>>()?;
    Some((Interval { left, right }, ProvedLine::restored(intervals)))
}

/// The cells: a colour mixes those of the basins by their proved shares, and yellow by the share that is open.
pub(crate) fn draw_cells(
    name: &'static str,
    window: FigureWindow,
    found: &ProvedCells,
) -> Result<Svg, Error> {
    let Grid { columns, rows, .. } = found.grid;
    let shares = found.shares()?;
    // A picture has its highest row first.
    let cells = shares.chunks(columns).rev().flatten();
    let pixels: Vec<u8> = cells.flat_map(|cell| fate_colors::mixed(cell.iter().copied())).collect();
    let png = rgb_png(name, columns, rows, &pixels)?;
    let basins = found.areas.iter().map(|&(label, _)| label);
    Ok(draw_window(name, window, &png, basins.chain([HopperFate::UNDECIDED])))
}

/// Pixels over mass ratio and lift-off speed, with the legend of these labels.
pub(crate) fn draw_window(
    name: &'static str,
    (mass_ratio, alpha): FigureWindow,
    png: &[u8],
    labels: impl Iterator<Item = Label>,
) -> Svg {
    let window = Window { name, mass_ratio, alpha, inset: None, tick_counts: (6, 8) };
    draw_pixels(&window, png, labels)
}
