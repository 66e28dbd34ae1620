//! Curves of bifurcations in two parameters.

use super::branch::{Bifurcation, BifurcationKind};
use super::curve::{Curve, OnCurve, corrected};
use super::follow::{BranchSteps, LONGER, STRAIGHT};
use super::orbit::{Kind, Orbit, eigenvalues};
use super::start::scales;
use super::tests::Test;
use crate::error::Error;
use crate::families::MapFamily;
use nalgebra::{DMatrix, DVector};
use std::ops::ControlFlow;

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

/// The windows of both parameters.
type Windows = ((f64, f64), (f64, f64));

/// The distance of the values of a difference, in units of the scales. Values with an error of 10⁻¹³ give slopes with one of 10⁻¹⁰: enough
/// for Newton's method, which ends where the values themselves are zero.
const REACH: f64 = 1e-3;

/// A bifurcation of a family of maps: the unknowns are the point and both parameters.
struct BifurcationCurve<'f, F> {
    family: &'f F,
    period: usize,
    test: Test,
    scales: DVector<f64>,
    /// The pieces of the map that the orbit meets.
    itinerary: Vec<String>,
}

impl<M: MapFamily, F: Fn(f64) -> M> BifurcationCurve<'_, F> {
    /// The equations of the periodic point, and the test.
    fn all(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let last = at.len() - 1;
        let map = (self.family)(at[last]);
        let orbit = Orbit {
            map: &map,
            kind: Kind::Periodic(self.period),
            scales: DVector::from_element(last, 1.0),
        };
        let at = at.rows(0, last).into_owned();
        let slopes = orbit.slopes(&at)?;
        let tangent = DVector::zeros(last);
        let point = OnCurve { at, tangent, slopes, error: 0.0, steps: 0 };
        let test = self.test.value(&point, &orbit);
        Ok(orbit.values(&point.at)?.push(test))
    }

    /// True if the orbit meets the same pieces of the map, and the bifurcation is still one: behind a resonance two real multipliers have
    /// the product 1, and there is no circle.
    fn is_kept(&self, at: &DVector<f64>) -> bool {
        let last = at.len() - 1;
        let map = (self.family)(at[last]);
        let scales = DVector::from_element(last, 1.0);
        let orbit = Orbit { map: &map, kind: Kind::Periodic(self.period), scales };
        let at = at.rows(0, last).into_owned();
        let Ok(slopes) = orbit.slopes(&at) else { return false };
        let multipliers = eigenvalues(&orbit.derivative(&slopes));
        orbit.itinerary(&at).is_ok_and(|own| own == self.itinerary)
            && self.test.kind(orbit.kind, &multipliers).is_some()
    }
}

impl<M: MapFamily, F: Fn(f64) -> M> Curve for BifurcationCurve<'_, F> {
    fn values(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error> {
        self.all(at)
    }

    /// By central differences of order four.
    fn slopes(&self, at: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        let mut slopes = DMatrix::zeros(at.len() - 1, at.len());
        for axis in 0..at.len() {
            let h = REACH * self.scales[axis];
            let value = |k: f64| {
                let mut beside = at.clone();
                beside[axis] += k * h;
                self.all(&beside)
            };
            let near = value(1.0)? - value(-1.0)?;
            let far = value(2.0)? - value(-2.0)?;
            slopes.set_column(axis, &((near * 8.0 - far) / (12.0 * h)));
        }
        Ok(slopes)
    }

    fn scales(&self) -> &DVector<f64> {
        &self.scales
    }
}

/// The curve of a bifurcation in two parameters, from one that was found, in both directions, up to the borders of both windows: folds,
/// doublings and Neimark–Sacker bifurcations. `family` gives the map at a value of the second parameter, whose value at the
/// bifurcation is `second`.
///
/// The curve ends with its last point inside both windows, before the orbit meets other pieces of the map, and where the
/// bifurcation is none any more: a circle ends at a resonance with two real multipliers. `see` receives each point; if it breaks, the curve ends there.
///
/// ```
/// use return_map::{BranchSteps, bifurcation_curve, family, follow_branch};
/// use std::ops::ControlFlow::Continue;
/// // Hénon's map doubles at a = ¾ (1 − b)².
/// let henon = |b: f64| family(2, move |x: &[f64], a| Ok(vec![1.0 - a * x[0] * x[0] + x[1], b * x[0]]));
/// let steps = BranchSteps::default();
/// let branch = follow_branch(&henon(0.3), 1, (&[0.9, 0.3], 0.2), (0.0, 1.0), steps, |_| Continue(()))?;
/// let curve = bifurcation_curve(&henon, 1, (&branch.bifurcations[0], 0.3), ((0.0, 2.0), (0.0, 0.6)), steps, |_| Continue(()))?;
/// assert!(curve.len() > 20);
/// for found in &curve {
///     let [a, b] = found.parameters;
///     assert!((a - 0.75 * (1.0 - b) * (1.0 - b)).abs() < 1e-9);
/// }
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadBranch`] for a bifurcation of another kind, and for windows that are empty or do not contain the start;
/// [`Error::NoPeriodicPoint`] if the curve is not found at the start.
pub fn bifurcation_curve<M: MapFamily, F: Fn(f64) -> M>(
    family: &F,
    period: usize,
    (start, second): (&Bifurcation, f64),
    windows: Windows,
    steps: BranchSteps,
    mut see: impl FnMut(&BifurcationCurvePoint) -> ControlFlow<()>,
) -> Result<Vec<BifurcationCurvePoint>, Error> {
    super::start::check_period(period)?;
    let test = match start.kind {
        BifurcationKind::Fold => Test::Meet,
        BifurcationKind::Doubling => Test::Flip,
        BifurcationKind::NeimarkSacker => Test::Circle,
        _ => {
            let what = "a bifurcation that is no fold, doubling or Neimark–Sacker bifurcation";
            return Err(Error::BadBranch { what, value: f64::NAN });
        }
    };
    let map = family(second);
    super::start::check(&map, (&start.at.point, start.at.parameter), windows.0, steps)?;
    super::start::check(&map, (&start.at.point, second), windows.1, steps)?;
    let dimension = start.at.point.len();
    let scales = scales(&start.at.point, &[windows.0, windows.1]);
    let itinerary = start.at.itinerary.clone();
    let curve = BifurcationCurve { family, period, test, scales, itinerary };
    let at = DVector::from_column_slice(&start.at.point).push(start.at.parameter).push(second);
    // Along the second parameter, or along the first one where the curve turns.
    let mut first = None;
    for axis in [dimension + 1, dimension] {
        let mut along = DVector::zeros(dimension + 2);
        along[axis] = 1.0;
        if first.is_none() {
            first = corrected(&curve, &at, &along)?;
        }
    }
    let first = first.ok_or(Error::NoPeriodicPoint { residual: f64::NAN, steps: 0 })?;
    let back = OnCurve { tangent: -&first.tangent, ..first.clone() };
    let mut points = one_way(&curve, back, (windows, steps), &mut see);
    points.reverse();
    points.push(point_of(&first));
    points.extend(one_way(&curve, first, (windows, steps), &mut see));
    Ok(points)
}

fn point_of(found: &OnCurve) -> BifurcationCurvePoint {
    let n = found.at.len() - 2;
    let point = found.at.iter().take(n).copied().collect();
    BifurcationCurvePoint { point, parameters: [found.at[n], found.at[n + 1]], error: found.error }
}

/// Follows the curve in the direction of the tangent. An error of the map ends it.
fn one_way<M: MapFamily>(
    curve: &BifurcationCurve<'_, impl Fn(f64) -> M>,
    first: OnCurve,
    (windows, steps): (Windows, BranchSteps),
    see: &mut impl FnMut(&BifurcationCurvePoint) -> ControlFlow<()>,
) -> Vec<BifurcationCurvePoint> {
    let (mut last, mut length, mut points) = (first, steps.first, Vec::new());
    while points.len() < steps.points && length >= steps.shortest {
        let predicted = &last.at + (length * &last.tangent).component_mul(curve.scales());
        let next = corrected(curve, &predicted, &last.tangent).ok().flatten();
        let next = next.filter(|next| next.tangent.dot(&last.tangent) > STRAIGHT);
        let Some(next) = next else {
            length *= 0.5;
            continue;
        };
        let point = point_of(&next);
        if !curve.is_kept(&next.at) {
            break;
        }
        let [p, q] = point.parameters;
        let is_in = |value: f64, (left, right): (f64, f64)| left <= value && value <= right;
        if !is_in(p, windows.0) || !is_in(q, windows.1) {
            break;
        }
        let stopped = see(&point).is_break();
        points.push(point);
        if stopped {
            break;
        }
        length = (LONGER * length).min(steps.longest);
        last = next;
    }
    points
}
