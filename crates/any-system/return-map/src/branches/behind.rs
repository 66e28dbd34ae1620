//! The branch on the other side of a border.

use super::branch::{Branch, BranchEnd, BranchPoint};
use super::curve::corrected;
use super::follow::{BranchSteps, Follower};
use super::orbit::{Kind, Orbit};
use super::start::{check, scales};
use crate::checks::check_period;
use crate::error::Error;
use crate::families::MapFamily;
use nalgebra::DVector;
use std::ops::ControlFlow;

/// The first point is no further from the border than this, in units of the size of the point: others belong to other branches.
const NEAR: f64 = 0.1;

/// How often the distance from the border is doubled, from the shortest step on: up to a twentieth of the window for the default steps.
const DOUBLINGS: i32 = 30;

/// The branch with the pieces that lie behind a border at which another one has ended: in the direction in which there is one, where the orbit
/// persists, or in the other one, where two branches meet. It is followed in both directions, and so comes back to the border.
///
/// ```
/// use return_map::{BranchEnd, BranchSteps, follow_behind, follow_branch, pieces};
/// use std::ops::ControlFlow::Continue;
/// // x ↦ p + x/2 for x < 0, p − x for x > 0: the fixed point goes on as another one.
/// let map = pieces(1, |x: &[f64], p| match x[0] < 0.0 {
///     true => Ok((vec![p + 0.5 * x[0]], "left")),
///     false => Ok((vec![p - x[0]], "right")),
/// });
/// let steps = BranchSteps::default();
/// let left = follow_branch(&map, 1, (&[-1.0], -0.5), (-1.0, 1.0), steps, |_| Continue(()))?;
/// let right = follow_behind(&map, 1, &left.ends[1], (-1.0, 1.0), steps, |_| Continue(()))?;
/// assert!(right.points.iter().all(|at| (at.point[0] - 0.5 * at.parameter).abs() < 1e-12));
/// assert_eq!(right.ends[1], BranchEnd::Window);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::OtherStart`] for an end that is no border; [`Error::NothingBehind`] if no point with the pieces behind it is found on either side:
/// beside a grazing the orbits with an impact may be far away. Those of [`follow_branch`](super::follow_branch).
pub fn follow_behind<M: MapFamily + ?Sized>(
    map: &M,
    period: usize,
    end: &BranchEnd,
    window: (f64, f64),
    steps: BranchSteps,
    mut see: impl FnMut(&BranchPoint) -> ControlFlow<()>,
) -> Result<Branch, Error> {
    check_period(period)?;
    let BranchEnd::Border { at, beyond, .. } = end else {
        let needed = "the end of a branch at a border";
        return Err(Error::OtherStart { needed, found: format!("{end:?}") });
    };
    check(map, (&at.point, at.parameter), window, steps)?;
    let scales = scales(at.point.len(), at.size, &[window]);
    let orbit = Orbit { map, kind: Kind::Periodic(period), scales };
    let mut along = DVector::zeros(at.point.len() + 1);
    along[at.point.len()] = 1.0;
    for doubling in 0..DOUBLINGS {
        let distance = steps.shortest * 2f64.powi(doubling) * (window.1 - window.0);
        for side in [1.0, -1.0] {
            let parameter = at.parameter + side * distance;
            if !(window.0 <= parameter && parameter <= window.1) {
                continue;
            }
            // On the border itself the map may have no derivative: beside it along each component.
            let start = DVector::from_column_slice(&at.point).push(parameter);
            let moved = (0..2 * at.point.len()).map(|k| {
                let mut moved = start.clone();
                moved[k / 2] += if k % 2 == 0 { distance } else { -distance } * at.size;
                moved
            });
            let found = [start.clone()].into_iter().chain(moved).find_map(|start| {
                let found = corrected(&orbit, &start, &along).ok().flatten()?;
                let off = (&found.at - &start).component_div(&orbit.scales).norm();
                if off > NEAR {
                    return None;
                }
                orbit.itinerary(&found.at).is_ok_and(|own| own == *beyond).then_some(found)
            });
            if let Some(found) = found {
                let mut follower = Follower { orbit, window, steps, see: &mut see };
                return follower.both_ways(found);
            }
        }
    }
    let (point, parameter) = (at.point.clone(), at.parameter);
    let beyond = beyond.join(", ");
    Err(map.stopped().unwrap_or(Error::NothingBehind { point, parameter, beyond }))
}
