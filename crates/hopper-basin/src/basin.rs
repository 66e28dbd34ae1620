//! Basins at a fixed mass ratio, and over the plane of mass ratio and lift-off speed.

use crate::labels::labels_of_all;
use crate::{Error, Fates, HopperFate, TrapEdge};
use basin_of_attraction::{
    Branch, Grid, Interval, IntervalSet, LabelImage, equally_spaced_counts, monotone_branches,
    preimage_levels, raster_by_strips,
};
use passive_hopper::{MassRatio, alpha_star};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::ops::{ControlFlow, Range};

/// Points counted by their fate.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BasinFractions {
    /// Points by [label](HopperFate::label).
    pub counts: BTreeMap<u16, usize>,
    /// All points.
    pub points: usize,
}

impl BasinFractions {
    /// The share of one label.
    pub fn of(&self, label: u16) -> f64 {
        self.counts.get(&label).copied().unwrap_or(0) as f64 / self.points as f64
    }

    /// The share of incessant hopping: all labels of fixed points n ≥ 1.
    pub fn incessant(&self) -> f64 {
        let labels = 1..=HopperFate::LARGEST_LABEL as u16;
        self.counts.range(labels).map(|(_, count)| count).sum::<usize>() as f64 / self.points as f64
    }
}

/// The shares of all fates on [α*_from, α*_to] by the paper's protocol (Sec. VI): `points` equally
/// spaced points on each interval between neighbouring fixed points, so that the fractions of the
/// intervals are averaged, whatever their lengths.
///
/// # Errors
/// As [`Fates::new`], and [`Error::NoPoints`] if there are none.
pub fn basin_fractions(
    mass_ratio: MassRatio,
    from: u64,
    to: u64,
    points: usize,
) -> Result<BasinFractions, Error> {
    let fates = Fates::new(mass_ratio)?;
    let label = |alpha: f64| fates.fate(alpha).map_or(HopperFate::UNDECIDED_HOP, HopperFate::label);
    let mut counts = BTreeMap::new();
    for n in from..to {
        let hump = Interval::new(alpha_star(n), alpha_star(n + 1))?;
        for (label, count) in equally_spaced_counts(hump, points, label) {
            *counts.entry(label).or_insert(0) += count;
        }
    }
    match counts.values().sum() {
        0 => Err(Error::NoPoints { from, to, points }),
        points => Ok(BasinFractions { counts, points }),
    }
}

/// The basins over a window of (M, α): M to the right, α upwards, labels as in
/// [`HopperFate::label`].
///
/// A pixel is judged by its middle. The result does not depend on the number of threads.
///
/// # Errors
/// [`Error::Window`] unless the speeds are not negative and their fixed points have labels, errors of
/// [`MassRatio::new`] and of [`raster_by_strips`].
pub fn basin_raster(
    grid: Grid,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<LabelImage, Error> {
    check_speeds(&grid)?;
    raster_by_strips(grid, strip_width(&grid), strip, progress)
}

/// Columns whose orbits hop together: as much as stays in a processor's cache, and work for many threads.
fn strip_width(grid: &Grid) -> usize {
    (16_384 / grid.rows.max(1)).min(grid.columns / 16).clamp(1, 16)
}

/// The labels of some columns of a [`basin_raster`], from the lowest speed up: for rasters too large for memory.
///
/// Sixteen neighbouring columns at once take less time than one by one: their orbits hop together.
///
/// ```
/// use basin_of_attraction::{Grid, Interval};
/// use hopper_basin::{basin_columns, basin_raster};
/// use std::ops::ControlFlow::Continue;
/// let (x, y) = (Interval::new(0.1, 1.0)?, Interval::new(4.5, 20.0)?);
/// let grid = Grid { x, y, columns: 100, rows: 50 };
/// let columns = basin_columns(&grid, 16..32)?;
/// let raster = basin_raster(grid, |_| Continue(()))?;
/// assert_eq!(Some(columns[3][20]), raster.at(16 + 3, 20));
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// An empty range has no columns.
///
/// # Errors
/// As [`basin_raster`]; [`basin_of_attraction::Error::BadColumnRange`] for columns that the grid has not.
pub fn basin_columns(grid: &Grid, columns: Range<usize>) -> Result<Vec<Vec<u16>>, Error> {
    check_speeds(grid)?;
    grid.pixels()?;
    if columns.end > grid.columns {
        let (start, end, columns) = (columns.start, columns.end, grid.columns);
        let bad = basin_of_attraction::Error::BadColumnRange { start, end, columns };
        return Err(bad.into());
    }
    let speeds: Vec<f64> = (0..grid.rows).map(|row| grid.y_at(row)).collect();
    let ratios: Vec<f64> = columns.map(|column| grid.x_at(column)).collect();
    let mut found = Vec::with_capacity(ratios.len());
    for some in ratios.chunks(strip_width(grid)) {
        found.extend(strip(some, &speeds)?);
    }
    Ok(found)
}

/// The labels of `speeds` at every mass ratio.
fn strip(ratios: &[f64], speeds: &[f64]) -> Result<Vec<Vec<u16>>, Error> {
    let fates = |&m: &f64| Fates::new(MassRatio::new(m)?);
    let fates = ratios.iter().map(fates).collect::<Result<Vec<_>, Error>>()?;
    labels_of_all(&fates.iter().collect::<Vec<_>>(), speeds)
}

/// Whether the speeds of `grid` have labels.
fn check_speeds(grid: &Grid) -> Result<(), Error> {
    let largest = alpha_star(HopperFate::LARGEST_LABEL);
    if grid.y.left >= 0.0 && grid.y.right <= largest {
        return Ok(());
    }
    Err(Error::Window { bottom: grid.y.left, top: grid.y.right, largest })
}

/// The monotone branches of the map from α*_`from` to α*_`to`.
///
/// The contact parts are cut at their critical points, of which theory knows all. The sudden
/// windows (nπ, α*_n) are searched with `samples` points each: pieces that are narrower are not
/// seen (for M ≤ 0.905 a hop has at most one sudden lift-off, and the windows are simple).
///
/// # Errors
/// As [`Fates::new`].
pub fn branches(fates: &Fates, from: u64, to: u64, samples: usize) -> Result<Vec<Branch>, Error> {
    let mu = fates.map().mass_ratio().mu();
    let mut branches = Vec::new();
    for n in from..to {
        let hump = crate::hump::Hump::new(n)?;
        let (left, end) = (hump.star.value().next_up(), (n + 1) as f64 * PI);
        let right = alpha_star(n + 1).next_down();
        let mut cuts = vec![left];
        if let Some((maximum, minimum)) = hump.critical(mu)? {
            cuts.extend([maximum, minimum].map(|t| hump.star.value() + hump.delta(t)));
        }
        cuts.push(end);
        for pair in cuts.windows(2) {
            // Between cuts only an edge of grounding can lie, which a few samples bracket.
            branches.extend(monotone_branches(fates, Interval::new(pair[0], pair[1])?, 65)?);
        }
        branches.extend(monotone_branches(fates, Interval::new(end, right)?, samples)?);
    }
    Ok(branches)
}

/// The basin of α*_n in the window [α*_n, α*_top], level by level: level k enters the trap after
/// exactly k hops (paper, Sec. VI A).
///
/// # Errors
/// As [`branches`].
pub fn basin_levels(
    fates: &Fates,
    n: u64,
    top: u64,
    depth: usize,
    samples: usize,
) -> Result<Vec<IntervalSet>, Error> {
    let trap = fates.trap(n)?;
    let branches = branches(fates, n, top, samples)?;
    let mut level = Interval::new(trap.fixed_point.value(), trap.right())?;
    if trap.edge == TrapEdge::Crossing {
        // The edge is where f falls to α*_n: taken as the map computes it, to the last bit, so that
        // no sliver between two roundings of it counts as a level of its own.
        let own = branches.iter().filter_map(|branch| branch.preimage(fates, &level));
        level.right = own.filter(|p| p.left < level.right).fold(level.right, |r, p| r.max(p.right));
    }
    Ok(preimage_levels(fates, &branches, level, depth))
}
