//! Curves of smooth bifurcations in two parameters.

use super::branch::{Bifurcation, BifurcationKind};
use super::curve::{Curve, OnCurve};
use super::follow::BranchSteps;
use super::orbit::{Kind, Orbit};
use super::tests::Test;
use super::two_parameters::{
    BifurcationCurve, BifurcationCurvePoint, Condition, CurveEnd, Windows, followed,
};
use crate::checks::check_period;
use crate::error::Error;
use crate::families::MapFamily;
use crate::multipliers::{Uncertain, eigenvalues};
use nalgebra::DVector;
use std::ops::ControlFlow;

/// A bifurcation of a family of maps: the unknowns are the point and both parameters.
struct Smooth<'f, F> {
    family: &'f F,
    period: usize,
    test: Test,
    /// The pieces of the map that the orbit meets.
    itinerary: Vec<String>,
}

impl<M: MapFamily, F: Fn(f64) -> M> Condition for Smooth<'_, F> {
    /// The equations of the periodic point, and the test.
    fn values(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let last = at.len() - 1;
        let map = (self.family)(at[last]);
        let scales = DVector::from_element(last, 1.0);
        let orbit = Orbit { map: &map, kind: Kind::Periodic(self.period), scales };
        let at = at.rows(0, last).into_owned();
        let Uncertain { matrix: slopes, errors } = orbit.slopes(&at)?;
        let tangent = DVector::zeros(last);
        let point = OnCurve { at, tangent, slopes, errors, error: 0.0, steps: 0 };
        let test = self.test.value(&point, &orbit);
        Ok(orbit.values(&point.at)?.push(test))
    }

    /// The orbit meets other pieces of the map, or the bifurcation is none: behind a resonance two real multipliers have the product 1, and
    /// there is no circle.
    fn end(&self, at: &DVector<f64>) -> Option<CurveEnd> {
        let last = at.len() - 1;
        let map = (self.family)(at[last]);
        let scales = DVector::from_element(last, 1.0);
        let orbit = Orbit { map: &map, kind: Kind::Periodic(self.period), scales };
        let at = at.rows(0, last).into_owned();
        let lost = |error: Error| match error {
            Error::Stopped { .. } => Some(CurveEnd::Stopped),
            error => Some(CurveEnd::Lost { reason: error.to_string() }),
        };
        match orbit.itinerary(&at) {
            Ok(own) if own == self.itinerary => {}
            Ok(beyond) => return Some(CurveEnd::Border { beyond }),
            Err(error) => return lost(error),
        }
        let slopes = match orbit.slopes(&at) {
            Ok(slopes) => slopes.matrix,
            Err(error) => return lost(error),
        };
        let multipliers = eigenvalues(&orbit.derivative(&slopes));
        let is_one = self.test.kind(orbit.kind, &multipliers).is_some();
        (!is_one).then_some(CurveEnd::NoBifurcation)
    }
}

/// The curve of a bifurcation in two parameters, from one that was found, in both directions, up to the borders of both windows: folds,
/// doublings and Neimark–Sacker bifurcations. `family` gives the map at a value of the second parameter, whose value at the
/// bifurcation is `second`.
///
/// The curve ends with its last point inside both windows, before the orbit meets other pieces of the map, and where the
/// bifurcation is none any more: each end says why. `see` receives each point; if it breaks, the curve ends there.
///
/// ```
/// use return_map::{BranchSteps, bifurcation_curve, family, follow_branch};
/// use std::ops::ControlFlow::Continue;
/// // Hénon's map doubles at a = ¾ (1 − b)².
/// let henon = |b: f64| family(2, move |x: &[f64], a| Ok(vec![1.0 - a * x[0] * x[0] + x[1], b * x[0]]));
/// let steps = BranchSteps::default();
/// let branch = follow_branch(&henon(0.3), 1, (&[0.9, 0.3], 0.2), (0.0, 1.0), steps, |_| Continue(()))?;
/// let curve = bifurcation_curve(&henon, 1, (&branch.bifurcations[0], 0.3), ((0.0, 2.0), (0.0, 0.6)), steps, |_| Continue(()))?;
/// assert!(curve.points.len() > 20);
/// for found in &curve.points {
///     let [a, b] = found.parameters;
///     assert!((a - 0.75 * (1.0 - b) * (1.0 - b)).abs() < 1e-9);
/// }
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::OtherStart`] for a bifurcation of another kind; [`Error::BadArgument`] for windows that are empty or do not contain the start;
/// [`Error::NoPeriodicPoint`] if the curve is not found at the start.
pub fn bifurcation_curve<M: MapFamily, F: Fn(f64) -> M>(
    family: &F,
    period: usize,
    (start, second): (&Bifurcation, f64),
    windows: Windows,
    steps: BranchSteps,
    see: impl FnMut(&BifurcationCurvePoint) -> ControlFlow<()>,
) -> Result<BifurcationCurve, Error> {
    check_period(period)?;
    let test = match start.kind {
        BifurcationKind::Fold => Test::Meet,
        BifurcationKind::Doubling => Test::Flip,
        BifurcationKind::NeimarkSacker => Test::Circle,
        _ => {
            let needed = "a fold, a doubling or a Neimark–Sacker bifurcation";
            return Err(Error::OtherStart { needed, found: format!("{:?}", start.kind) });
        }
    };
    let itinerary = start.at.itinerary.clone();
    let condition = Smooth { family, period, test, itinerary };
    followed(&condition, &family(second), (&start.at, second), windows, steps, see)
}
