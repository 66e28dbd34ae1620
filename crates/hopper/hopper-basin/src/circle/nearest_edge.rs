//! The boundary point nearest to a speed, at any distance.

use crate::circle::edge_chart::EdgeChart;
use crate::circle::edge_search::{Approach, MOST_HOPS, NEAR};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use passive_hopper::{alpha_star, index_below};

/// Fixed points above a speed that are tried: of some the trap may have ended at this mass ratio.
const STARS: u64 = 4;

/// Changes of fates that are tried, from the nearest on: each takes some tens of milliseconds.
const CHANGES: usize = 12;

/// Steps each way of the grid on which fates are compared.
const STEPS: i32 = 400;

impl EdgeChart {
    /// The chart about a boundary point near `guess`, at any distance: that of [`near`](Self::near), if there is one; else that at the nearest change of
    /// fates on a grid; else about the nearest fixed point α*_n, n ≥ 1, whose trap is known. Changes without a chart, such as edges of
    /// grounding ([`GroundingEdge`](crate::GroundingEdge)), are passed over. It takes some tens of milliseconds, and up to seconds beside edges that have no chart.
    ///
    /// # Errors
    /// [`Error::NoEdge`] if no fixed point near the speed has a trap; the errors of [`Fates::fate`] for a wrong speed.
    pub fn nearest(fates: &Fates, guess: f64) -> Result<EdgeChart, Error> {
        match EdgeChart::near(fates, guess) {
            Err(Error::NoEdge { .. }) => {}
            found => return found,
        }
        let below = index_below(guess)?.max(1);
        let mut stars: Vec<(u64, f64)> =
            (below..below + STARS).map(|n| (n, alpha_star(n))).collect();
        stars.sort_by(|a, b| (a.1 - guess).abs().total_cmp(&(b.1 - guess).abs()));
        let nearest = stars.first().map_or(0.0, |(_, star)| (star - guess).abs());
        for change in changes(fates, guess, nearest)?.into_iter().take(CHANGES) {
            if let Ok(found) = EdgeChart::near(fates, narrowed(fates, change)?[0]) {
                return Ok(found);
            }
        }
        let own = |(n, point)| EdgeChart::about(fates, Approach { n, hops: 0, point });
        stars.into_iter().find_map(own).ok_or(Error::NoEdge {
            alpha: guess,
            within: NEAR,
            hops: MOST_HOPS,
        })
    }
}

/// Neighbours of a grid about a speed whose fates differ, up to a distance, the nearest first.
pub(crate) fn changes(fates: &Fates, guess: f64, distance: f64) -> Result<Vec<(f64, f64)>, Error> {
    let speed = |step: i32| guess + distance * f64::from(step) / f64::from(STEPS);
    let speeds: Vec<f64> = (-STEPS..=STEPS).map(speed).filter(|speed| *speed > 0.0).collect();
    let labels = fates.labels(&speeds)?;
    let mut found: Vec<(f64, f64)> = speeds
        .windows(2)
        .zip(labels.windows(2))
        .filter(|(_, labels)| labels[0] != labels[1])
        .map(|(speeds, _)| (speeds[0], speeds[1]))
        .collect();
    let far = |(left, right): &(f64, f64)| (left.midpoint(*right) - guess).abs();
    found.sort_by(|a, b| far(a).total_cmp(&far(b)));
    Ok(found)
}

/// Neighbouring doubles with different fates between two speeds, of which the first has the fate of `left`.
pub(crate) fn narrowed(fates: &Fates, (left, right): (f64, f64)) -> Result<[f64; 2], Error> {
    let label = fates.labels(&[left])?;
    let (mut inside, mut outside) = (left, right);
    loop {
        let middle = inside.midpoint(outside);
        if middle == inside || middle == outside {
            return Ok([inside, outside]);
        }
        match fates.labels(&[middle])? == label {
            true => inside = middle,
            false => outside = middle,
        }
    }
}
