//! Where a branch starts: the point of it near a given one, and what is refused.

use super::branch::BranchPoint;
use super::curve::{OnCurve, corrected};
use super::follow::{BranchSteps, point_of};
use super::orbit::{Kind, Orbit};
use crate::error::Error;
use crate::families::MapFamily;
use crate::periodic_point::LONGEST_PERIOD;
use nalgebra::{DMatrix, DVector};

/// The point of a branch near a start, at a parameter.
pub(super) fn solved<M: MapFamily + ?Sized>(
    orbit: &Orbit<'_, M>,
    (start, parameter): (&[f64], f64),
) -> Result<OnCurve, Error> {
    let at = DVector::from_column_slice(start).push(parameter);
    let mut along = DVector::zeros(at.len());
    along[start.len()] = 1.0;
    let none = || Error::NoPeriodicPoint { residual: f64::NAN, steps: 0 };
    corrected(orbit, &at, &along)?.ok_or_else(none)
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
    let orbit = Orbit { map, kind: Kind::Periodic(period), scales: scales(start, &[window]) };
    let found = solved(&orbit, (start, parameter))?;
    let itinerary = orbit.itinerary(&found.at)?;
    let derivative = orbit.derivative(&found.slopes);
    Ok((point_of(&orbit, &found, itinerary), derivative))
}

/// The sizes of the unknowns: that of the first point, or 1, for each component, and the widths of the windows.
pub(super) fn scales(point: &[f64], windows: &[(f64, f64)]) -> DVector<f64> {
    let size = size_of(point);
    let widths = windows.iter().map(|(left, right)| right - left);
    let all: Vec<f64> = point.iter().map(|_| size).chain(widths).collect();
    DVector::from(all)
}

/// The largest size of some numbers, or 1 if they are zero.
pub(crate) fn size_of<'n>(numbers: impl IntoIterator<Item = &'n f64>) -> f64 {
    let size = numbers.into_iter().fold(0.0, |size: f64, x| size.max(x.abs()));
    if size > 0.0 { size } else { 1.0 }
}

/// An error for a period that is not positive, or too long to be iterated.
pub(crate) fn check_period(period: usize) -> Result<(), Error> {
    match period {
        0 => Err(Error::BadBranch { what: "the period of a branch", value: 0.0 }),
        period if period > LONGEST_PERIOD => Err(Error::BadPeriod { period, most: LONGEST_PERIOD }),
        _ => Ok(()),
    }
}

/// An error for a window that is empty or not finite.
pub(crate) fn check_window((left, right): (f64, f64)) -> Result<(), Error> {
    match left < right && (right - left).is_finite() {
        true => Ok(()),
        false => Err(Error::BadBranch {
            what: "the width of the window of a branch",
            value: right - left,
        }),
    }
}

/// An error for a parameter outside of a window.
pub(crate) fn check_inside(parameter: f64, (left, right): (f64, f64)) -> Result<(), Error> {
    match left <= parameter && parameter <= right {
        true => Ok(()),
        false => {
            Err(Error::BadBranch { what: "a parameter outside of the window", value: parameter })
        }
    }
}

pub(super) fn check<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    window: (f64, f64),
    steps: BranchSteps,
) -> Result<(), Error> {
    let (expected, found) = (map.dimension(), start.len());
    if expected != found || found == 0 {
        let what = "the start of a branch";
        return Err(hybrid_system::Error::Dimension { what, expected, found }.into());
    }
    check_window(window)?;
    check_inside(parameter, window)?;
    let BranchSteps { first, longest, shortest, .. } = steps;
    for (what, value) in [
        ("the first step of a branch", first),
        ("the longest step of a branch", longest),
        ("the shortest step of a branch", shortest),
    ] {
        if !(value > 0.0 && value.is_finite()) {
            return Err(Error::BadBranch { what, value });
        }
    }
    Ok(())
}
