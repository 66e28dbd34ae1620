//! Rasters of shares left of α*_n: over mass ratio and phase, or over mass ratio and distance from α*_n.

use crate::circle::circle_limits::CircleLimits;
use crate::circle::edge_chart::turns_to_leave;
use crate::circle::local_fractions::LocalFractions;
use crate::circle::phase_basins::PhaseBasins;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use basin_of_attraction::{Grid, Label, columns_in_parallel};
use hopper_asymptotics::{Offset, Phase};
use passive_hopper::MassRatio;
use std::ops::ControlFlow;

/// The meaning of the vertical axis of a [`ShareRaster`]. On both axes α*_n is above.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Upwards {
    /// −log₁₀ |δ|: the point y is α*_n − 10^{−y}.
    Depth,
    /// Ψ, in turns of the circle.
    Phase,
}

/// The share of every fate in each pixel of a raster.
#[derive(Debug, Clone, PartialEq)]
pub struct ShareRaster {
    grid: Grid,
    upwards: Upwards,
    /// In increasing order.
    labels: Vec<Label>,
    /// Row by row from below, each from left to right; one number for every label.
    shares: Vec<f32>,
}

impl ShareRaster {
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

    /// The certain shares of a pixel, one for every [label](Self::labels); their sum is less than 1 by the undecided share. `None`
    /// outside the raster. Rows count from below.
    pub fn at(&self, column: usize, row: usize) -> Option<&[f32]> {
        let count = self.labels.len();
        let first = (row * self.grid.columns + column) * count;
        let inside = column < self.grid.columns && row < self.grid.rows;
        inside.then(|| self.shares.get(first..first + count))?
    }

    /// The mean share of every label over the raster.
    pub fn means(&self) -> Vec<(Label, f64)> {
        let count = self.labels.len();
        let pixels = (self.grid.columns * self.grid.rows) as f64;
        let mean = |at: usize| {
            let shares = self.shares.iter().skip(at).step_by(count);
            shares.map(|&share| f64::from(share)).sum::<f64>() / pixels
        };
        self.labels.iter().enumerate().map(|(at, &label)| (label, mean(at))).collect()
    }
}

/// The shares left of α*_n: M to the right; upwards the phase, or the depth.
///
/// A pixel has the shares of all phases that it covers, so that no structure between its middle and its edges is missed. In a column
/// the circle is that of its middle. The phases at an offset move with M, by the leading order 1/(A |δ|^{1/3}) of Ψ; with
/// [`Upwards::Depth`] a pixel covers the phases of its whole width. Offsets beyond the [domain](PhaseBasins::domain) are undecided; it
/// begins some tenths below α*_n.
///
/// `progress` is called with the number of finished columns, and may stop the work. The result does not depend on the number of
/// threads. A column takes as long as [`PhaseBasins::new`].
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
/// Those of [`PhaseBasins::new`], [`MassRatio::new`] and [`Offset::new`];
/// [`Error::BasinOfAttraction`] for an empty grid, and if `progress` stops the work.
pub fn share_raster(
    n: u64,
    grid: Grid,
    upwards: Upwards,
    limits: CircleLimits,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<ShareRaster, Error> {
    let pixels = grid.pixels()?;
    let column = |at: usize| Column::new(n, &grid, upwards, limits, at);
    let columns: Vec<Column> = columns_in_parallel(grid.columns, column, progress)?;
    let mut labels: Vec<Label> = columns.iter().flat_map(|column| column.labels.clone()).collect();
    labels.sort_unstable();
    labels.dedup();
    let mut shares = vec![0.0; pixels * labels.len()];
    for (x, column) in columns.iter().enumerate() {
        for (at, label) in column.labels.iter().enumerate() {
            let Ok(place) = labels.binary_search(label) else { continue };
            for row in 0..grid.rows {
                let pixel = row * grid.columns + x;
                shares[pixel * labels.len() + place] =
                    column.shares[row * column.labels.len() + at];
            }
        }
    }
    Ok(ShareRaster { grid, upwards, labels, shares })
}

/// One column: the labels of its circle, and the shares row by row from below.
struct Column {
    labels: Vec<Label>,
    shares: Vec<f32>,
}

impl Column {
    fn new(
        n: u64,
        grid: &Grid,
        upwards: Upwards,
        limits: CircleLimits,
        at: usize,
    ) -> Result<Self, Error> {
        let fates = Fates::new(MassRatio::new(grid.x_at(at))?)?;
        let circle = PhaseBasins::new(&fates, n, limits)?;
        let labels: Vec<Label> = circle.fractions().labels().collect();
        let mut shares = Vec::with_capacity(grid.rows * labels.len());
        let mut add = |found: Option<LocalFractions>| {
            let certain =
                |&label: &Label| found.as_ref().map_or(0.0, |found| found.of(label).lower);
            shares.extend(labels.iter().map(|label| certain(label) as f32));
        };
        let edge = |row: usize| grid.y.left + grid.y.length() * (row as f64 / grid.rows as f64);
        match upwards {
            Upwards::Phase => {
                for row in 0..grid.rows {
                    add(Some(circle.share(edge(row), edge(row + 1))?));
                }
            }
            Upwards::Depth => {
                let moved = movement(grid, at)?;
                let edges = (0..=grid.rows).map(|row| Edge::new(&circle, edge(row), moved));
                let edges = edges.collect::<Result<Vec<_>, Error>>()?;
                for pair in edges.windows(2) {
                    let [low, high] = pair else { continue };
                    add(low
                        .as_ref()
                        .zip(high.as_ref())
                        .map(|(low, high)| low.share(high, &circle)));
                }
            }
        }
        Ok(Column { labels, shares })
    }
}

/// How far ln Ψ moves over the width of a column: Ψ ≈ 1/(A |δ|^{1/3}), and A is proportional to μ.
fn movement(grid: &Grid, at: usize) -> Result<f64, Error> {
    let width = grid.x.length() / grid.columns as f64;
    let middle = grid.x_at(at);
    // The outer edges of the raster may be outside the mass ratios that a hopper has, by rounding.
    let mu = |m: f64| Ok::<_, Error>(MassRatio::new(m)?.mu());
    let (left, right) = (mu(middle - 0.499 * width)?, mu(middle + 0.499 * width)?);
    Ok(pxfm::f_log(right / left).abs())
}

/// The lower or upper edge of a pixel.
struct Edge {
    phase: Phase,
    /// How far the phase moves over the width of the column.
    moved: f64,
}

impl Edge {
    /// `None` beyond the domain.
    fn new(circle: &PhaseBasins, depth: f64, moved: f64) -> Result<Option<Self>, Error> {
        let exponent = (-depth).floor();
        let delta = Offset::new(-pxfm::f_exp10(-depth - exponent), exponent as i64)?;
        let moved = moved * turns_to_leave(circle.coordinate(), delta);
        match circle.phase(delta) {
            Ok(phase) => Ok(Some(Edge { phase, moved })),
            Err(Error::Asymptotics(hopper_asymptotics::Error::OutsideRange { .. })) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// The shares from this edge up to `high`.
    fn share(&self, high: &Edge, circle: &PhaseBasins) -> LocalFractions {
        // A part of a turn more or less does not change a digit of so many turns. Beyond 10⁻⁹²⁴ their number is no `f64`.
        const MOST_TURNS: f64 = (1_u64 << 60) as f64;
        if !(self.moved.max(high.moved) < MOST_TURNS) {
            return circle.fractions();
        }
        let shifted = |edge: &Edge, turns: f64| {
            let phase = &edge.phase;
            Phase::new(phase.whole().clone(), phase.fraction() + turns, phase.error())
        };
        circle.share_between(&shifted(self, -0.5 * self.moved), &shifted(high, 0.5 * high.moved))
    }
}
