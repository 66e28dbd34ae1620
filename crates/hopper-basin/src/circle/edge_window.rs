//! A window of any height about an edge of a basin, as pixels with shares.

use crate::circle::edge_chart::EdgeChart;
use crate::circle::local_fractions::LocalFractions;
use crate::circle::phase_basins::PhaseBasins;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use basin_of_attraction::Label;
use hopper_asymptotics::Offset;

/// Half heights up to this use the chart. There the fates of single speeds would need more and more hops; above it they show more
/// than the first orders of the chart.
const CHART: f64 = 1e-9;

/// Speeds of a pixel above that: a share is known to about an eighth.
const SPEEDS: usize = 8;

/// The shares of the fates in `rows` equal pixels from p − h to p + h, h = 10^{−`depth`}, from below; p is the point of `chart`.
///
/// Up to h = 10⁻⁹, and within the chart's radius, a pixel has the shares of all its speeds ([`EdgeChart::share`]). Above, it has the
/// fates of eight speeds.
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
    let exponent = (-depth).floor();
    let mantissa = pxfm::f_exp10(-depth - exponent);
    let half = Offset::new(mantissa, exponent as i64)?;
    // With an even number of rows the edge lies between two pixels, exactly.
    let place = |at: usize, of: usize| (2.0 * at as f64 - of as f64) / of as f64;
    if half.nearest() <= chart.radius().min(CHART) {
        let end = |row: usize| Offset::new(mantissa * place(row, rows), half.exponent());
        return (0..rows).map(|row| chart.share(circle, end(row)?, end(row + 1)?)).collect();
    }
    let count = 2 * SPEEDS * rows;
    let speed = |k: usize| chart.point().0 + half.nearest() * place(2 * k + 1, count);
    let speeds: Vec<f64> = (0..SPEEDS * rows).map(speed).collect();
    let labels = fates.labels(&speeds)?;
    let pixel = |labels: &[Label]| {
        let mut known: Vec<Label> = labels.to_vec();
        known.retain(|&label| !label.is_undecided());
        known.sort_unstable();
        let runs = known.chunk_by(|a, b| a == b);
        let share = |run: &[Label]| (run[0], run.len() as f64 / SPEEDS as f64);
        LocalFractions::new(runs.map(share), 0.0)
    };
    Ok(labels.chunks(SPEEDS).map(pixel).collect())
}
