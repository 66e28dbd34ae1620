//! One column of a raster of shares: left of α*_n, or on both sides of an edge.

use crate::circle::circle_limits::CircleLimits;
use crate::circle::edge_chart::{MOST_TURNS, shifted, turns_to_leave};
use crate::circle::edge_path::FollowedEdge;
use crate::circle::edge_pixels::edge_pixels;
use crate::circle::local_fractions::LocalFractions;
use crate::circle::phase_basins::PhaseBasins;
use crate::circle::upwards::Upwards;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use basin_of_attraction::Grid;
use basin_of_attraction::Label;
use hopper_asymptotics::{Offset, Phase};
use passive_hopper::MassRatio;

/// The version of the shares of a [`ShareColumn`] and of the windows about an edge
/// ([`edge_window`](crate::edge_window), [`edge_frame`](crate::edge_frame)). It is raised when a change of the
/// libraries changes a bit of them, as [`RASTER_VERSION`](crate::RASTER_VERSION) is for labels.
pub const SHARE_VERSION: u32 = 1;

/// The shares of the fates in the pixels of one column.
#[derive(Debug, Clone, PartialEq)]
pub struct ShareColumn {
    /// The labels that occur, in increasing order.
    pub labels: Vec<Label>,
    /// Row by row from below, one certain share for every label.
    pub shares: Vec<f32>,
}

impl ShareColumn {
    /// A column of pixels, the lowest first. Shares are lower bounds.
    pub(crate) fn new(pixels: &[LocalFractions]) -> Self {
        let mut labels: Vec<Label> = pixels.iter().flat_map(LocalFractions::labels).collect();
        labels.sort_unstable();
        labels.dedup();
        let row = |pixel: &LocalFractions| {
            labels.iter().map(|&label| pixel.certain(label) as f32).collect::<Vec<_>>()
        };
        let shares = pixels.iter().flat_map(row).collect();
        ShareColumn { labels, shares }
    }

    /// The shares of a pixel, one for every label; `None` above the highest row.
    pub fn at(&self, row: usize) -> Option<&[f32]> {
        let count = self.labels.len();
        self.shares.get(row * count..(row + 1) * count)
    }

    /// Column `at` of a [`share_raster`](crate::share_raster) left of α*_n.
    ///
    /// # Errors
    /// As [`share_raster`](crate::share_raster); [`Error::Upwards`] for an axis that counts from an edge.
    pub fn left_of(
        n: u64,
        grid: &Grid,
        upwards: Upwards,
        limits: CircleLimits,
        at: usize,
    ) -> Result<Self, Error> {
        let fates = Fates::new(MassRatio::new(grid.x_at(at))?)?;
        let circle = PhaseBasins::new(&fates, n, limits)?;
        let nothing = || LocalFractions::new(std::iter::empty(), 0.0);
        let end = |row: usize| grid.y.left + grid.y.length() * (row as f64 / grid.rows as f64);
        let pixels: Vec<LocalFractions> = match upwards {
            Upwards::Phase => {
                let pixel = |row: usize| circle.share(end(row), end(row + 1));
                (0..grid.rows).map(pixel).collect::<Result<_, _>>()?
            }
            Upwards::Depth => {
                let moved = movement(grid, at)?;
                let ends = (0..=grid.rows).map(|row| End::new(&circle, end(row), moved));
                let ends = ends.collect::<Result<Vec<_>, Error>>()?;
                let share = |pair: &[Option<End>]| match pair {
                    [Some(low), Some(high)] => low.share(high, &circle),
                    _ => nothing(),
                };
                ends.windows(2).map(share).collect()
            }
            Upwards::BothSides | Upwards::Speed | Upwards::LiftOffSpeed => {
                return Err(Error::Upwards);
            }
        };
        Ok(Self::new(&pixels))
    }

    /// Column `at` of a raster about a boundary point that is followed over the mass ratio, with the axis
    /// [`Upwards::BothSides`]. `edges` has the point at the middle of every column, as far as it exists; `None` if
    /// it does not exist in this one.
    ///
    /// Up to 10⁻⁵ from the point a pixel has the shares of all its speeds over all its mass ratios: over the width
    /// of a column ln Ψ moves by that of 1/A and by a third of that of the slope of f^k. Farther away it has the
    /// fates of eight speeds.
    ///
    /// # Errors
    /// Those of [`PhaseBasins::new`], [`Offset::new`] and [`FollowedEdge::chart`]; [`Error::BasinOfAttraction`] for
    /// a grid with an odd number of rows.
    pub fn about(
        edges: &[Option<FollowedEdge>],
        grid: &Grid,
        limits: CircleLimits,
        at: usize,
    ) -> Result<Option<Self>, Error> {
        if grid.rows % 2 == 1 {
            let Grid { columns, rows, .. } = *grid;
            return Err(basin_of_attraction::Error::BadRaster { columns, rows }.into());
        }
        let own = |at: usize| edges.get(at).copied().flatten();
        let Some(edge) = own(at) else { return Ok(None) };
        let fates = Fates::new(MassRatio::new(edge.mass_ratio)?)?;
        let Some(chart) = edge.chart(&fates)? else { return Ok(None) };
        let circle = PhaseBasins::new(&fates, edge.n, limits)?;
        let beside = [at.checked_sub(1).and_then(own), own(at + 1)];
        let change = |other: FollowedEdge| pxfm::f_log(other.slope / edge.slope).abs();
        let slope_moves = beside.into_iter().flatten().map(change).fold(0.0, f64::max);
        let half = grid.rows / 2;
        let depth = |row: usize| grid.y.left + grid.y.length() * (row as f64 / half as f64);
        let end = |sign: f64, row: usize| {
            let (mantissa, exponent) = power_of_ten(depth(row));
            Offset::new(sign * mantissa, exponent)
        };
        let below = (0..half).map(|row| Ok((end(-1.0, row)?, end(-1.0, row + 1)?)));
        let above = (0..half).rev().map(|row| Ok((end(1.0, row)?, end(1.0, row + 1)?)));
        let pairs = below.chain(above).collect::<Result<Vec<_>, Error>>()?;
        let moved = movement(grid, at)? + slope_moves / 3.0;
        Ok(Some(Self::new(&edge_pixels(&fates, &chart, &circle, &pairs, moved)?)))
    }
}

/// The mantissa and the exponent of 10^{−`depth`}.
pub(crate) fn power_of_ten(depth: f64) -> (f64, i64) {
    let exponent = (-depth).floor();
    (pxfm::f_exp10(-depth - exponent), exponent as i64)
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

/// The lower or upper end of a pixel.
struct End {
    phase: Phase,
    /// How far the phase moves over the width of the column.
    moved: f64,
}

impl End {
    /// `None` beyond the domain.
    fn new(circle: &PhaseBasins, depth: f64, moved: f64) -> Result<Option<Self>, Error> {
        let (mantissa, exponent) = power_of_ten(depth);
        let delta = Offset::new(-mantissa, exponent)?;
        let moved = moved * turns_to_leave(circle.coordinate(), delta);
        match circle.phase(delta) {
            Ok(phase) => Ok(Some(End { phase, moved })),
            Err(Error::Asymptotics(hopper_asymptotics::Error::OutsideRange { .. })) => Ok(None),
            Err(error) => Err(error),
        }
    }

    /// The shares from this end up to `high`.
    fn share(&self, high: &End, circle: &PhaseBasins) -> LocalFractions {
        // A part of a turn more or less does not change a digit of so many turns. Beyond 10⁻⁹²⁴ their number is no
        // `f64`.
        if !(self.moved.max(high.moved) < MOST_TURNS) {
            return circle.fractions();
        }
        let (low, high) =
            (shifted(&self.phase, -0.5 * self.moved), shifted(&high.phase, 0.5 * high.moved));
        circle.share_between(&low, &high)
    }
}
