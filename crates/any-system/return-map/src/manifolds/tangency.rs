//! Where two manifolds touch.

use super::crossings::{ManifoldCrossing, moving, sine};
use super::manifold::UnstableManifold;
use crate::checks::{check_inside, check_window};
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

/// The distance of a difference: in the logarithms of the distances from the saddles, and in the parameter, in parts of the window. Its
/// error only slows the steps.
const BESIDE: f64 = 1e-6;

/// A step that does not make the values smaller is halved, at most so often.
const MOST_HALVINGS: i32 = 12;

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
/// let curves = [bend.curve(&steps, |_| Continue(()))?, flat.curve(&steps, |_| Continue(()))?];
/// let crossings = manifold_crossings((&bend, &curves[0]), (&flat, &curves[1]))?;
/// assert_eq!(crossings.len(), 2);
/// let found = manifold_tangency(one, two, (&crossings[0], 1.01), (0.9, 1.1))?;
/// assert!((found.parameter - 1.0).abs() < 1e-10);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadArgument`] for a window that is empty or does not contain the parameter; [`Error::NoTangency`] if none is found; those of
/// the manifolds.
pub fn manifold_tangency<'m, A: MapFamily + ?Sized + 'm, B: MapFamily + ?Sized + 'm>(
    first: impl Fn(f64) -> Result<UnstableManifold<'m, A>, Error>,
    second: impl Fn(f64) -> Result<UnstableManifold<'m, B>, Error>,
    (crossing, parameter): (&ManifoldCrossing, f64),
    window: (f64, f64),
) -> Result<ManifoldTangency, Error> {
    check_window(window)?;
    check_inside(parameter, window)?;
    let (left, right) = window;
    let [t, r] = crossing.numbers;
    let start =
        Vector3::new(first(parameter)?.logarithm(t), second(parameter)?.logarithm(r), parameter);
    // The distance of both points, and the sine of the angle of both curves there.
    let values = |at: &Vector3<f64>| -> Option<Vector3<f64>> {
        let (one, two) = (first(at[2]).ok()?, second(at[2]).ok()?);
        let ((x, u), (y, v)) = (moving(&one, one.number(at[0]))?, moving(&two, two.number(at[1]))?);
        Some(Vector3::new(x[0] - y[0], x[1] - y[1], sine(&u, &v)))
    };
    let units = Vector3::new(1.0, 1.0, right - left) * BESIDE;
    let (at, off, error) = newton(&values, start, &units, window);
    let one = first(at[2])?;
    let numbers = [one.number(at[0]), second(at[2])?.number(at[1])];
    let point = one.at(numbers[0])?;
    let size = point.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
    // Behind the next image of a point, or the one before, it is another tangency, or the saddle.
    let is_near = (numbers[0] - t).abs() <= 1.0 && (numbers[1] - r).abs() <= 1.0;
    let is_exact = off.xy().norm() <= EXACT * size && off[2].abs() <= EXACT;
    let unfolds = slopes(&values, &at, &units).is_some_and(|slopes| unfolds(&slopes));
    let is_known = error <= KNOWN * (right - left);
    match &point[..] {
        &[x, y] if is_near && is_exact && unfolds && is_known => {
            Ok(ManifoldTangency { point: [x, y], parameter: at[2], numbers, error })
        }
        _ => {
            let none = Error::NoTangency { parameter: at[2], residual: off.norm() };
            let stopped = one.stopped().or_else(|| second(at[2]).ok()?.stopped());
            Err(stopped.unwrap_or(none))
        }
    }
}

/// The last step of the parameter is at most this part of the window.
const KNOWN: f64 = 1e-6;

/// A volume of the three directions of the slopes, each of length 1, below which they are in a plane: the touch is one of higher order,
/// or at all parameters.
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

/// Damped steps of Newton's method, inside the window of the last unknown: the unknowns, the values there, which are NaN if the start has
/// none, and the shortest step of the last unknown.
fn newton(
    values: &impl Fn(&Vector3<f64>) -> Option<Vector3<f64>>,
    start: Vector3<f64>,
    units: &Vector3<f64>,
    (left, right): (f64, f64),
) -> (Vector3<f64>, Vector3<f64>, f64) {
    let (mut at, mut error) = (start, f64::INFINITY);
    let Some(mut own) = values(&at) else { return (at, Vector3::repeat(f64::NAN), error) };
    for _ in 0..MOST_STEPS {
        let step = slopes(values, &at, units).and_then(|slopes| slopes.lu().solve(&-own));
        let Some(step) = step else { break };
        error = error.min(step[2].abs());
        let parts = (0..MOST_HALVINGS).map(|halving| 0.5f64.powi(halving));
        let mut tries = parts.filter_map(|part| {
            let tried = at + step * part;
            let found = values(&tried).filter(|_| left <= tried[2] && tried[2] <= right)?;
            (found.norm() < own.norm()).then_some((tried, found))
        });
        // It ends where rounding lets the values become no smaller.
        let Some(next) = tries.next() else { break };
        (at, own) = next;
    }
    (at, own, error)
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
