//! The shares of the fates between pairs of speeds near an edge.

use crate::circle::edge_chart::EdgeChart;
use crate::circle::local_fractions::LocalFractions;
use crate::circle::phase_basins::PhaseBasins;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use basin_of_attraction::Label;
use hopper_asymptotics::Offset;

/// Offsets up to this use the chart. There the orders of a chart beyond the second are small, and single speeds
/// would show a part of the structure only. Farther away the single speeds cost little.
pub(crate) const CHART: f64 = 1e-5;

/// Speeds of a pixel farther away: a share is known to about an eighth.
const SPEEDS: usize = 8;

/// Bounds of the chart that leave more of a pixel undecided are wide because the pixel reaches to the edge itself,
/// or to the end of the trap. Single speeds then tell more.
const UNDECIDED: f64 = 0.02;

/// Offsets below this part of p have fewer than a thousand `f64` beside them: single speeds tell less than the bounds.
const SPACING: f64 = 1e-13;

/// The shares of the fates from p + `from` to p + `to` for each pair; p is the point of `chart`. The pair is in any
/// order.
///
/// Where the chart and its circle tell the share, it is that of all speeds ([`EdgeChart::share`]); over the mass
/// ratios of a pixel ln Ψ moves by `moved`. Elsewhere it is that of eight speeds.
pub(crate) fn edge_pixels(
    fates: &Fates,
    chart: &EdgeChart,
    circle: &PhaseBasins,
    pairs: &[(Offset, Offset)],
    moved: f64,
) -> Result<Vec<LocalFractions>, Error> {
    let largest = chart.radius().min(CHART);
    let mut known = Vec::with_capacity(pairs.len());
    for &(from, to) in pairs {
        let far = from.nearest().abs().max(to.nearest().abs());
        known.push(if far <= largest { by_chart(chart, circle, from, to, moved)? } else { None });
    }
    let mut speeds = Vec::new();
    for ((from, to), _) in pairs.iter().zip(&known).filter(|(_, known)| known.is_none()) {
        let (from, to) = (from.nearest(), to.nearest());
        let at = |k: usize| from + (to - from) * ((k as f64 + 0.5) / SPEEDS as f64);
        speeds.extend((0..SPEEDS).map(|k| chart.point().0 + at(k)));
    }
    let labels = fates.labels(&speeds)?;
    let mut sampled = labels.chunks(SPEEDS).map(shares_of);
    let nothing = || LocalFractions::new(std::iter::empty(), 0.0);
    Ok(known
        .into_iter()
        .map(|pixel| pixel.unwrap_or_else(|| sampled.next().unwrap_or_else(nothing)))
        .collect())
}

/// The share by the chart; `None` where single speeds tell more: its circle has no phase, its trap ends, or the
/// bounds are wide.
fn by_chart(
    chart: &EdgeChart,
    circle: &PhaseBasins,
    from: Offset,
    to: Offset,
    moved: f64,
) -> Result<Option<LocalFractions>, Error> {
    let far = from.nearest().abs().max(to.nearest().abs());
    let too_near = far < SPACING * chart.point().0;
    match chart.share_moved(circle, from, to, moved) {
        Ok(share) if share.undecided() <= UNDECIDED || too_near => Ok(Some(share)),
        Ok(_)
        | Err(Error::OutsideChart { .. })
        | Err(Error::Asymptotics(hopper_asymptotics::Error::OutsideRange { .. })) => Ok(None),
        Err(error) => Err(error),
    }
}

/// The shares of equally likely speeds. Undecided ones have no share.
pub(crate) fn shares_of(labels: &[Label]) -> LocalFractions {
    let mut known: Vec<Label> = labels.to_vec();
    known.retain(|&label| !label.is_undecided());
    known.sort_unstable();
    let runs = known.chunk_by(|a, b| a == b);
    let share = |run: &[Label]| (run[0], run.len() as f64 / labels.len() as f64);
    LocalFractions::new(runs.map(share), 0.0)
}
