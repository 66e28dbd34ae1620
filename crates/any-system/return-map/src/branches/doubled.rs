//! The branch of twice the period behind a doubling, and cascades of doublings.

use super::branch::{Bifurcation, BifurcationKind, Branch, BranchEnd, BranchPoint};
use super::continued::SAME;
use super::curve::{Curve, OnCurve, corrected, scaled_slopes};
use super::follow::{BranchSteps, Follower, follow_branch, point_of, predicted};
use super::orbit::{Kind, Orbit, split};
use super::start::{none_near, scales};
use super::tests::CRITICAL;
use crate::checks::{check_dimension, check_period};
use crate::error::Error;
use crate::families::MapFamily;
use crate::multipliers::eigenvalues;
use nalgebra::{Complex, DMatrix, DVector};
use std::ops::ControlFlow;

/// The branch of twice the period that begins at a doubling. It is followed in one direction: in the other one are the same orbits, from
/// their other points. Its first point is the first step from the doubling.
///
/// # Errors
/// [`Error::OtherStart`] if the bifurcation is no doubling; [`Error::BadArgument`] if it is outside of the window; [`Error::OtherBranch`] if it
/// is none of this map with this period; [`Error::NoPeriodicPoint`] if no point is found beside it.
pub fn doubled_branch<M: MapFamily + ?Sized>(
    map: &M,
    (period, doubling): (usize, &Bifurcation),
    window: (f64, f64),
    steps: BranchSteps,
    mut see: impl FnMut(&BranchPoint) -> ControlFlow<()>,
) -> Result<Branch, Error> {
    if doubling.kind != BifurcationKind::Doubling || doubling.direction.is_empty() {
        let (needed, found) = ("a doubling with its direction", format!("{:?}", doubling.kind));
        return Err(Error::OtherStart { needed, found });
    }
    check_period(period.saturating_mul(2))?;
    let at = &doubling.at;
    check_dimension("the direction of a doubling", at.point.len(), doubling.direction.len())?;
    super::start::check(map, (&at.point, at.parameter), window, steps)?;
    let scales = scales(at.point.len(), at.size, &[window]);
    let orbit = Orbit { map, kind: Kind::Periodic(2 * period), scales };
    // The eigenvector, without a change of the parameter.
    let mut tangent = DVector::from_column_slice(&doubling.direction).push(0.0);
    tangent.component_div_assign(&orbit.scales);
    tangent /= tangent.norm();
    let start = DVector::from_column_slice(&at.point).push(at.parameter);
    let slopes = DMatrix::zeros(start.len() - 1, start.len());
    let errors = slopes.clone();
    let root = OnCurve { at: start, tangent, slopes, errors, error: at.error, steps: 0 };
    let single = Orbit { map, kind: Kind::Periodic(period), scales: orbit.scales.clone() };
    check_doubling(&single, &root.at)?;
    let mut length = steps.first;
    while length >= steps.shortest {
        let predicted = predicted(&orbit.scales, &root, length);
        let first = corrected(&orbit, &predicted, &root.tangent).ok().flatten();
        // The points of the single period solve the equations too.
        let is_double = |first: &OnCurve| {
            let off = single.values(&first.at).ok();
            off.is_some_and(|off| off.push(0.0).component_div(&orbit.scales).norm() > length)
        };
        if let Some(first) = first.filter(is_double)
            && let Ok(itinerary) = orbit.itinerary(&first.at)
        {
            let start = point_of(&orbit, &first, itinerary.clone());
            let mut points = vec![start.clone()];
            let stopped = see(&start).is_break();
            let mut bifurcations = Vec::new();
            let mut end = BranchEnd::Stopped;
            if !stopped {
                let steps = BranchSteps { first: length, ..steps };
                let mut follower = Follower { orbit, window, steps, see: &mut see };
                let way = follower.one_way(first, &itinerary);
                (bifurcations, end) = (way.located, way.end);
                points.extend(way.points);
            }
            let ends = [BranchEnd::Doubling, end];
            return Ok(Branch { period: 2 * period, points, bifurcations, ends });
        }
        length *= 0.5;
    }
    Err(map.stopped().unwrap_or_else(|| none_near(&orbit, &root.at)))
}

/// An error for a point that is none of this period, or does not double.
fn check_doubling<M: MapFamily + ?Sized>(
    single: &Orbit<'_, M>,
    at: &DVector<f64>,
) -> Result<(), Error> {
    let off = single.values(at)?.push(0.0).component_div(&single.scales).norm();
    let flips = |m: &Complex<f64>| (m + 1.0).norm() < CRITICAL;
    let slopes = scaled_slopes(single, at)?.matrix;
    let (point, parameter) = split(at);
    match off <= SAME && eigenvalues(&single.derivative(&slopes)).iter().any(flips) {
        true => Ok(()),
        false => Err(Error::OtherBranch { point, parameter }),
    }
}

/// A cascade of doublings: the branch through a point, the branch of twice the period behind its doubling that is nearest to the start in
/// the parameter, and so on, up to `depth` doublings. The k-th one, counted from 0, is that of an orbit of period `period`·2ᵏ. Each doubled
/// branch is followed up to its first doubling, and the steps get shorter as the doublings come closer.
///
/// `see` receives each doubling as it is found. If it breaks, the cascade ends there.
///
/// ```
/// use return_map::{BranchSteps, cascade, scalar_family};
/// use std::ops::ControlFlow::Continue;
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let steps = BranchSteps::default();
/// let doublings = cascade(&logistic, 1, (&[0.6], 2.8), (2.5, 4.0), steps, 4, |_| Continue(()))?;
/// let exact = [3.0, 1.0 + 6f64.sqrt(), 3.5440903596, 3.5644072661];
/// for (found, exact) in doublings.iter().zip(exact) {
///     assert!((found.at.parameter - exact).abs() < 1e-8);
/// }
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// As [`follow_branch`]. A branch without a doubling ends the cascade, whose doublings stay. [`Error::Stopped`] by a watched map: `see` has
/// received what was found.
pub fn cascade<M: MapFamily + ?Sized>(
    map: &M,
    period: usize,
    start: (&[f64], f64),
    window: (f64, f64),
    steps: BranchSteps,
    depth: usize,
    mut see: impl FnMut(&Bifurcation) -> ControlFlow<()>,
) -> Result<Vec<Bifurcation>, Error> {
    let mut doublings: Vec<Bifurcation> = Vec::new();
    let is_doubling = |found: &&Bifurcation| found.kind == BifurcationKind::Doubling;
    let branch = follow_branch(map, period, start, window, steps, |_| ControlFlow::Continue(()))?;
    let off = |found: &Bifurcation| (found.at.parameter - start.1).abs();
    let nearest = |a: &&Bifurcation, b: &&Bifurcation| off(a).total_cmp(&off(b));
    let mut next = branch.bifurcations.iter().filter(is_doubling).min_by(nearest).cloned();
    let (mut period, mut steps) = (period, steps);
    while let Some(doubling) = next.take() {
        if doublings.len() >= depth {
            break;
        }
        let before = doublings.last().cloned();
        doublings.push(doubling.clone());
        if see(&doubling).is_break() || doublings.len() == depth {
            break;
        }
        // The branch up to the next doubling is some 2.5 times smaller than the last one.
        if let Some(before) = before {
            let size = doubling.at.point.iter().fold(0.0, |size: f64, x| size.max(x.abs()));
            let off = doubling.at.point.iter().zip(&before.at.point).map(|(a, b)| (a - b) / size);
            let off = off.fold(0.0, |sum, off| sum + off * off).sqrt();
            let along = (doubling.at.parameter - before.at.parameter) / (window.1 - window.0);
            steps.longest = steps.longest.min(CASCADE_STEP * off.max(along.abs()));
            steps.first = steps.first.min(steps.longest);
        }
        // It is stopped behind its first doubling.
        let mut critical: Option<bool> = None;
        let see = |point: &BranchPoint| {
            let flips = point.multipliers.iter().filter(|m| m.im == 0.0 && m.re < -1.0).count();
            let is_odd = flips % 2 == 1;
            match critical.replace(is_odd) {
                Some(before) if before != is_odd => ControlFlow::Break(()),
                _ => ControlFlow::Continue(()),
            }
        };
        // A branch that is not found ends the cascade, whose doublings stay.
        let Ok(branch) = doubled_branch(map, (period, &doubling), window, steps, see) else {
            break;
        };
        period *= 2;
        next = branch.bifurcations.into_iter().find(|found| is_doubling(&found));
    }
    map.stopped().map_or(Ok(doublings), Err)
}

/// The longest step on a doubled branch, as a part of the distance of the last two doublings: some twenty steps up to the next one.
const CASCADE_STEP: f64 = 0.02;
