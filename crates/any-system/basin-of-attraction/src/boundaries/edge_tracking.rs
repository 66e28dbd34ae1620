//! Edge tracking: an orbit on the boundary between two basins, followed by pairs of states on its two sides.
//!
//! An orbit that starts beside the boundary leaves it. A pair of states, one in each basin, follows the boundary
//! until its distance has grown; then it is bisected again, and so on. The pair approaches the attractor inside the
//! boundary, the *edge state*, which is a saddle of the whole system (J. D. Skufca, J. A. Yorke, B. Eckhardt, Phys.
//! Rev. Lett. 96, 174101, 2006; `edgetracking` of Attractors.jl).

use crate::attractors::state_map::{Moving, StateMap};
use crate::boundaries::boundary_between::{BoundaryBracket, boundary_between};
use crate::error::Error;
use crate::space::label::Label;
use crate::space::vectors::distance;

/// When a pair of states is bisected again, and when the tracking ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeLimits {
    /// Distance of the pair after each bisection.
    pub bisect: f64,
    /// Distance at which the pair is bisected again.
    pub separate: f64,
    /// Most steps between two bisections. More are needed where the boundary repels slowly, in proportion to
    /// ln(`separate`/`bisect`).
    pub steps: usize,
    /// Most bisections.
    pub rounds: usize,
    /// The tracking ends when the pair moves by less than this from one bisection to the next.
    pub still: f64,
}

impl Default for EdgeLimits {
    /// Bisects to 10⁻⁹ and again at 10⁻⁷, up to 10⁴ steps later and a thousand times, until the pair moves by less
    /// than 10⁻⁸.
    ///
    /// The edge state is then right to about 10⁻⁷. Smaller distances come closer to it, down to the rounding of the
    /// map.
    fn default() -> Self {
        EdgeLimits { bisect: 1e-9, separate: 1e-7, steps: 10_000, rounds: 1000, still: 1e-8 }
    }
}

/// Why edge tracking ended.
#[derive(Debug, Clone, PartialEq)]
pub enum EdgeEnd {
    /// The pair moves by less than [`EdgeLimits::still`]: it is at a fixed point of the steps.
    Settled,
    /// All rounds were made, and the pair still moves: the edge state is a cycle or a chaotic set, or is approached
    /// slowly.
    Rounds,
    /// The pair did not separate in [`EdgeLimits::steps`] steps.
    Together,
    /// A bisection came to a state that belongs to no known basin. It is in the bracket.
    Undecided,
    /// The pair has separated, and both its states have this label: the labelling is not constant along orbits.
    SameLabel(Label),
    /// The map has no value at a state of the pair, one that is not finite, or one of another dimension.
    Stopped,
}

/// An orbit on the boundary between two basins.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeTrack {
    /// The middle of the pair after each bisection.
    pub points: Vec<Vec<f64>>,
    /// The last pair.
    pub bracket: BoundaryBracket,
    /// Why the tracking ended.
    pub end: EdgeEnd,
}

/// Follows the boundary between the basins of two states.
///
/// `map` is a map, or a flow over a short time; `label` must be constant along its orbits.
///
/// ```
/// use basin_of_attraction::{EdgeEnd, EdgeLimits, Label, track_edge};
/// // (x, y) → (3x/2 − x³/2, y/2): the basins of (−1, 0) and (1, 0) meet at x = 0, where (0, 0) is a saddle.
/// let map = |z: &[f64]| Some(vec![1.5 * z[0] - 0.5 * z[0] * z[0] * z[0], 0.5 * z[1]]);
/// let label = |z: &[f64]| Label::from(z[0] > 0.0);
/// let track = track_edge(&[-0.5, 1.0], &[1.0, 0.7], &map, label, EdgeLimits::default())?;
/// assert_eq!(track.end, EdgeEnd::Settled);
/// assert!(track.bracket.middle().iter().all(|x| x.abs() < 1e-7));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// Those of [`boundary_between`] for the two states; [`Error::BadSearch`] unless `bisect`, `separate` and `still`
/// are positive and finite, and `separate` is larger than `bisect`.
pub fn track_edge(
    first: &[f64],
    second: &[f64],
    map: &dyn StateMap,
    label: impl Fn(&[f64]) -> Label,
    limits: EdgeLimits,
) -> Result<EdgeTrack, Error> {
    for (name, value) in
        [("a distance to separate", limits.separate), ("a stillness", limits.still)]
    {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Error::BadSearch { name, value, remedy: "" });
        }
    }
    if limits.separate <= limits.bisect {
        let remedy = ", and larger than the distance to which a pair is bisected";
        return Err(Error::BadSearch {
            name: "a distance to separate",
            value: limits.separate,
            remedy,
        });
    }
    let mut bracket = boundary_between(first, second, limits.bisect, &label)?;
    let mut points = vec![bracket.middle()];
    let end = loop {
        if bracket.undecided.is_some() {
            break EdgeEnd::Undecided;
        }
        if points.len() > limits.rounds {
            break EdgeEnd::Rounds;
        }
        let pair = match separated(&bracket, map, &limits) {
            Ok(pair) => pair,
            Err(end) => break end,
        };
        bracket = match boundary_between(&pair.0, &pair.1, limits.bisect, &label) {
            Ok(bracket) => bracket,
            Err(Error::NotTwoBasins { first, second }) if first == second && first.is_decided() => {
                break EdgeEnd::SameLabel(first);
            }
            Err(Error::NotTwoBasins { first, second }) => {
                let states = if first.is_decided() { (pair.1, second) } else { (pair.0, first) };
                bracket.undecided = Some(states);
                continue;
            }
            Err(error) => return Err(error),
        };
        let at = bracket.middle();
        let moved = points.last().map_or(f64::INFINITY, |last| distance(last, &at));
        points.push(at);
        if moved < limits.still {
            break EdgeEnd::Settled;
        }
    };
    Ok(EdgeTrack { points, bracket, end })
}

/// The pair after so many steps that it is separated.
fn separated(
    bracket: &BoundaryBracket,
    map: &dyn StateMap,
    limits: &EdgeLimits,
) -> Result<(Vec<f64>, Vec<f64>), EdgeEnd> {
    let (mut one, mut other) = (Moving::from(&bracket.first.0), Moving::from(&bracket.second.0));
    let next = |point: &mut Moving| {
        let found = point.step(map) && point.at.iter().all(|x| x.is_finite());
        if found { Ok(()) } else { Err(EdgeEnd::Stopped) }
    };
    for _ in 0..limits.steps {
        next(&mut one)?;
        next(&mut other)?;
        if distance(&one.at, &other.at) > limits.separate {
            return Ok((one.at, other.at));
        }
    }
    Err(EdgeEnd::Together)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cubic(z: &[f64]) -> Option<Vec<f64>> {
        Some(vec![1.5 * z[0] - 0.5 * z[0] * z[0] * z[0], 0.5 * z[1]])
    }

    #[test]
    fn tracking_says_why_it_ends() {
        let label = |z: &[f64]| Label::from(z[0] > 0.0);
        let limits = EdgeLimits::default();
        let end = |map: fn(&[f64]) -> Option<Vec<f64>>, label: fn(&[f64]) -> Label, limits| {
            track_edge(&[-0.5, 1.0], &[1.0, 0.7], &map, label, limits).unwrap().end
        };
        assert_eq!(end(|_| None, label, limits), EdgeEnd::Stopped);
        assert_eq!(end(|_| Some(Vec::new()), label, limits), EdgeEnd::Stopped);
        assert_eq!(end(|z| Some(z[..1].to_vec()), label, limits), EdgeEnd::Stopped);
        assert_eq!(end(|z| Some(z.to_vec()), label, limits), EdgeEnd::Together);
        let few = EdgeLimits { rounds: 2, still: 1e-300, ..limits };
        assert_eq!(end(cubic, label, few), EdgeEnd::Rounds);
        let shifting: fn(&[f64]) -> Label = |z| Label::from(z[0] > 0.0 && z[1] > 0.5);
        assert_eq!(end(cubic, shifting, limits), EdgeEnd::SameLabel(Label::from(0)));
        let gap: fn(&[f64]) -> Label =
            |z| if z[0].abs() < 1e-8 { Label::UNDECIDED } else { Label::from(z[0] > 0.0) };
        let track = track_edge(&[-0.5, 1.0], &[1.0, 0.7], &cubic, gap, limits).unwrap();
        assert_eq!(track.end, EdgeEnd::Undecided);
        assert!(gap(&track.bracket.undecided.unwrap().0).is_undecided());
        let bad = EdgeLimits { separate: 1e-10, ..limits };
        assert!(track_edge(&[-0.5, 1.0], &[1.0, 0.7], &cubic, label, bad).is_err());
    }
}
