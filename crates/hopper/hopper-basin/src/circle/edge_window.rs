//! Windows of any height about an edge of a basin, as pixels with shares.

use crate::basins::rasters::basin_columns;
use crate::circle::edge_chart::EdgeChart;
use crate::circle::edge_path::FollowedEdge;
use crate::circle::edge_pixels::{CHART, edge_pixels, shares_of};
use crate::circle::local_fractions::LocalFractions;
use crate::circle::phase_basins::PhaseBasins;
use crate::circle::share_column::{ShareColumn, power_of_ten};
use crate::circle::share_raster::ShareRaster;
use crate::circle::upwards::Upwards;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use basin_of_attraction::{Grid, Interval, Label};
use hopper_asymptotics::{Offset, Phase};

/// Most pixels of a frame each way: its shares then take a gigabyte.
const MOST_PIXELS: usize = 1 << 13;

/// Below the scale of the chart a pixel is the mean of so many strips, each cut into so many cells: 16 levels at an
/// oblique edge.
const CELLS: usize = 4;

/// Above it a pixel is the mean of 2 × 2 fates.
const FATES: usize = 2;

/// The shares of the fates in `rows` equal pixels from p − h to p + h, h = 10^{−`depth`}, from below; p is the
/// point of `chart`.
///
/// Up to 10⁻⁵ from p, and within the chart's radius, a pixel has the shares of all its speeds
/// ([`EdgeChart::share`]). Farther away it has the fates of eight speeds.
///
/// ```
/// use hopper_basin::{CircleLimits, EdgeChart, Fates, PhaseBasins, edge_window};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::new(0.12)?)?;
/// let chart = EdgeChart::near(&fates, 11.920553918335777)?;
/// let circle = PhaseBasins::new(&fates, chart.n(), CircleLimits::default())?;
/// // Half of a window of height 2·10⁻¹⁰⁰ belongs to the basin of α*_2.
/// let pixels = edge_window(&fates, &chart, &circle, 100.0, 16)?;
/// let inside = pixels.iter().filter(|pixel| pixel.of(2.into()).lower == 1.0).count();
/// assert_eq!(inside, 8);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
///
/// # Errors
/// Those of [`EdgeChart::share`], [`Fates::labels`] and [`Offset::new`].
pub fn edge_window(
    fates: &Fates,
    chart: &EdgeChart,
    circle: &PhaseBasins,
    depth: f64,
    rows: usize,
) -> Result<Vec<LocalFractions>, Error> {
    let (mantissa, exponent) = power_of_ten(depth);
    // With an even number of rows the edge lies between two pixels, exactly.
    let place = |row: usize| (2.0 * row as f64 - rows as f64) / rows as f64;
    let end = |row: usize| Offset::new(mantissa * place(row), exponent);
    let pairs = (0..rows).map(|row| Ok((end(row)?, end(row + 1)?)));
    edge_pixels(fates, chart, circle, &pairs.collect::<Result<Vec<_>, Error>>()?, 0.0)
}

/// Ψ at the distance 10^{−`depth`} from the point of `chart`, on the side of the circle: whose fraction is the place on the circle that a window of
/// this height ends with.
///
/// # Errors
/// As [`EdgeChart::phase`].
pub fn edge_phase(chart: &EdgeChart, circle: &PhaseBasins, depth: f64) -> Result<Phase, Error> {
    let (mantissa, exponent) = power_of_ten(depth);
    chart.phase(circle, Offset::new(-chart.slope().signum() * mantissa, exponent)?)
}

/// The fate at a point of an [`edge_frame`] below the scale of the chart: `x` half widths to the right of its middle, and `y` half heights above it. `None` for one
/// that is undecided.
///
/// # Errors
/// As [`EdgeChart::label`].
pub fn edge_label(
    (chart, edge): (&EdgeChart, &FollowedEdge),
    circle: &PhaseBasins,
    depth: f64,
    (x, y): (f64, f64),
) -> Result<Option<Label>, Error> {
    let (mantissa, exponent) = power_of_ten(depth);
    // The edge is the straight line of `edge_frame`.
    let above = y - edge.by_mass_ratio * frame_slant(edge) * x;
    chart.label(circle, Offset::new(mantissa * above, exponent)?)
}

/// The half width of an [`edge_frame`] in mass ratio, divided by its half height in speed.
///
/// Both sides are the same part of their middle, M/p, unless the edge would then cross more than a half of the half
/// height: in a narrower frame it crosses a half of it.
pub fn frame_slant(edge: &FollowedEdge) -> f64 {
    slant(edge.mass_ratio, edge.point, edge.by_mass_ratio)
}

/// The same of any boundary point, from its mass ratio, its speed and its slope over the mass ratio.
pub(crate) fn slant(mass_ratio: f64, point: f64, by_mass_ratio: f64) -> f64 {
    (mass_ratio / point).min(0.5 / by_mass_ratio.abs())
}

/// The shares of the fates in a window of the (M, α) plane about a boundary point: M to the right, h =
/// 10^{−`depth`} upwards from its middle, and h times [`frame_slant`] to the right.
///
/// Down to h = 10⁻⁵ (or the chart's radius) a pixel has 2 × 2 fates. Below, a pixel has the shares of all its
/// speeds in four strips of its width, at any depth: the edge is the straight line α − p = p′ (M − M₀), and the
/// offset from it gives the share. What this leaves out, the bend of the edge and the movement of phases by the
/// part (M − M₀)/M of Ψ, has the order h of a pixel and h^{2/3} of a turn. Both vanish with h, because the sides of
/// the window shrink alike.
///
/// The axes of the raster count in half heights and half widths from −1 to 1.
///
/// # Errors
/// [`Error::EdgeFrame`] for a window without pixels, with too many, or with a depth below 0; those of
/// [`edge_window`] and [`basin_columns`].
pub fn edge_frame(
    fates: &Fates,
    (chart, edge): (&EdgeChart, &FollowedEdge),
    circle: &PhaseBasins,
    depth: f64,
    (columns, rows): (usize, usize),
) -> Result<ShareRaster, Error> {
    check_frame(depth, (columns, rows))?;
    let unit = Interval::new(-1.0, 1.0)?;
    let grid = Grid { x: unit, y: unit, columns, rows };
    let (mantissa, exponent) = power_of_ten(depth);
    let half = Offset::new(mantissa, exponent)?;
    // The strips reach 3/2 of the half height.
    let columns = if 1.5 * half.nearest() <= chart.radius().min(CHART) {
        oblique(fates, (chart, edge), circle, (mantissa, exponent), &grid)?
    } else {
        sampled((chart, edge), half.nearest(), &grid)?
    };
    ShareRaster::from_columns(grid, Upwards::Speed, columns.into_iter().map(Some).collect())
}

/// Refuses a window without pixels, with too many, or with a depth below 0.
pub(crate) fn check_frame(depth: f64, (columns, rows): (usize, usize)) -> Result<(), Error> {
    let good = |pixels: usize| (1..=MOST_PIXELS).contains(&pixels);
    if depth >= 0.0 && depth.is_finite() && good(columns) && good(rows) {
        return Ok(());
    }
    Err(Error::EdgeFrame { depth, columns, rows, most: MOST_PIXELS })
}

/// Columns of pixels with 2 × 2 fates.
fn sampled(
    (chart, edge): (&EdgeChart, &FollowedEdge),
    half: f64,
    grid: &Grid,
) -> Result<Vec<ShareColumn>, Error> {
    let about = |middle: f64, half: f64| Interval::new(middle - half, middle + half);
    let fine = Grid {
        x: about(edge.mass_ratio, half * frame_slant(edge))?,
        y: about(chart.point().0, half)?,
        columns: FATES * grid.columns,
        rows: FATES * grid.rows,
    };
    let labels = basin_columns(&fine, 0..fine.columns)?;
    let column = |pair: &[Vec<Label>]| {
        let pixel = |row: usize| {
            let within = FATES * row..FATES * (row + 1);
            shares_of(&pair.iter().flat_map(|one| one[within.clone()].to_vec()).collect::<Vec<_>>())
        };
        ShareColumn::new(&(0..grid.rows).map(pixel).collect::<Vec<_>>())
    };
    Ok(labels.chunks(FATES).map(column).collect())
}

/// Columns of pixels beside the straight edge.
fn oblique(
    fates: &Fates,
    (chart, edge): (&EdgeChart, &FollowedEdge),
    circle: &PhaseBasins,
    (mantissa, exponent): (f64, i64),
    grid: &Grid,
) -> Result<Vec<ShareColumn>, Error> {
    // Cells of equal height in the offset from the edge, from −3/2 to 3/2 half heights; the edge lies between two
    // of them.
    let (within, beside) = (CELLS * grid.rows, (CELLS * grid.rows).div_ceil(4));
    let middle = within / 2 + beside;
    let place = |cell: usize| 2.0 * (cell as f64 - middle as f64) / within as f64;
    let end = |cell: usize| Offset::new(mantissa * place(cell), exponent);
    let pairs = (0..2 * middle).map(|cell| Ok((end(cell)?, end(cell + 1)?)));
    let pairs = pairs.collect::<Result<Vec<_>, Error>>()?;
    let cells = edge_pixels(fates, chart, circle, &pairs, 0.0)?;
    let all = ShareColumn::new(&cells);
    let slope = edge.by_mass_ratio * frame_slant(edge);
    let column = |at: usize| {
        // Where each strip cuts the edge, in cells above the middle.
        let shift = |strip: usize| {
            let x = (CELLS * at + strip) as f64 + 0.5;
            let x = 2.0 * x / (CELLS * grid.columns) as f64 - 1.0;
            (0.5 * slope * x * within as f64).round() as isize
        };
        let shifts: Vec<isize> = (0..CELLS).map(shift).collect();
        let mut shares = Vec::with_capacity(grid.rows * all.labels.len());
        for row in 0..grid.rows {
            for place in 0..all.labels.len() {
                let mut sum = 0.0;
                for shift in &shifts {
                    let first = (CELLS * row + beside).saturating_add_signed(-shift);
                    let own = (first..first + CELLS).filter_map(|cell| all.at(cell)?.get(place));
                    sum += own.map(|share| f64::from(*share)).sum::<f64>();
                }
                shares.push((sum / (CELLS * CELLS) as f64) as f32);
            }
        }
        ShareColumn { labels: all.labels.clone(), shares }
    };
    Ok((0..grid.columns).map(column).collect())
}
