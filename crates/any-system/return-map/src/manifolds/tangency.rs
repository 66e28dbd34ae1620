//! Where two manifolds touch.

use super::crossings::{ManifoldCrossing, moving, sine};
use super::manifold::UnstableManifold;
use crate::error::Error;
use crate::families::MapFamily;
use nalgebra::{Matrix3, Vector3};

/// A point at which two manifolds in the plane touch, and the parameter at which they do: there two of their crossings are born or vanish.
#[derive(Debug, Clone, PartialEq)]
pub struct ManifoldTangency {
    /// The point.
    pub point: [f64; 2],
    /// The parameter.
    pub parameter: f64,
    /// The numbers t of the point on both manifolds.
    pub numbers: [f64; 2],
    /// How far the parameter is known: the last Newton step.
    pub error: f64,
}

/// Newton steps. From a crossing at a small angle some ten are enough.
const MOST_STEPS: usize = 60;

/// The distance of a difference: in the logarithms of the distances from the saddles, and in the parameter, in parts of the window. Its error only slows the steps.
const BESIDE: f64 = 1e-6;

/// A step that does not make the values smaller is halved, at most so often.
const MOST_HALVINGS: usize = 12;

/// Both curves meet at a tangency as exactly as this, on the scale of the point; and so small is the sine of the angle.
const EXACT: f64 = 1e-9;

/// The tangency of two manifolds in a window of parameters, from a crossing at a small angle that was found at the parameter
/// `parameter`. `first` and `second` give the manifolds at a parameter.
///
/// ```
/// use return_map::{ManifoldSteps, UnstableManifold, family, manifold_crossings, manifold_tangency};
/// use std::ops::ControlFlow::Continue;
/// // The line y = p, and a curve that comes down to y = 1 and goes up again: (x, y) = (u, w) with y = w + 1 + (u − 2)².
/// let bent = |x: f64| 1.0 + (x - 2.0) * (x - 2.0);
/// let curve = family(2, move |x, _| Ok(vec![2.0 * x[0], 0.5 * (x[1] - bent(x[0])) + bent(2.0 * x[0])]));
/// let line = family(2, |x, p| Ok(vec![2.0 * x[0], p + 0.5 * (x[1] - p)]));
/// // From (0, 5) downwards, and from (0, p) to the right.
/// let one = |p: f64| UnstableManifold::new(&curve, 1, (&[0.0, 5.0], p), -1.0);
/// let two = |p: f64| UnstableManifold::new(&line, 1, (&[0.0, p], p), 1.0);
/// let (bend, flat, steps) = (one(1.01)?, two(1.01)?, ManifoldSteps::default());
/// let curves = [bend.curve(&steps, |_| Continue(())), flat.curve(&steps, |_| Continue(()))];
/// let crossings = manifold_crossings((&bend, &curves[0]), (&flat, &curves[1]))?;
/// assert_eq!(crossings.len(), 2);
/// let found = manifold_tangency(one, two, (&crossings[0], 1.01), (0.9, 1.1))?;
/// assert!((found.parameter - 1.0).abs() < 1e-10);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadBranch`] for a window that is empty or does not contain the parameter; [`Error::NoTangency`] if none is found; those of
/// the manifolds.
pub fn manifold_tangency<'m, A: MapFamily + ?Sized + 'm, B: MapFamily + ?Sized + 'm>(
    first: impl Fn(f64) -> Result<UnstableManifold<'m, A>, Error>,
    second: impl Fn(f64) -> Result<UnstableManifold<'m, B>, Error>,
    (crossing, parameter): (&ManifoldCrossing, f64),
    window: (f64, f64),
) -> Result<ManifoldTangency, Error> {
    let (left, right) = window;
    let is_in = |p: f64| left <= p && p <= right;
    if !(is_in(parameter) && left < right && (right - left).is_finite()) {
        return Err(Error::BadBranch { what: "the window of a tangency", value: parameter });
    }
    let [t, r] = crossing.numbers;
    let mut at =
        Vector3::new(first(parameter)?.logarithm(t), second(parameter)?.logarithm(r), parameter);
    // The distance of both points, and the sine of the angle of both curves there.
    let values = |at: &Vector3<f64>| -> Option<Vector3<f64>> {
        let (one, two) = (first(at[2]).ok()?, second(at[2]).ok()?);
        let ((x, u), (y, v)) = (moving(&one, one.number(at[0]))?, moving(&two, two.number(at[1]))?);
        Some(Vector3::new(x[0] - y[0], x[1] - y[1], sine(&u, &v)))
    };
    let units = Vector3::new(1.0, 1.0, right - left) * BESIDE;
    let mut own = values(&at);
    let mut error = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let Some(here) = own else { break };
        let step = slopes(&values, &at, &units).and_then(|slopes| slopes.lu().solve(&-here));
        let Some(step) = step else { break };
        let mut part = 1.0;
        let mut next = None;
        for _ in 0..MOST_HALVINGS {
            let tried = at + step * part;
            let found = values(&tried).filter(|_| is_in(tried[2]));
            if let Some(found) = found.filter(|found| found.norm() < here.norm()) {
                next = Some((tried, found));
                break;
            }
            part *= 0.5;
        }
        // It ends where rounding lets the values become no smaller.
        error = error.min(step[2].abs());
        let Some((tried, found)) = next else { break };
        (at, own) = (tried, Some(found));
    }
    let one = first(at[2])?;
    let numbers = [one.number(at[0]), second(at[2])?.number(at[1])];
    let point = one.at(numbers[0])?;
    let size = point.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    let off = own.unwrap_or(Vector3::repeat(f64::NAN));
    let residual = off.norm();
    // Behind the next image of a point, or the one before, it is another tangency, or the saddle.
    let is_near = (numbers[0] - t).abs() <= 1.0 && (numbers[1] - r).abs() <= 1.0;
    let is_exact = off.xy().norm() <= EXACT * size && off[2].abs() <= EXACT;
    let unfolds = slopes(&values, &at, &units).is_some_and(|slopes| unfolds(&slopes));
    let is_known = error <= KNOWN * (right - left);
    match &point[..] {
        &[x, y] if is_near && is_exact && unfolds && is_known => {
            Ok(ManifoldTangency { point: [x, y], parameter: at[2], numbers, error })
        }
        _ => Err(Error::NoTangency { parameter: at[2], residual }),
    }
}

/// The last step of the parameter is at most this part of the window.
const KNOWN: f64 = 1e-6;

/// A volume of the three directions of the slopes, each of length 1, below which they are in a plane: the touch is one of higher order, or at all parameters.
const FLAT: f64 = 1e-6;

/// True if two crossings are born or vanish where the curves touch: the curves are bent differently there, and move against each other.
fn unfolds(slopes: &Matrix3<f64>) -> bool {
    let mut unit = *slopes;
    for mut column in unit.column_iter_mut() {
        let length = column.norm();
        column /= length;
    }
    unit.determinant().abs() > FLAT
}

/// The slopes of the values by differences.
fn slopes(
    values: &impl Fn(&Vector3<f64>) -> Option<Vector3<f64>>,
    at: &Vector3<f64>,
    units: &Vector3<f64>,
) -> Option<Matrix3<f64>> {
    let mut slopes = Matrix3::zeros();
    for axis in 0..3 {
        let beside = |side: f64| {
            let mut beside = *at;
            beside[axis] += side * units[axis];
            values(&beside)
        };
        slopes.set_column(axis, &((beside(1.0)? - beside(-1.0)?) / (2.0 * units[axis])));
    }
    Some(slopes)
}
