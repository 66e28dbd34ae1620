//! The phases of orbits in windows of any height about an edge of a basin.

use crate::circle::edge_chart::{EdgeChart, phase_error};
use crate::circle::edge_path::FollowedEdge;
use crate::circle::edge_pixels::CHART;
use crate::circle::edge_window::{check_frame, frame_slant};
use crate::circle::phase_basins::PhaseBasins;
use crate::circle::share_column::power_of_ten;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use hopper_asymptotics::{FatouCoordinate, Offset, Side};
use passive_hopper::MassRatio;

/// The largest error of a phase that is shown, as for those of speeds.
const LARGEST_ERROR: f64 = 1e-3;

/// The phases with which the orbits from the middles of pixels come to their fixed points ([`Fates::phases`]), in the window of an
/// [`edge_frame`](crate::edge_frame): row after row, the lowest first. `None` where an orbit comes to no fixed point, and where its phase is not known:
/// beside the edge it turns ever faster, and from some 10⁻⁴⁵ on its fraction has no digits.
///
/// On the side of the basin of α*_n the phase is that of the offset from α*_n. On the side of the circle an orbit leaves α*_n after its turns, at a speed of the
/// [domain](PhaseBasins::domain), whose orbit has the same phase.
///
/// # Errors
/// [`Error::EdgeFrame`] as for [`edge_frame`](crate::edge_frame); those of [`EdgeChart::offset`], [`Fates::phases`] and [`MassRatio::new`].
pub fn edge_phases(
    fates: &Fates,
    (chart, edge): (&EdgeChart, &FollowedEdge),
    circle: &PhaseBasins,
    depth: f64,
    (columns, rows): (usize, usize),
) -> Result<Vec<Option<f64>>, Error> {
    check_frame(depth, (columns, rows))?;
    let (mantissa, exponent) = power_of_ten(depth);
    let half = Offset::new(mantissa, exponent)?.nearest();
    if 1.5 * half > chart.radius().min(CHART) {
        return sampled((chart, edge), half, (columns, rows));
    }
    // Pixels of equal offset from the straight edge have equal phases: cells of half a pixel's height.
    let slope = edge.by_mass_ratio * frame_slant(edge);
    let cell = |column, row| {
        let above = middle(row, rows) - slope * middle(column, columns);
        (above * rows as f64).round() as i64
    };
    let of_cell = Cells::new(fates, chart, circle)?;
    let mut known = std::collections::BTreeMap::new();
    let mut all = Vec::with_capacity(columns * rows);
    for row in 0..rows {
        for column in 0..columns {
            let number = cell(column, row);
            let phase = match known.get(&number) {
                Some(phase) => *phase,
                None => {
                    let place = number as f64 / rows as f64;
                    let phase = of_cell.phase(Offset::new(mantissa * place, exponent)?)?;
                    known.insert(number, phase);
                    phase
                }
            };
            all.push(phase);
        }
    }
    Ok(all)
}

/// The middle of a pixel, from −1 to 1.
fn middle(at: usize, all: usize) -> f64 {
    (2 * at + 1) as f64 / all as f64 - 1.0
}

/// What gives the phase of an offset from the edge.
struct Cells<'a> {
    fates: &'a Fates,
    chart: &'a EdgeChart,
    circle: &'a PhaseBasins,
    /// The coordinate on the right of α*_n; `None` at an extreme mass ratio.
    right: Option<FatouCoordinate>,
}

impl<'a> Cells<'a> {
    fn new(fates: &'a Fates, chart: &'a EdgeChart, circle: &'a PhaseBasins) -> Result<Self, Error> {
        let ratio = fates.map().mass_ratio();
        let right = FatouCoordinate::new(chart.n(), ratio, Side::Right).ok();
        Ok(Cells { fates, chart, circle, right })
    }

    fn phase(&self, y: Offset) -> Result<Option<f64>, Error> {
        let (delta, relative) = self.chart.offset(y)?;
        if delta.mantissa() > 0.0 {
            let Some(right) = &self.right else { return Ok(None) };
            let Ok(phase) = right.phase(delta) else { return Ok(None) };
            let error = phase.error() + phase_error(right, delta, relative);
            return Ok((error <= LARGEST_ERROR).then_some(phase.fraction()));
        }
        if delta.mantissa() == 0.0 {
            return Ok(None);
        }
        let turn = self.chart.phase(self.circle, y)?;
        let error = turn.error() + self.circle.phase_error();
        if error > LARGEST_ERROR {
            return Ok(None);
        }
        // Near the ends of a basin the phase in the end turns without bound within a turn here: it is known if it is the same on both sides of the error.
        let at = |place: f64| self.circle.speed_at(place - place.floor());
        let places = [-error, 0.0, error].map(|shift| at(turn.fraction() + shift));
        let phases = self.fates.phases(&places)?;
        let &[Some(low), Some(phase), Some(high)] = &phases[..] else { return Ok(None) };
        let apart = |one: f64| {
            let apart = (one - phase).abs();
            apart.min(1.0 - apart)
        };
        Ok((apart(low).max(apart(high)) <= LARGEST_ERROR).then_some(phase))
    }
}

/// The phases of pixels that doubles tell apart.
fn sampled(
    (chart, edge): (&EdgeChart, &FollowedEdge),
    half: f64,
    (columns, rows): (usize, usize),
) -> Result<Vec<Option<f64>>, Error> {
    let speeds: Vec<f64> =
        (0..rows).map(|row| chart.point().0 + half * middle(row, rows)).collect();
    let mut all = vec![None; columns * rows];
    for column in 0..columns {
        let ratio = edge.mass_ratio + half * frame_slant(edge) * middle(column, columns);
        let phases = Fates::new(MassRatio::new(ratio)?)?.phases(&speeds)?;
        for (row, phase) in phases.into_iter().enumerate() {
            all[row * columns + column] = phase;
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::circle::circle_limits::CircleLimits;

    #[test]
    fn phases_of_the_chart_are_those_of_speeds() {
        let ratio = MassRatio::new(0.12).unwrap();
        let fates = Fates::new(ratio).unwrap();
        let chart = EdgeChart::onto(&fates, 2, 11.9206).unwrap();
        let edge = FollowedEdge::new(&chart).unwrap();
        let circle = PhaseBasins::new(&fates, 2, CircleLimits::default()).unwrap();
        let (columns, rows, depth) = (3, 64, 5.2);
        let about = (&chart, &edge);
        let found = edge_phases(&fates, about, &circle, depth, (columns, rows)).unwrap();
        let half = pxfm::f_exp10(-depth);
        let speed =
            |row: usize| chart.point().0 + half * ((2 * row + 1) as f64 / rows as f64 - 1.0);
        let speeds: Vec<f64> = (0..rows).map(speed).collect();
        let phases = fates.phases(&speeds).unwrap();
        let (mut compared, mut sides) = (0, [0, 0]);
        for (row, phase) in phases.into_iter().enumerate() {
            // The middle column has the mass ratio of the edge.
            let own = found[row * columns + 1];
            let (Some(own), Some(phase)) = (own, phase) else {
                // Left of α*_2 some orbits come to no fixed point.
                assert!(own.is_none() == phase.is_none() || row.abs_diff(rows / 2) < 3, "{row}");
                continue;
            };
            let apart = (own - phase).abs();
            assert!(apart.min(1.0 - apart) < 1e-4, "row {row}: {own} and {phase}");
            compared += 1;
            sides[usize::from(row >= rows / 2)] += 1;
        }
        assert!(compared > 32 && sides[0] > 3 && sides[1] > 3, "{compared}, {sides:?}");
        // Far beyond doubles there are phases on both sides, of which neighbours differ.
        let deep = edge_phases(&fates, about, &circle, 30.0, (1, 32)).unwrap();
        let known = |rows: &[Option<f64>]| rows.iter().flatten().count();
        assert!(known(&deep[..16]) > 0 && known(&deep[16..]) > 8);
        assert!(deep[16..].windows(2).filter(|pair| pair[0] != pair[1]).count() > 8);
        // Beyond 10⁻⁴⁵ nothing is known of them.
        let deepest = edge_phases(&fates, about, &circle, 100.0, (1, 32)).unwrap();
        assert_eq!(known(&deepest), 0);
        for wrong in [(0, 4), (4, 1 << 30)] {
            assert!(edge_phases(&fates, about, &circle, 30.0, wrong).is_err());
        }
        assert!(edge_phases(&fates, about, &circle, f64::NAN, (4, 4)).is_err());
    }
}
