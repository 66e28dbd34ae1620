//! Curves of periodic points with a condition, in two parameters.

use super::branch::BranchPoint;
use super::curve::{Curve, MOST_NEWTON_STEPS, OnCurve, STRAIGHT, corrected};
use super::follow::{BranchSteps, LONGER};
use super::start::{check, scales};
use crate::error::Error;
use crate::families::MapFamily;
use crate::multipliers::Uncertain;
use nalgebra::{DMatrix, DVector};
use std::ops::ControlFlow;

/// A curve of bifurcations in two parameters, from one end to the other.
#[derive(Debug, Clone, PartialEq)]
pub struct BifurcationCurve {
    /// Its points, in order.
    pub points: Vec<BifurcationCurvePoint>,
    /// Why it ends before its first point, and behind its last one.
    pub ends: [CurveEnd; 2],
}

/// A point of a curve of bifurcations.
#[derive(Debug, Clone, PartialEq)]
pub struct BifurcationCurvePoint {
    /// The fixed or periodic point.
    pub point: Vec<f64>,
    /// Both parameters.
    pub parameters: [f64; 2],
    /// How far the point is known: the last Newton step, in units of its size.
    pub error: f64,
}

/// Why a curve of bifurcations ends.
#[derive(Debug, Clone, PartialEq)]
pub enum CurveEnd {
    /// The next point is outside of a window.
    Window,
    /// The curve comes back to its first point.
    Closed,
    /// The limit on the number of points.
    PointLimit,
    /// It was stopped.
    Stopped,
    /// The orbit of the next point meets other pieces of the map.
    Border {
        /// These pieces.
        beyond: Vec<String>,
    },
    /// The next point is no bifurcation any more: where a circle ends at a resonance, two multipliers become real.
    NoBifurcation,
    /// No further point was found, however short the step: with the reason of the last try.
    Lost {
        /// The reason, in words.
        reason: String,
    },
}

/// The windows of both parameters.
pub(super) type Windows = ((f64, f64), (f64, f64));

/// What is zero on a curve: the unknowns are the point and both parameters.
pub(super) trait Condition {
    /// One number more than the point has components.
    fn values(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error>;
    /// Why a point that was found is not on the curve any more.
    fn end(&self, at: &DVector<f64>) -> Option<CurveEnd>;
}

/// The distance of the values of a difference, in units of the scales. Values with an error of 10⁻¹³ give slopes with one of 10⁻¹⁰: enough
/// for Newton's method, which ends where the values themselves are zero.
const REACH: f64 = 1e-3;

struct ConditionCurve<'c, C> {
    condition: &'c C,
    scales: DVector<f64>,
}

impl<C: Condition> Curve for ConditionCurve<'_, C> {
    fn values(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error> {
        self.condition.values(at)
    }

    /// By central differences of order four.
    fn slopes(&self, at: &DVector<f64>) -> Result<Uncertain, Error> {
        let mut slopes = DMatrix::zeros(at.len() - 1, at.len());
        for axis in 0..at.len() {
            let h = REACH * self.scales[axis];
            let value = |k: f64| {
                let mut beside = at.clone();
                beside[axis] += k * h;
                self.condition.values(&beside)
            };
            let near = value(1.0)? - value(-1.0)?;
            let far = value(2.0)? - value(-2.0)?;
            slopes.set_column(axis, &((near * 8.0 - far) / (12.0 * h)));
        }
        // Its points have no multipliers: nothing asks for the errors.
        let errors = DMatrix::zeros(slopes.nrows(), slopes.ncols());
        Ok(Uncertain { matrix: slopes, errors })
    }

    fn scales(&self) -> &DVector<f64> {
        &self.scales
    }
}

/// The curve of a condition through a point, in both directions. `map` is the one at the second parameter of the start.
pub(super) fn followed<M: MapFamily>(
    condition: &impl Condition,
    map: &M,
    (start, second): (&BranchPoint, f64),
    windows: Windows,
    steps: BranchSteps,
    mut see: impl FnMut(&BifurcationCurvePoint) -> ControlFlow<()>,
) -> Result<BifurcationCurve, Error> {
    check(map, (&start.point, start.parameter), windows.0, steps)?;
    check(map, (&start.point, second), windows.1, steps)?;
    let dimension = start.point.len();
    let curve = ConditionCurve {
        condition,
        scales: scales(dimension, start.size, &[windows.0, windows.1]),
    };
    let at = DVector::from_column_slice(&start.point).push(start.parameter).push(second);
    // Along the second parameter, or along the first one where the curve turns.
    let mut first = None;
    for axis in [dimension + 1, dimension] {
        let mut along = DVector::zeros(dimension + 2);
        along[axis] = 1.0;
        if first.is_none() {
            first = corrected(&curve, &at, &along)?;
        }
    }
    let first = first.ok_or_else(|| Error::NoPeriodicPoint {
        point: start.point.clone(),
        parameter: Some(start.parameter),
        residual: condition.values(&at).map_or(f64::NAN, |values| values.amax()),
        steps: MOST_NEWTON_STEPS,
    })?;
    let point = point_of(&first);
    if see(&point).is_break() {
        return Ok(BifurcationCurve {
            points: vec![point],
            ends: [CurveEnd::Stopped, CurveEnd::Stopped],
        });
    }
    let back = OnCurve { tangent: -&first.tangent, ..first.clone() };
    let (forward, last) = one_way(&curve, &first, (windows, steps), &mut see);
    let (mut points, before) = match last {
        // A closed curve has one direction.
        CurveEnd::Closed => (Vec::new(), CurveEnd::Closed),
        _ => one_way(&curve, &back, (windows, steps), &mut see),
    };
    points.reverse();
    points.push(point);
    points.extend(forward);
    Ok(BifurcationCurve { points, ends: [before, last] })
}

fn point_of(found: &OnCurve) -> BifurcationCurvePoint {
    let n = found.at.len() - 2;
    let point = found.at.iter().take(n).copied().collect();
    BifurcationCurvePoint { point, parameters: [found.at[n], found.at[n + 1]], error: found.error }
}

/// Follows the curve in the direction of the tangent. An error of the map ends it.
fn one_way<C: Condition>(
    curve: &ConditionCurve<'_, C>,
    first: &OnCurve,
    (windows, steps): (Windows, BranchSteps),
    see: &mut impl FnMut(&BifurcationCurvePoint) -> ControlFlow<()>,
) -> (Vec<BifurcationCurvePoint>, CurveEnd) {
    let (mut last, mut length, mut points) = (first.clone(), steps.first, Vec::new());
    let too_long = "the tangent turns faster than the shortest step";
    let mut reason = String::from(too_long);
    while points.len() < steps.points {
        if length < steps.shortest {
            return (points, CurveEnd::Lost { reason });
        }
        let predicted = &last.at + (length * &last.tangent).component_mul(curve.scales());
        let next = corrected(curve, &predicted, &last.tangent);
        let next = match next {
            Ok(next) => next.filter(|next| next.tangent.dot(&last.tangent) > STRAIGHT),
            Err(Error::Stopped { .. }) => return (points, CurveEnd::Stopped),
            Err(error) => {
                reason = error.to_string();
                length *= 0.5;
                continue;
            }
        };
        let Some(next) = next else {
            reason = String::from(too_long);
            length *= 0.5;
            continue;
        };
        if let Some(end) = curve.condition.end(&next.at) {
            return (points, end);
        }
        let point = point_of(&next);
        let [p, q] = point.parameters;
        let is_in = |value: f64, (left, right): (f64, f64)| left <= value && value <= right;
        if !is_in(p, windows.0) || !is_in(q, windows.1) {
            return (points, CurveEnd::Window);
        }
        let stopped = see(&point).is_break();
        points.push(point);
        if stopped {
            return (points, CurveEnd::Stopped);
        }
        if points.len() > 2 && next.passes(&last, first, curve.scales()) {
            return (points, CurveEnd::Closed);
        }
        length = (LONGER * length).min(steps.longest);
        last = next;
    }
    (points, CurveEnd::PointLimit)
}
