//! A boundary point over the mass ratio, followed by continuation.
//!
//! ```text
//!   f^k(p; M) = α*_n,    dp/dM = −(∂f^k/∂M)/(∂f^k/∂α)
//!
//!   derivatives along the orbit:   by_speed ← f′ · by_speed      by_mass_ratio ← ∂f/∂M + f′ · by_mass_ratio
//! ```
//!
//! α*_n does not depend on M. While ∂f^k/∂α ≠ 0 and no hop of the orbit comes to an end of a lap, p(M) is one
//! smooth branch. A step predicts p along its tangent, corrects it by Newton's method, and is halved until the two
//! tangents agree with the corrected point.

use crate::circle::edge_chart::EdgeChart;
use crate::circle::edge_search::Approach;
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use passive_hopper::{Enclosed, FixedPointSpeed, LiftOffMap, MassRatio};

/// A boundary point that comes to α*_n in `hops` hops, in `f64`, at one mass ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FollowedEdge {
    /// The mass ratio.
    pub mass_ratio: f64,
    /// n of the fixed point α*_n to which the point comes.
    pub n: u64,
    /// k, the number of hops until then.
    pub hops: usize,
    /// The lift-off speed p.
    pub point: f64,
    /// ∂f^k/∂α at p.
    pub slope: f64,
    /// dp/dM.
    pub by_mass_ratio: f64,
}

/// Steps of Newton's method. From a predicted point two or three are enough.
const NEWTON_STEPS: usize = 8;

/// A correction of so many ulps of p ends Newton's method: the rounding of the hops, times 1/slope, moves p by as much.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The corrected point differs from the mean of both tangents by less than this part of the difference of the two.
/// On a smooth branch the part tends to 0 with the step. With a larger part a step could leave the branch near a
/// fold.
const AGREEMENT: f64 = 0.1;

/// A step shorter than this part of the way to the next mass ratio ends the branch: it folds, or an end of a lap is
/// there.
const SHORTEST_STEP: f64 = 1e-7;

/// Most steps from one mass ratio to the next. A step is halved some 23 times before it is too short, so that this
/// budget ends only a branch whose steps stay short.
const MOST_STEPS: usize = 4096;

impl FollowedEdge {
    /// The point of a chart.
    ///
    /// # Errors
    /// [`Error::NoEdge`] if the orbit of its nearest `f64` has no derivatives.
    pub fn new(chart: &EdgeChart) -> Result<Self, Error> {
        let (point, _, _) = chart.point();
        let found = Self::corrected(chart.n(), chart.hops(), chart.mass_ratio(), point);
        let hops = chart.hops();
        found.ok_or(Error::NoEdge { alpha: point, within: ROUNDING * point, hops })
    }

    /// The same boundary point at another mass ratio; `None` if the branch ends before it: where two preimages meet
    /// and vanish, as at a crisis, or where a hop of its orbit comes to the end of a lap.
    ///
    /// The steps are chosen so that the branch is not left at a fold. This is a test at each step, not a proof.
    ///
    /// ```
    /// use hopper_basin::{EdgeChart, Fates, FollowedEdge};
    /// use passive_hopper::MassRatio;
    /// let fates = Fates::new(MassRatio::new(0.12)?)?;
    /// let edge = FollowedEdge::new(&EdgeChart::onto(&fates, 2, 11.9206)?)?;
    /// let other = edge.at(MassRatio::new(0.125)?)?.expect("the branch exists there");
    /// // It is the boundary point that a search there finds.
    /// let there = EdgeChart::near(&Fates::new(MassRatio::new(0.125)?)?, other.point)?;
    /// assert!((there.point().0 - other.point).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`passive_hopper::Error`] if a mass ratio on the way is none that a hopper has.
    pub fn at(&self, mass_ratio: MassRatio) -> Result<Option<Self>, Error> {
        let target = mass_ratio.value();
        let way = target - self.mass_ratio;
        let (mut here, mut step) = (*self, way);
        for _ in 0..MOST_STEPS {
            let left = target - here.mass_ratio;
            if left == 0.0 {
                return Ok(Some(here));
            }
            if step.abs() >= left.abs() {
                step = left;
            }
            let next = if step == left { target } else { here.mass_ratio + step };
            match here.step(MassRatio::new(next)?) {
                Some(found) => (here, step) = (found, 2.0 * step),
                None => step *= 0.5,
            }
            if !(step.abs() > SHORTEST_STEP * way.abs()) {
                return Ok(None);
            }
        }
        Ok(None)
    }

    /// The same boundary point at increasing mass ratios; `None` where the branch does not reach, as in
    /// [`at`](Self::at). It is followed from its own mass ratio outwards in both directions, from each mass ratio
    /// to the next.
    ///
    /// # Errors
    /// [`passive_hopper::Error`] if one of the mass ratios is none that a hopper has.
    pub fn at_all(&self, mass_ratios: &[f64]) -> Result<Vec<Option<Self>>, Error> {
        let right_from = mass_ratios.partition_point(|&other| other < self.mass_ratio);
        let mut edges = vec![None; mass_ratios.len()];
        let mut follow = |places: &mut dyn Iterator<Item = usize>| -> Result<(), Error> {
            let mut here = *self;
            for place in places {
                let Some(next) = here.at(MassRatio::new(mass_ratios[place])?)? else { break };
                edges[place] = Some(next);
                here = next;
            }
            Ok(())
        };
        follow(&mut (right_from..mass_ratios.len()))?;
        follow(&mut (0..right_from).rev())?;
        Ok(edges)
    }

    /// The chart about the point; `None` if its derivatives cannot be found.
    ///
    /// # Errors
    /// [`Error::OtherMassRatio`] unless `fates` has the point's mass ratio.
    pub fn chart(&self, fates: &Fates) -> Result<Option<EdgeChart>, Error> {
        let (own, other) = (self.mass_ratio, fates.map().mass_ratio().value());
        if own != other {
            return Err(Error::OtherMassRatio { own, other });
        }
        let FollowedEdge { n, hops, point, .. } = *self;
        Ok(EdgeChart::about(fates, Approach { n, hops, point }))
    }

    /// One step; `None` if the corrected point does not lie on the smooth continuation of this branch.
    fn step(&self, mass_ratio: MassRatio) -> Option<Self> {
        let way = mass_ratio.value() - self.mass_ratio;
        let predicted = self.point + way * self.by_mass_ratio;
        let found = Self::corrected(self.n, self.hops, mass_ratio, predicted)?;
        let mean = 0.5 * (self.by_mass_ratio + found.by_mass_ratio);
        let bend = (found.by_mass_ratio - self.by_mass_ratio) * way;
        let off = (found.point - self.point - mean * way).abs();
        let smooth = off <= AGREEMENT * bend.abs() + ROUNDING * found.point;
        (smooth && found.slope * self.slope > 0.0).then_some(found)
    }

    /// The zero of f^k − α*_n from `guess` on, by Newton's method in `f64`.
    fn corrected(n: u64, hops: usize, mass_ratio: MassRatio, guess: f64) -> Option<Self> {
        let map = LiftOffMap::new(mass_ratio);
        let mut point = guess;
        for _ in 0..NEWTON_STEPS {
            let (end, slope, by_mass_ratio) = derivatives(&map, hops, point)?;
            let move_by = FixedPointSpeed::new(n).offset_of(end) / slope;
            point -= move_by;
            if move_by.abs() <= ROUNDING * point {
                let by_mass_ratio = -by_mass_ratio / slope;
                let mass_ratio = mass_ratio.value();
                return Some(FollowedEdge { mass_ratio, n, hops, point, slope, by_mass_ratio });
            }
            if !(point > 0.0 && point.is_finite()) {
                return None;
            }
        }
        None
    }
}

/// dp/dM of the point of a chart, with a bound on its error; `None` if a hop of its orbit is not certain for all
/// speeds within the error of the point.
pub fn enclosed_edge_slope(map: &LiftOffMap, chart: &EdgeChart) -> Option<Enclosed> {
    let (point, rest, error) = chart.point();
    let mut speed = Enclosed { value: point, error: rest.abs() + error };
    let exact = |value: f64| Enclosed { value, error: 0.0 };
    let (mut slope, mut by_mass_ratio) = (exact(1.0), exact(0.0));
    for _ in 0..chart.hops() {
        let hop = map.enclosed_hop(speed.value, speed.error).ok()?;
        // The mean value theorem bounds the next speed a hundred times more narrowly than the enclosed landings.
        let middle = map.enclosed_hop(speed.value, 0.0).ok()?;
        let off = Enclosed { value: 0.0, error: speed.error };
        speed = middle.next?.plus(hop.by_speed?.times(off));
        by_mass_ratio = hop.by_mass_ratio?.plus(hop.by_speed?.times(by_mass_ratio));
        slope = slope.times(hop.by_speed?);
    }
    let found = exact(-1.0).times(by_mass_ratio).over(slope);
    found.error.is_finite().then_some(found)
}

/// f^k at a speed, with its derivatives by the speed and by the mass ratio; `None` if the orbit ends, or a
/// derivative is not finite or 0.
fn derivatives(map: &LiftOffMap, hops: usize, start: f64) -> Option<(f64, f64, f64)> {
    let (mut speed, mut slope, mut by_mass_ratio) = (start, 1.0, 0.0);
    for _ in 0..hops {
        let slopes = map.slopes(speed).ok()??;
        speed = map.image(speed).ok()??;
        by_mass_ratio = slopes.by_mass_ratio + slopes.by_speed * by_mass_ratio;
        slope *= slopes.by_speed;
    }
    (slope != 0.0 && slope.is_finite() && by_mass_ratio.is_finite()).then_some((
        speed,
        slope,
        by_mass_ratio,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// dp/dM is enclosed to many digits, and holds the slope along the orbit in `f64`.
    #[test]
    fn slopes_of_edges_are_enclosed() {
        for (m, speed) in [(0.12, 11.92), (0.12, 11.9206)] {
            let fates = Fates::new(MassRatio::new(m).unwrap()).unwrap();
            let chart = EdgeChart::near(&fates, speed).unwrap();
            let edge = FollowedEdge::new(&chart).unwrap();
            let found = enclosed_edge_slope(fates.map(), &chart).unwrap();
            let off = (found.value - edge.by_mass_ratio).abs();
            assert!(off <= found.error + 1e-9 * off.max(found.value.abs()), "{found:?} {edge:?}");
            assert!(found.error < 1e-6 * found.value.abs(), "{found:?}");
        }
    }
}
