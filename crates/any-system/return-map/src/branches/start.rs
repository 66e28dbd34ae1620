//! Where a branch starts: the point of it near a given one, and what is refused.

use super::branch::BranchPoint;
use super::curve::{Curve, MOST_NEWTON_STEPS, OnCurve, ROUNDING, corrected, scaled_slopes};
use super::follow::{BranchSteps, point_of};
use super::orbit::{Kind, Orbit, split};
use crate::checks::{check_dimension, check_inside, check_period, check_positive, check_window};
use crate::error::Error;
use crate::families::MapFamily;
use crate::multipliers::null_vector;
use nalgebra::{DMatrix, DVector};

/// The point of a branch near a start, at a parameter.
pub(super) fn solved<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    (start, parameter): (&[f64], f64),
) -> Result<OnCurve, Error> {
    let at = DVector::from_column_slice(start).push(parameter);
    let mut along = DVector::zeros(at.len());
    along[start.len()] = 1.0;
    if let Some(found) = corrected(orbit, &at, &along)? {
        return Ok(found);
    }
    // At a fold no point is found at a fixed parameter: across the branch there is one.
    let slopes = scaled_slopes(orbit, &at)?;
    let along = null_vector(&slopes.matrix.clone().insert_row(start.len(), 0.0));
    let is_regular = slopes.matrix.singular_values().min() > known(orbit, &slopes.errors);
    let found = match along.filter(|_| is_regular) {
        Some(along) => corrected(orbit, &at, &along)?,
        None => None,
    };
    found.ok_or_else(|| none_near(orbit, &at))
}

/// The error of a search by Newton's method that began at a point and a parameter. At a solution itself the equations are singular.
pub(super) fn none_near(curve: &impl Curve, at: &DVector<f64>) -> Error {
    let (point, parameter) = split(at);
    let residual = curve.values(at).map_or(f64::NAN, |values| values.amax());
    if residual <= ROUNDING * size_of(&point) {
        return Error::Singular { point, parameter };
    }
    let (parameter, steps) = (Some(parameter), MOST_NEWTON_STEPS);
    Error::NoPeriodicPoint { point, parameter, residual, steps }
}

/// How far slopes in units of the scales are known. The equations of a periodic point are fⁿ(x) − x: each rounds as x does.
fn known<M: ?Sized>(orbit: &Orbit<'_, M>, errors: &DMatrix<f64>) -> f64 {
    errors.norm() + orbit.kind.at_fold() * f64::EPSILON * orbit.scales[0]
}

/// An error for a start at which the slopes of the equations have not their full rank, within what is known of them.
pub(super) fn check_direction<M: ?Sized>(orbit: &Orbit<'_, M>, at: &OnCurve) -> Result<(), Error> {
    if at.slopes.clone().singular_values().min() > known(orbit, &at.errors) {
        return Ok(());
    }
    let (point, parameter) = split(&at.at);
    Err(Error::Singular { point, parameter })
}

/// The point of period `period` of a family near a start at a parameter, with its multipliers and their errors, by Newton's method: a point of the
/// branch that [`follow_branch`](super::follow_branch) follows from there.
///
/// ```
/// use return_map::{branch_point, scalar_family};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let fixed = branch_point(&logistic, 1, (&[0.6], 2.5))?;
/// assert!((fixed.point[0] - 0.6).abs() < 1e-15 && (fixed.multipliers[0].re + 0.5).abs() < 1e-12);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// [`Error::BadPeriod`]; [`Error::BadArgument`] for a start of another dimension or that is not finite; [`Error::NoPeriodicPoint`] if there is none near the
/// start; errors of the map.
pub fn branch_point<M: MapFamily + ?Sized>(
    map: &M,
    period: usize,
    start: (&[f64], f64),
) -> Result<BranchPoint, Error> {
    Ok(solve_periodic(map, period, start)?.0)
}

/// The periodic point near a start, and the derivative of fⁿ there.
pub(crate) fn solve_periodic<M: MapFamily + ?Sized>(
    map: &M,
    period: usize,
    (start, parameter): (&[f64], f64),
) -> Result<(BranchPoint, DMatrix<f64>), Error> {
    check_period(period)?;
    let width = parameter.abs().max(1.0);
    let window = (parameter - width, parameter + width);
    check(map, (start, parameter), window, BranchSteps::default())?;
    let orbit = Orbit {
        map,
        kind: Kind::Periodic(period),
        scales: scales(start.len(), size_of(start), &[window]),
    };
    let found = solved(&orbit, (start, parameter))?;
    let itinerary = orbit.itinerary(&found.at)?;
    let derivative = orbit.derivative(&found.slopes);
    Ok((point_of(&orbit, &found, itinerary), derivative))
}

/// The sizes of the unknowns: that of the first point for each component, and the widths of the windows.
pub(super) fn scales(dimension: usize, size: f64, windows: &[(f64, f64)]) -> DVector<f64> {
    let widths = windows.iter().map(|(left, right)| right - left);
    DVector::from_iterator(
        dimension + windows.len(),
        std::iter::repeat_n(size, dimension).chain(widths),
    )
}

/// A smaller point is the rounding of zero.
const SMALLEST: f64 = 1e-14;

/// The largest size of some numbers, or 1 if they are zero.
pub(crate) fn size_of<'n>(numbers: impl IntoIterator<Item = &'n f64>) -> f64 {
    let size = numbers.into_iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    if size > SMALLEST { size } else { 1.0 }
}

pub(super) fn check<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    window: (f64, f64),
    steps: BranchSteps,
) -> Result<(), Error> {
    check_dimension("the start of a branch", map.dimension().max(1), start.len())?;
    check_window(window)?;
    check_inside(parameter, window)?;
    let BranchSteps { first, longest, shortest, .. } = steps;
    for (what, value) in [
        ("the first step of a branch", first),
        ("the longest step of a branch", longest),
        ("the shortest step of a branch", shortest),
    ] {
        check_positive(what, value)?;
    }
    Ok(())
}
