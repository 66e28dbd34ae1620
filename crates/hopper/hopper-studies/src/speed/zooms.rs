//! Tiles of a zoom into edges that fall onto a fixed point, in units of the tile of the whole window.

use super::Measured;
use crate::error::Error;
use basin_of_attraction::{Grid, Interval};
use hopper_basin::{Fates, basin_columns, first_humps};
use passive_hopper::MassRatio;
use rayon::prelude::*;
use std::time::{Duration, Instant};

/// (M, α) of edges that fall to the left of α*_1, α*_2, α*_1 and α*_3. At the first one all speeds decay; the
/// others show structure at every scale.
const EDGES: [(f64, f64); 4] = [
    (0.2, 8.473039723398273),
    (0.12, 11.920553918335777),
    (0.8, 8.457399673997674),
    (0.2, 15.025371092446333),
];

/// Half heights of the tiles are 10⁻³ to 10⁻¹³.
const DEPTHS: std::ops::RangeInclusive<i32> = 3..=13;

/// Pixels along each side of a tile of an explorer.
const SIDE: usize = 256;

/// Half of the width of a tile along M, in half heights: an edge moves by about its own height over it.
const WIDTH: f64 = 0.1;

/// Repeats of a tile. The least time is used, because whatever else runs adds to a time: the largest of 44 medians
/// shows the machine.
const REPEATS: usize = 5;

/// Every so many pixels of a tile are compared with the fate alone, which takes some hundred times as long.
const COMPARED: usize = 97;

fn tile((m, alpha): (f64, f64), depth: i32) -> Result<Grid, Error> {
    let half = 10f64.powi(-depth);
    let x = Interval::new(m - WIDTH * half, m + WIDTH * half)?;
    let y = Interval::new(alpha - half, alpha + half)?;
    Ok(Grid { x, y, columns: SIDE, rows: SIDE })
}

/// The least times of two tiles on one core, computed in turn: the clock of the processor changes from second to
/// second.
fn times(tiles: [&Grid; 2]) -> Result<[Duration; 2], Error> {
    let mut least = [Duration::MAX; 2];
    for _ in 0..REPEATS {
        for (least, grid) in least.iter_mut().zip(tiles) {
            let begin = Instant::now();
            basin_columns(grid, 0..SIDE)?;
            *least = begin.elapsed().min(*least);
        }
    }
    Ok(least)
}

/// Compares some pixels of a tile with the fates alone, and counts the pixels that are undecided.
fn check(grid: &Grid) -> Result<usize, Error> {
    let labels = basin_columns(grid, 0..SIDE)?.concat();
    (0..labels.len()).into_par_iter().step_by(COMPARED).try_for_each(|pixel| {
        let (m, alpha) = (grid.x_at(pixel / SIDE), grid.y_at(pixel % SIDE));
        let fate = Fates::new(MassRatio::new(m)?)?.fate(alpha)?.label();
        let label = labels[pixel];
        if label == fate || fate.is_undecided() {
            return Ok(());
        }
        Err(Error::CheckFailed(format!("M = {m}, α = {alpha}: {label} instead of {fate}")))
    })?;
    Ok(labels.into_iter().filter(|&label| label.is_undecided()).count())
}

/// The figures of zooms.
pub(super) fn measure() -> Result<Vec<Measured>, Error> {
    let (x, humps) = (Interval::new(0.1, 1.0)?, first_humps(5));
    let window = Grid { x, y: humps, columns: SIDE, rows: SIDE };
    let (mut least, mut worst, mut undecided) = (f64::INFINITY, 0.0_f64, 0);
    for edge in EDGES {
        for depth in DEPTHS {
            let grid = tile(edge, depth)?;
            let open = check(&grid)?;
            let [whole, zoom] = times([&window, &grid])?.map(|time| time.as_secs_f64());
            least = least.min(whole);
            worst = worst.max(zoom / whole);
            if depth == *DEPTHS.end() {
                undecided += open;
            }
        }
    }
    let checked = format!("every {COMPARED}th pixel of 44 tiles against its fate");
    let figure = |name, value, unit| Measured { name, value, unit, checked: checked.clone() };
    Ok(vec![
        figure("tile_whole_window_ms", least * 1e3, "ms"),
        figure("tile_zoom_worst_ratio", worst, ""),
        figure("undecided_at_1e-13", undecided as f64, "pixels"),
    ])
}
