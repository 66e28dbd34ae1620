//! The image of a set on a surface that all its states cross.

use crate::matrix::{Matrix, common, dot};
use crate::set::AffineSet;
use crate::system::ValidatedMode;
use crate::tube::Tube;
use crate::undecided::Reason;
use crate::window::crossing_of_centre;
use equations::Formulas;
use interval_arithmetic::Enclosure;

/// A set on a surface.
#[derive(Debug)]
pub(crate) struct OnSurface {
    /// The states at which the surface is crossed.
    pub(crate) set: AffineSet,
    /// Their derivatives with respect to the states at the start of the step.
    pub(crate) derivatives: Matrix,
    /// The times of the crossings since the start of the step.
    pub(crate) times: Enclosure,
}

/// The image of the set of a step on the surface of a guard that all states cross at these times.
///
/// The state P(x) at the crossing of the solution from x has the derivatives (I − f ∇g/(∇g·f)) V, with f and ∇g at P(x) and V = ∂φ/∂x
/// at the time of the crossing. So P is enclosed by its value at the centre and its derivatives on the set.
pub(crate) fn on_surface(
    tube: &Tube<'_>,
    mode: &ValidatedMode,
    guard: usize,
    times: Enclosure,
) -> Result<OnSurface, Reason> {
    let surface = &mode.guards[guard];
    let of_centre = crossing_of_centre(tube, guard, times);
    let at_centre = tube.centre_at(of_centre);
    let Some(varied) = tube.derivatives_at(times) else {
        return Err(Reason::Grazing { surface: surface.surface });
    };
    // The derivatives and the times, from a box of the states on the surface.
    let enclosed = |bounds: &[Enclosure]| {
        let values = |formulas: &Formulas| {
            formulas.enclosures(Enclosure::ZERO, bounds).map_err(Reason::Domain)
        };
        let (field, gradient) = (values(&mode.field)?, values(&surface.gradient)?);
        let rate = dot(&gradient, field.iter().copied());
        if rate.sign().is_none() {
            return Err(Reason::Grazing { surface: surface.surface });
        }
        let times_of_all = arrival_times(tube, &gradient, rate, &varied, of_centre);
        let times = times.intersection(&times_of_all).unwrap_or_else(|| times.hull(&times_of_all));
        Ok((projection(&field, &gradient, rate).times(&varied), times))
    };
    let bounds = tube.states_at(times);
    // The second time the image is about as narrow as it gets.
    let (derivatives, _) = enclosed(&bounds)?;
    let bounds = common(&bounds, &tube.set.values(&at_centre, &derivatives));
    let (derivatives, times) = enclosed(&bounds)?;
    let set = tube.set.image(&at_centre, &derivatives, Some(&bounds));
    Ok(OnSurface { set, derivatives, times })
}

/// I − f ∇g/(∇g·f). If the surface is a value of one component, this component does not change at all.
fn projection(field: &[Enclosure], gradient: &[Enclosure], rate: Enclosure) -> Matrix {
    let size = field.len();
    let mut others = (0..size).filter(|&axis| gradient[axis] != Enclosure::ZERO);
    let only = others.next().filter(|_| others.next().is_none());
    Matrix::from_fn(size, size, |row, column| {
        let unit = Enclosure::from(f64::from(row == column));
        match only {
            Some(axis) if row == axis => Enclosure::ZERO,
            Some(axis) if column == axis => -(field[row] / field[axis]),
            Some(_) => unit,
            None => unit - field[row] * gradient[column] / rate,
        }
    })
}

/// The times of the crossings: that of the centre, and −∇g·V/(∇g·f) as their derivatives.
fn arrival_times(
    tube: &Tube<'_>,
    gradient: &[Enclosure],
    rate: Enclosure,
    varied: &Matrix,
    of_centre: Enclosure,
) -> Enclosure {
    let slopes = Matrix::from_fn(1, gradient.len(), |_, column| {
        -(dot(gradient, (0..gradient.len()).map(|row| varied.at(row, column))) / rate)
    });
    tube.set.values(&[of_centre], &slopes)[0]
}
