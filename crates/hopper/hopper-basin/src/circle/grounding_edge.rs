//! Edges of grounding: speeds from which a hop just uses up the energy.

use crate::circle::edge_window::slant;
use crate::circle::nearest_edge::{changes, narrowed};
use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use passive_hopper::{MassRatio, alpha_star, index_below};

/// Distances within which a change of fates is looked for, before those up to the nearest fixed point: a speed that is given to its last bit, or from
/// a picture, has its own edge.
const NEAR: [f64; 2] = [1e-9, 1e-5];

/// Changes that are tried, the nearest first.
const CHANGES: usize = 24;

/// How many spacings of doubles α′² may differ from 0 on both sides of an edge, in those of its slope: the two speeds are
/// neighbours, and orbits have rounding of their own.
const SPACINGS: f64 = 64.0;

/// An edge of grounding: a speed p at which α′² of the hop number `hops` is 0. On one side this hop ends on the ground. On the other side the hopper
/// lifts off once more, by
///
/// ```text
///   α′ = √(growth · |α − p|) (1 + O(|α − p|^½))
/// ```
///
/// and hops ever lower. So the picture is the same at every scale: the orbits on either side come to one end.
///
/// ```
/// use hopper_basin::{Fates, GroundingEdge, HopperFate};
/// use passive_hopper::MassRatio;
/// let fates = Fates::new(MassRatio::ONE)?;
/// let edge = GroundingEdge::nearest(&fates, 5.6)?;
/// assert_eq!((edge.hops, edge.hops_above), (1, false));
/// // 10⁻⁸ below the edge the next speed is that of the law, to its half power.
/// let next = fates.map().image(edge.point - 1e-8)?.expect("hops");
/// assert!((next / (1e-8 * edge.growth).sqrt() - 1.0).abs() < 1e-3);
/// # Ok::<(), hopper_basin::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GroundingEdge {
    /// M.
    pub mass_ratio: MassRatio,
    /// p, in units of m₂gω/k: the edge is between it and the next number towards the ground.
    pub point: f64,
    /// The number of the hop that ends on the ground.
    pub hops: usize,
    /// Whether the hopper goes on above p, and not below it.
    pub hops_above: bool,
    /// |∂(α′²)/∂α| at p, in units of the model's speed.
    pub growth: f64,
    /// dp/dM.
    pub by_mass_ratio: f64,
}

impl GroundingEdge {
    /// The edge of grounding nearest to a speed, of those that a grid of 801 speeds up to the nearest α*_n shows.
    ///
    /// # Errors
    /// [`Error::NoGroundingEdge`] if there is none; the errors of [`Fates::labels`] for a wrong speed.
    pub fn nearest(fates: &Fates, guess: f64) -> Result<GroundingEdge, Error> {
        let below = index_below(guess)?;
        let to_star = |n: u64| (alpha_star(n) - guess).abs();
        let farthest = to_star(below.max(1)).min(to_star(below + 1));
        for within in NEAR.into_iter().chain([farthest]) {
            for change in changes(fates, guess, within)?.into_iter().take(CHANGES) {
                let ends = fates.labels(&[change.0, change.1])?;
                if !ends.contains(&HopperFate::GROUNDED) {
                    continue;
                }
                let [left, right] = narrowed(fates, change)?;
                if let Some(found) = GroundingEdge::between(fates, left, right)? {
                    return Ok(found);
                }
            }
        }
        Err(Error::NoGroundingEdge { alpha: guess, within: farthest })
    }

    /// The edge between two neighbouring doubles with different fates, if it is one of grounding.
    fn between(fates: &Fates, left: f64, right: f64) -> Result<Option<GroundingEdge>, Error> {
        let labels = fates.labels(&[left, right])?;
        let is_grounded = |k: usize| labels[k] == HopperFate::GROUNDED;
        let (point, beyond) = match (is_grounded(0), is_grounded(1)) {
            (false, true) => (left, right),
            (true, false) => (right, left),
            _ => return Ok(None),
        };
        // The orbit on the ground's side has the number of the hop that ends there.
        let map = fates.map();
        let (_, hops) = fates.fate_within(beyond, crate::HOP_BUDGET)?;
        let (mut speed, mut by_speed, mut by_ratio) = (point, 1.0, 0.0);
        for _ in 1..hops {
            let (Some(slopes), Some(next)) = (map.slopes(speed)?, map.image(speed)?) else {
                return Ok(None);
            };
            by_ratio = slopes.by_speed * by_ratio + slopes.by_mass_ratio;
            by_speed *= slopes.by_speed;
            speed = next;
        }
        let (last, Some(slopes)) = (map.hop(speed)?, map.slopes(speed)?) else { return Ok(None) };
        let Some(next) = last.next else { return Ok(None) };
        // Both factors are finite together: ∂α′/∂α grows as 1/α′.
        let square_by_speed = 2.0 * next * slopes.by_speed * by_speed;
        let square_by_ratio = 2.0 * next * (slopes.by_speed * by_ratio + slopes.by_mass_ratio);
        let spacing = (right - left) * square_by_speed.abs();
        let grows_here = square_by_speed * (point - beyond) > 0.0;
        let is_edge = last.next_speed_squared <= SPACINGS * spacing && grows_here;
        Ok(is_edge.then_some(GroundingEdge {
            mass_ratio: map.mass_ratio(),
            point,
            hops,
            hops_above: point > beyond,
            growth: square_by_speed.abs(),
            by_mass_ratio: -square_by_ratio / square_by_speed,
        }))
    }

    /// The half width of a window in mass ratio, divided by its half height in speed: as [`frame_slant`](crate::frame_slant).
    pub fn slant(&self) -> f64 {
        slant(self.mass_ratio.value(), self.point, self.by_mass_ratio)
    }

    /// log₁₀ of the speed after the last hop at the distance 10^{−`depth`} from p, on the side that hops.
    pub fn last_speed_exponent(&self, depth: f64) -> f64 {
        0.5 * (pxfm::f_log10(self.growth) - depth)
    }
}
