//! A curve of solutions of m − 1 equations in m unknowns, by predictor and corrector.

use crate::error::Error;
use crate::multipliers::Uncertain;
use nalgebra::{DMatrix, DVector, Dyn, LU};

/// The equations of a curve.
pub(super) trait Curve {
    /// The m − 1 values that are zero on the curve.
    fn values(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error>;
    /// Their derivatives, m − 1 rows of m.
    fn slopes(&self, at: &DVector<f64>) -> Result<Uncertain, Error>;
    /// The sizes of the unknowns: lengths along the curve are in these units.
    fn scales(&self) -> &DVector<f64>;
}

/// A point of a curve.
#[derive(Debug, Clone)]
pub(super) struct OnCurve {
    /// The unknowns.
    pub(super) at: DVector<f64>,
    /// The unit tangent, in units of the scales.
    pub(super) tangent: DVector<f64>,
    /// The derivatives of the equations, in units of the scales.
    pub(super) slopes: DMatrix<f64>,
    /// How far these may be off.
    pub(super) errors: DMatrix<f64>,
    /// The length of the last Newton step: how far the point is known.
    pub(super) error: f64,
    /// The number of Newton steps.
    pub(super) steps: usize,
}

/// The largest angle between tangents at two neighbouring points, as its cosine: 18°. A larger angle would let a step change to
/// another branch.
pub(super) const STRAIGHT: f64 = 0.95;

impl OnCurve {
    /// True if the step from the point before to this one passes the first point of the curve, in its direction.
    pub(super) fn passes(&self, before: &OnCurve, first: &OnCurve, scales: &DVector<f64>) -> bool {
        let apart = |a: &OnCurve, b: &OnCurve| (&a.at - &b.at).component_div(scales).norm();
        let step = apart(before, self);
        let along = (&first.at - &before.at).component_div(scales).dot(&before.tangent);
        apart(before, first) <= step
            && apart(self, first) <= step
            && (0.0..=step).contains(&along)
            && self.tangent.dot(&first.tangent) > STRAIGHT
    }
}

/// Newton steps of a corrector. From a good prediction it takes three or four; more mean that the step is too long.
pub(super) const MOST_NEWTON_STEPS: usize = 12;

/// A Newton step of this length ends the corrector: some hundred roundings.
pub(super) const ROUNDING: f64 = 1e-14;

/// A Newton step that is not shorter than half of the one before is noise of the map, if it is at most this long, in units of the scales. The noise of an
/// integrated map is of the size of its tolerance; a larger number would accept points that are none.
const NOISE: f64 = 1e-8;

/// The slopes of a curve, in units of the scales.
pub(super) fn scaled_slopes(curve: &impl Curve, at: &DVector<f64>) -> Result<Uncertain, Error> {
    let mut slopes = curve.slopes(at)?;
    for matrix in [&mut slopes.matrix, &mut slopes.errors] {
        for (mut column, scale) in matrix.column_iter_mut().zip(curve.scales().iter()) {
            column *= *scale;
        }
    }
    Ok(slopes)
}

/// The slopes with a further row.
pub(super) fn bordered(slopes: &DMatrix<f64>, row: &DVector<f64>) -> DMatrix<f64> {
    let mut matrix = slopes.clone().insert_row(slopes.nrows(), 0.0);
    matrix.set_row(slopes.nrows(), &row.transpose());
    matrix
}

/// The unit tangent on the side of `along`; `None` if there is none.
pub(super) fn tangent(slopes: &DMatrix<f64>, along: &DVector<f64>) -> Option<DVector<f64>> {
    let mut side = DVector::zeros(along.len());
    side[along.len() - 1] = 1.0;
    let tangent = bordered(slopes, along).lu().solve(&side)?;
    let length = tangent.norm();
    (length.is_finite() && length > 0.0).then(|| tangent / length)
}

/// The same by the slopes of a point nearby, which cost nothing: only for short ways. `matrix` are these slopes, bordered by `along`.
pub(super) fn corrected_by(
    curve: &impl Curve,
    matrix: &LU<f64, Dyn, Dyn>,
    predicted: &DVector<f64>,
    along: &DVector<f64>,
) -> Option<DVector<f64>> {
    let mut at = predicted.clone();
    let mut before = f64::INFINITY;
    for _ in 1..=MOST_NEWTON_STEPS {
        let values = curve.values(&at).ok()?;
        let off = (&at - predicted).component_div(curve.scales()).dot(along);
        let step = matrix.solve(&-values.push(off))?;
        let length = step.amax();
        at += step.component_mul(curve.scales());
        let size = 1.0 + at.component_div(curve.scales()).amax();
        if length <= ROUNDING * size || length <= NOISE && length > 0.5 * before {
            return Some(at);
        }
        // It converges, or the slopes are those of another place.
        if !(length <= 0.5 * before) {
            return None;
        }
        before = length;
    }
    None
}

/// The point of the curve in the plane through `predicted` that is normal to `along`, near `predicted`; `None` if Newton's method finds
/// none. Errors are those of the equations.
pub(super) fn corrected(
    curve: &impl Curve,
    predicted: &DVector<f64>,
    along: &DVector<f64>,
) -> Result<Option<OnCurve>, Error> {
    let mut at = predicted.clone();
    let mut before = f64::INFINITY;
    for steps in 1..=MOST_NEWTON_STEPS {
        let slopes = scaled_slopes(curve, &at)?.matrix;
        let values = curve.values(&at)?;
        let off = (&at - predicted).component_div(curve.scales()).dot(along);
        let side = -values.push(off);
        let Some(step) = bordered(&slopes, along).lu().solve(&side) else { return Ok(None) };
        let length = step.amax();
        if !length.is_finite() {
            return Ok(None);
        }
        at += step.component_mul(curve.scales());
        let size = 1.0 + at.component_div(curve.scales()).amax();
        let is_noise = length <= NOISE && length > 0.5 * before;
        if length <= ROUNDING * size || is_noise {
            let Uncertain { matrix: slopes, errors } = scaled_slopes(curve, &at)?;
            let Some(tangent) = tangent(&slopes, along) else { return Ok(None) };
            return Ok(Some(OnCurve { at, tangent, slopes, errors, error: length, steps }));
        }
        before = length;
    }
    Ok(None)
}
