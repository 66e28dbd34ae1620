//! Follows a branch from a point in both directions.

use super::branch::{Bifurcation, Branch, BranchEnd, BranchPoint};
use super::curve::{OnCurve, STRAIGHT, corrected, tangent};
use super::locate::between;
use super::orbit::{Kind, Orbit, split};
use super::start::{check, check_direction, scales, size_of, solved};
use crate::checks::check_period;
use crate::error::Error;
use crate::families::{Clearance, MapFamily};
use nalgebra::DVector;
use std::ops::ControlFlow;

/// How a branch is followed. Lengths are in units of the size of the first point, and of the width of the window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BranchSteps {
    /// The length of the first step.
    pub first: f64,
    /// The longest step. Two bifurcations of one kind within one step would be missed.
    pub longest: f64,
    /// The shortest step, behind which the branch is lost.
    pub shortest: f64,
    /// The most points in one direction.
    pub points: usize,
}

impl Default for BranchSteps {
    /// A hundredth, a fiftieth, 10⁻¹⁰, and ten thousand points.
    fn default() -> Self {
        BranchSteps { first: 0.01, longest: 0.02, shortest: 1e-10, points: 10_000 }
    }
}

/// The curve is no further from the end of a step along the tangent than this part of the step: it turns by no more than the largest
/// angle. Another branch beside it is.
pub(super) const ASIDE: f64 = 0.35;

/// After a step with at most so many Newton steps the next one is longer by this factor.
const QUICK: usize = 4;
pub(super) const LONGER: f64 = 1.5;

/// The branch of points of period `period` through a point near `start` at the parameter `parameter`, in the window of parameters, in
/// both directions.
///
/// `see` receives each point as it is found; if it breaks, the branch ends there in this direction, and is followed in the other one.
/// An end of the window is met exactly. The step adapts to the curve, and never passes to other pieces of the map: there the branch
/// ends with the reason.
///
/// ```
/// use return_map::{BifurcationKind, BranchSteps, follow_branch, scalar_family};
/// use std::ops::ControlFlow::Continue;
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let steps = BranchSteps::default();
/// let branch = follow_branch(&logistic, 1, (&[0.6], 2.5), (1.5, 3.5), steps, |_| Continue(()))?;
/// let doubling = &branch.bifurcations[0];
/// assert_eq!(doubling.kind, BifurcationKind::Doubling);
/// assert!((doubling.at.parameter - 3.0).abs() < 1e-9);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadArgument`] for a window that is empty or does not contain the parameter, and for steps that are not positive;
/// [`Error::NoPeriodicPoint`] if there is no point near the start, [`Error::Singular`] if branches cross at it; errors of the map there. An error further on ends the branch, whose
/// points stay.
pub fn follow_branch<M: MapFamily + ?Sized>(
    map: &M,
    period: usize,
    start: (&[f64], f64),
    window: (f64, f64),
    steps: BranchSteps,
    see: impl FnMut(&BranchPoint) -> ControlFlow<()>,
) -> Result<Branch, Error> {
    check_period(period)?;
    follow(map, Kind::Periodic(period), start, window, steps, see)
}

/// The branch of equilibria of a field f(x; p), the points with f = 0: as [`follow_branch`]. A [`MapFamily`] is taken for the field: its
/// image of x is the rate ẋ. A bifurcation at which a cycle begins is a [Hopf](super::branch::BifurcationKind::Hopf) bifurcation.
///
/// ```
/// use return_map::{BifurcationKind, BranchSteps, family, follow_equilibria};
/// use std::ops::ControlFlow::Continue;
/// // Van der Pol's oscillator: a cycle begins where the damping changes its sign.
/// let field = family(2, |x, mu| Ok(vec![x[1], mu * x[1] - x[0] - x[0] * x[0] * x[1]]));
/// let steps = BranchSteps::default();
/// let branch = follow_equilibria(&field, (&[0.0, 0.0], -0.5), (-1.0, 1.0), steps, |_| Continue(()))?;
/// let hopf = &branch.bifurcations[0];
/// assert_eq!(hopf.kind, BifurcationKind::Hopf);
/// assert!(hopf.at.parameter.abs() < 1e-10 && hopf.coefficient.is_some_and(|l| l < 0.0));
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// As [`follow_branch`].
pub fn follow_equilibria<M: MapFamily + ?Sized>(
    field: &M,
    start: (&[f64], f64),
    window: (f64, f64),
    steps: BranchSteps,
    see: impl FnMut(&BranchPoint) -> ControlFlow<()>,
) -> Result<Branch, Error> {
    follow(field, Kind::Equilibrium, start, window, steps, see)
}

fn follow<M: MapFamily + ?Sized>(
    map: &M,
    kind: Kind,
    (start, parameter): (&[f64], f64),
    window: (f64, f64),
    steps: BranchSteps,
    mut see: impl FnMut(&BranchPoint) -> ControlFlow<()>,
) -> Result<Branch, Error> {
    check(map, (start, parameter), window, steps)?;
    let orbit = Orbit { map, kind, scales: scales(start.len(), size_of(start), &[window]) };
    let first = solved(&orbit, (start, parameter))?;
    check_direction(&orbit, &first)?;
    let mut follower = Follower { orbit, window, steps, see: &mut see };
    follower.both_ways(first)
}

/// Follows a branch.
pub(super) struct Follower<'a, M: ?Sized, S> {
    pub(super) orbit: Orbit<'a, M>,
    pub(super) window: (f64, f64),
    pub(super) steps: BranchSteps,
    pub(super) see: &'a mut S,
}

/// Bifurcations of one kind at the first point that are so close, in units of the scales, are one: a crossing is located to some 10⁻⁹.
const SAME: f64 = 1e-7;

/// What a step leads to.
enum Step {
    /// The next point, with the clearances of its orbit and the bifurcations on the way; true if it is the last one, at the end of the window.
    To { next: OnCurve, clearances: Vec<Clearance>, located: Vec<Bifurcation>, leaves: bool },
    /// The end of the branch.
    Ends(BranchEnd),
    /// A shorter step is needed, with the reason.
    TooLong(String),
}

const TOO_LONG: &str = "the tangent turns faster than the shortest step";

/// One direction of a branch.
pub(super) struct OneWay {
    pub(super) points: Vec<BranchPoint>,
    pub(super) located: Vec<Bifurcation>,
    pub(super) end: BranchEnd,
}

impl<M: MapFamily + ?Sized, S: FnMut(&BranchPoint) -> ControlFlow<()>> Follower<'_, M, S> {
    fn period(&self) -> usize {
        match self.orbit.kind {
            Kind::Periodic(period) => period,
            Kind::Equilibrium => 0,
        }
    }

    pub(super) fn both_ways(&mut self, first: OnCurve) -> Result<Branch, Error> {
        let itinerary = self.orbit.itinerary(&first.at)?;
        let start = point_of(&self.orbit, &first, itinerary.clone());
        if (self.see)(&start).is_break() {
            let ends = [BranchEnd::Stopped, BranchEnd::Stopped];
            let (points, bifurcations) = (vec![start], Vec::new());
            return Ok(Branch { period: self.period(), points, bifurcations, ends });
        }
        let back = OnCurve { tangent: -&first.tangent, ..first.clone() };
        let forward = self.one_way(first, &itinerary);
        // A closed branch has one direction.
        if matches!(forward.end, BranchEnd::Closed) {
            let mut points = vec![start];
            points.extend(forward.points);
            let ends = [BranchEnd::Closed, BranchEnd::Closed];
            return Ok(Branch {
                period: self.period(),
                points,
                bifurcations: forward.located,
                ends,
            });
        }
        let mut backward = self.one_way(back, &itinerary);
        backward.points.reverse();
        backward.located.reverse();
        // A bifurcation at the first point may be seen from both sides.
        if let (Some(before), Some(behind)) = (backward.located.last(), forward.located.first())
            && before.kind == behind.kind
            && self.is_same(&before.at, &behind.at)
        {
            backward.located.pop();
        }
        let points = backward.points.into_iter().chain([start]).chain(forward.points).collect();
        let bifurcations = backward.located.into_iter().chain(forward.located).collect();
        Ok(Branch {
            period: self.period(),
            points,
            bifurcations,
            ends: [backward.end, forward.end],
        })
    }

    /// Follows the branch in the direction of the tangent.
    pub(super) fn one_way(&mut self, first: OnCurve, itinerary: &[String]) -> OneWay {
        let mut way =
            OneWay { points: Vec::new(), located: Vec::new(), end: BranchEnd::PointLimit };
        let (mut last, mut length) = (first.clone(), self.steps.first.min(self.steps.longest));
        let mut near = self.orbit.clearances(&first);
        let mut reason = String::from(TOO_LONG);
        while way.points.len() < self.steps.points {
            let taken = match length < self.steps.shortest {
                true => Step::Ends(self.lost(&last, itinerary, reason.clone())),
                false => self.taken((&last, &near), length, itinerary),
            };
            // What a map that has no more images seems to be is no result.
            if self.orbit.map.stopped().is_some() {
                way.end = BranchEnd::Stopped;
                return way;
            }
            let (next, leaves) = match taken {
                Step::Ends(end) => {
                    way.end = end;
                    return way;
                }
                Step::TooLong(why) => {
                    reason = why;
                    length *= 0.5;
                    continue;
                }
                Step::To { next, clearances, located, leaves } => {
                    near = clearances;
                    way.located.extend(located);
                    (next, leaves)
                }
            };
            let point = point_of(&self.orbit, &next, itinerary.to_vec());
            let stopped = (self.see)(&point).is_break();
            way.points.push(point);
            if leaves || stopped {
                way.end = if leaves { BranchEnd::Window } else { BranchEnd::Stopped };
                return way;
            }
            if way.points.len() > 2 && next.passes(&last, &first, &self.orbit.scales) {
                way.end = BranchEnd::Closed;
                return way;
            }
            if next.steps <= QUICK {
                length = (length * LONGER).min(self.steps.longest);
            }
            last = next;
        }
        way
    }

    /// What a step of this length leads to.
    fn taken(
        &self,
        (last, near): (&OnCurve, &[Clearance]),
        length: f64,
        itinerary: &[String],
    ) -> Step {
        let too_long = || Step::TooLong(String::from(TOO_LONG));
        let mut next = match self.step(last, length) {
            Ok(Some(next)) => next,
            Ok(None) => return too_long(),
            Err(error) => return Step::TooLong(error.to_string()),
        };
        let leaves = !(self.window.0..=self.window.1).contains(&parameter_of(&next));
        if leaves {
            if [self.window.0, self.window.1].contains(&parameter_of(last)) {
                return Step::Ends(BranchEnd::Window);
            }
            match self.at_window(last, &next) {
                Some(at_end) => next = at_end,
                None => return too_long(),
            }
        }
        match self.orbit.itinerary(&next.at) {
            Ok(own) if own == itinerary => {}
            Ok(other) => {
                let length = self.off(last, &next.at).dot(&last.tangent);
                return match self.border(last, itinerary, other, length) {
                    Some(end) => Step::Ends(end),
                    None => Step::TooLong(String::from("other pieces of the map are beside it")),
                };
            }
            Err(error) => return Step::TooLong(error.to_string()),
        }
        let clearances = self.orbit.clearances(&next);
        if let Some(end) = self.touched((last, near), (&next, &clearances), itinerary) {
            return Step::Ends(end);
        }
        match between(&self.orbit, (last, &next), leaves, itinerary) {
            Some(located) => Step::To { next, clearances, located, leaves },
            None => Step::TooLong(String::from("another branch passes beside it")),
        }
    }

    /// True if two points are one.
    fn is_same(&self, a: &BranchPoint, b: &BranchPoint) -> bool {
        let of =
            |point: &BranchPoint| DVector::from_column_slice(&point.point).push(point.parameter);
        (of(a) - of(b)).component_div(&self.orbit.scales).norm() <= SAME
    }

    /// A step along the tangent; `None` if it is too long.
    pub(super) fn step(&self, last: &OnCurve, length: f64) -> Result<Option<OnCurve>, Error> {
        let predicted = predicted(&self.orbit.scales, last, length);
        let next = corrected(&self.orbit, &predicted, &last.tangent)?;
        Ok(next.filter(|next| self.is_ahead(last, next, length)))
    }

    /// How far unknowns are from a point, in units of the scales.
    fn off(&self, from: &OnCurve, at: &DVector<f64>) -> DVector<f64> {
        (at - &from.at).component_div(&self.orbit.scales)
    }

    /// True if a point is where the tangent leads at this length, and the curve goes on in its direction.
    fn is_ahead(&self, last: &OnCurve, next: &OnCurve, length: f64) -> bool {
        let aside = (self.off(last, &next.at) - length * &last.tangent).norm();
        aside <= ASIDE * length && next.tangent.dot(&last.tangent) > STRAIGHT
    }

    /// The point at the end of the window, between the last point and one outside; `None` if the step is too long.
    fn at_window(&self, last: &OnCurve, next: &OnCurve) -> Option<OnCurve> {
        let place = next.at.len() - 1;
        let end = if parameter_of(next) < self.window.0 { self.window.0 } else { self.window.1 };
        let mut along = DVector::zeros(place + 1);
        along[place] = 1.0;
        let mut predicted = next.at.clone();
        predicted[place] = end;
        let mut found = corrected(&self.orbit, &predicted, &along).ok()??;
        found.tangent = tangent(&found.slopes, &next.tangent)?;
        found.at[place] = end;
        let length = self.off(last, &found.at).dot(&last.tangent);
        self.is_ahead(last, &found, length).then_some(found)
    }
}

fn parameter_of(point: &OnCurve) -> f64 {
    point.at[point.at.len() - 1]
}

/// The unknowns at a length along the tangent.
pub(super) fn predicted(scales: &DVector<f64>, from: &OnCurve, length: f64) -> DVector<f64> {
    &from.at + (length * &from.tangent).component_mul(scales)
}

/// The point of a branch, with its multipliers.
pub(super) fn point_of<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    found: &OnCurve,
    itinerary: Vec<String>,
) -> BranchPoint {
    let (point, parameter) = split(&found.at);
    let mut derivative = orbit.uncertain_derivative(found);
    orbit.add_error_of_point(&mut derivative, found);
    let (multipliers, multiplier_errors) = derivative.eigenvalues();
    let is_stable = orbit.kind.is_stable(&multipliers);
    let (error, size) = (found.error, orbit.scales[0]);
    BranchPoint {
        point,
        parameter,
        multipliers,
        multiplier_errors,
        is_stable,
        itinerary,
        size,
        error,
    }
}
