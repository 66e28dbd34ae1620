//! Goes on with a branch that was stopped, or read from a file.

use super::branch::{Branch, BranchEnd, BranchPoint};
use super::curve::{OnCurve, corrected};
use super::follow::{BranchSteps, Follower};
use super::orbit::{Kind, Orbit};
use super::start::{check, scales};
use crate::checks::{check_period, check_window};
use crate::error::Error;
use crate::families::MapFamily;
use nalgebra::DVector;
use std::ops::ControlFlow;

/// Goes on with a branch at its ends, in a window that may be another one: at those that were stopped, that met their limit of points or a
/// border of the window, and that were lost. The other ends stay.
///
/// ```
/// use return_map::{BranchSteps, continue_branch, follow_branch, scalar_family};
/// use std::ops::ControlFlow::Continue;
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let steps = BranchSteps::default();
/// let first = follow_branch(&logistic, 1, (&[0.6], 2.5), (2.4, 2.6), steps, |_| Continue(()))?;
/// let whole = continue_branch(&logistic, &first, (1.5, 3.5), steps, |_| Continue(()))?;
/// assert_eq!(whole.points.last().map(|point| point.parameter), Some(3.5));
/// assert_eq!(whole.bifurcations.len(), 1);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// As [`follow_branch`](super::follow_branch); [`Error::OtherBranch`] if the end of the branch is no point of this map.
pub fn continue_branch<M: MapFamily + ?Sized>(
    map: &M,
    branch: &Branch,
    window: (f64, f64),
    steps: BranchSteps,
    mut see: impl FnMut(&BranchPoint) -> ControlFlow<()>,
) -> Result<Branch, Error> {
    let kind = match branch.period {
        0 => Kind::Equilibrium,
        period => {
            check_period(period)?;
            Kind::Periodic(period)
        }
    };
    check_window(window)?;
    let Branch { period, mut points, mut bifurcations, mut ends } = branch.clone();
    // Both ends are found before one of them grows.
    let orbit_of = |last: &BranchPoint| {
        let scales = scales(last.point.len(), last.size, &[window]);
        Orbit { map, kind, scales }
    };
    let goes_on = |end: usize| -> Result<Option<(&BranchPoint, OnCurve)>, Error> {
        let is_open = matches!(
            branch.ends[end],
            BranchEnd::Stopped | BranchEnd::PointLimit | BranchEnd::Window | BranchEnd::Lost { .. }
        );
        let inwards = |k: usize| match end {
            0 => branch.points.get(k),
            _ => branch.points.iter().rev().nth(k),
        };
        let is_inside = |p: f64| window.0 < p && p < window.1;
        let last = inwards(0).filter(|last| is_open && is_inside(last.parameter));
        let Some(last) = last else { return Ok(None) };
        check(map, (&last.point, last.parameter), window, steps)?;
        Ok(Some((last, at_end(&orbit_of(last), last, inwards(1))?)))
    };
    for (end, found) in [goes_on(0)?, goes_on(1)?].into_iter().enumerate() {
        let Some((last, first)) = found else { continue };
        let mut follower = Follower { orbit: orbit_of(last), window, steps, see: &mut see };
        let way = follower.one_way(first, &last.itinerary);
        match end {
            0 => {
                points.splice(0..0, way.points.into_iter().rev());
                bifurcations.splice(0..0, way.located.into_iter().rev());
            }
            _ => {
                points.extend(way.points);
                bifurcations.extend(way.located);
            }
        }
        ends[end] = way.end;
    }
    Ok(Branch { period, points, bifurcations, ends })
}

/// How far the end of a branch may be from a point of the map, on its scale: the noise of an integrated map.
pub(super) const SAME: f64 = 1e-6;

/// The end of a branch, with the tangent that leads away from the point before.
fn at_end<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    last: &BranchPoint,
    before: Option<&BranchPoint>,
) -> Result<OnCurve, Error> {
    let of = |point: &BranchPoint| DVector::from_column_slice(&point.point).push(point.parameter);
    let at = of(last);
    let mut along = DVector::zeros(at.len());
    along[at.len() - 1] = 1.0;
    if let Some(before) = before.filter(|before| before.point.len() == last.point.len()) {
        along = (&at - of(before)).component_div(&orbit.scales);
        along /= along.norm();
    }
    let other = || Error::OtherBranch { point: last.point.clone(), parameter: last.parameter };
    let found = corrected(orbit, &at, &along)?.ok_or_else(other)?;
    let off = (&found.at - &at).component_div(&orbit.scales).norm();
    let is_own = off <= SAME && orbit.itinerary(&found.at)? == last.itinerary;
    is_own.then_some(found).ok_or_else(other)
}
