//! The equations of a periodic point, and what its orbit shows.

use super::curve::{Curve, OnCurve};
use crate::checks::check_dimension;
use crate::error::Error;
use crate::families::{MapFamily, curve_after, orbit_after, point_after};
use crate::multipliers::Uncertain;
use equations::Jet;
use nalgebra::{Complex, DMatrix, DVector};

/// What the points of a branch are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// fⁿ(x) = x for a map f.
    Periodic(usize),
    /// f(x) = 0 for a field f.
    Equilibrium,
}

impl Kind {
    /// The eigenvalue at which two points meet.
    pub(super) fn at_fold(self) -> f64 {
        match self {
            Kind::Periodic(_) => 1.0,
            Kind::Equilibrium => 0.0,
        }
    }

    /// True if perturbations with these eigenvalues decay.
    pub(super) fn is_stable(self, eigenvalues: &[Complex<f64>]) -> bool {
        let decays = |value: &Complex<f64>| match self {
            Kind::Periodic(_) => value.norm() < 1.0,
            Kind::Equilibrium => value.re < 0.0,
        };
        !eigenvalues.is_empty() && eigenvalues.iter().all(decays)
    }
}

/// The curve of points and parameters: the unknowns are the components of x, and p.
pub(super) struct Orbit<'m, M: ?Sized> {
    /// The map, or the field.
    pub(super) map: &'m M,
    pub(super) kind: Kind,
    pub(super) scales: DVector<f64>,
}

/// A curve of points and parameters: the components, and the parameter.
pub(super) type PointCurve = (Vec<Jet<4>>, Jet<4>);

impl<M: MapFamily + ?Sized> Orbit<'_, M> {
    /// How often the map is applied.
    fn times(&self) -> usize {
        match self.kind {
            Kind::Periodic(period) => period,
            Kind::Equilibrium => 1,
        }
    }

    /// The image of a curve under fⁿ, or under the field, to third order.
    pub(super) fn pushed(&self, curve: PointCurve) -> Result<Vec<Jet<4>>, Error> {
        curve_after(self.map, curve, self.times())
    }

    /// The straight line through a point in a direction, of the point and the parameter.
    pub(super) fn line(&self, at: &DVector<f64>, direction: &DVector<f64>) -> PointCurve {
        let mut jets: Vec<Jet<4>> =
            at.iter().zip(direction.iter()).map(|(x, v)| Jet::moving(*x, *v)).collect();
        let parameter = jets.pop().unwrap_or(Jet::moving(f64::NAN, 0.0));
        (jets, parameter)
    }

    /// The pieces of the map that the orbit meets, one after the other.
    pub(super) fn itinerary(&self, at: &DVector<f64>) -> Result<Vec<String>, Error> {
        let (point, parameter) = split(at);
        Ok(orbit_after(self.map, (&point, parameter), self.times())?.1)
    }
}

/// The point and the parameter.
pub(super) fn split(at: &DVector<f64>) -> (Vec<f64>, f64) {
    let mut point: Vec<f64> = at.iter().copied().collect();
    let parameter = point.pop().unwrap_or(f64::NAN);
    (point, parameter)
}

impl<M: MapFamily + ?Sized> Curve for Orbit<'_, M> {
    fn values(&self, at: &DVector<f64>) -> Result<DVector<f64>, Error> {
        let (start, parameter) = split(at);
        let point = point_after(self.map, (&start, parameter), self.times())?;
        check_dimension("the image of a point", start.len(), point.len())?;
        let shift = self.kind.at_fold();
        let off = point.iter().zip(&start).map(|(f, x)| f - shift * x);
        Ok(DVector::from_iterator(start.len(), off))
    }

    fn slopes(&self, at: &DVector<f64>) -> Result<Uncertain, Error> {
        let (mut point, parameter) = split(at);
        let dimension = point.len();
        // One row more, in which the parameter stays what it is.
        let square = dimension + 1;
        let mut whole = Uncertain {
            matrix: DMatrix::identity(square, square),
            errors: DMatrix::zeros(square, square),
        };
        for _ in 0..self.times() {
            let own = self.map.linearized(&point, parameter)?;
            check_dimension("the image of a point", dimension, own.slopes.nrows())?;
            check_dimension("the derivatives of an image", square, own.slopes.ncols())?;
            let mut matrix = own.slopes.insert_row(dimension, 0.0);
            matrix[(dimension, dimension)] = 1.0;
            let own_errors = own.errors.insert_row(dimension, 0.0);
            whole = whole.after(&Uncertain { matrix, errors: own_errors });
            point = own.image.point;
        }
        for axis in 0..dimension {
            whole.matrix[(axis, axis)] -= self.kind.at_fold();
        }
        let [matrix, errors] = [whole.matrix, whole.errors].map(|all| all.remove_row(dimension));
        Ok(Uncertain { matrix, errors })
    }

    fn scales(&self) -> &DVector<f64> {
        &self.scales
    }
}

/// So many roundings beside the point of an orbit its derivative is computed again, at least.
const ROUNDINGS: f64 = 16.0;

impl<M: MapFamily + ?Sized> Orbit<'_, M> {
    /// Adds what the derivative of an orbit of several points changes with the rounding of its first one, which grows on the way.
    pub(super) fn add_error_of_point(&self, derivative: &mut Uncertain, of: &OnCurve) {
        if self.times() < 2 {
            return;
        }
        let mut beside = of.at.clone();
        let last = beside.len() - 1;
        // Some Newton steps, or some roundings.
        let step = 4.0 * of.error * self.scales[0];
        for x in beside.iter_mut().take(last) {
            *x += step.max(ROUNDINGS * f64::EPSILON * x.abs());
        }
        let Ok(slopes) = self.slopes(&beside) else { return };
        for row in 0..last {
            for axis in 0..last {
                let shift = self.kind.at_fold() * f64::from(row == axis);
                let other = slopes.matrix[(row, axis)] + shift;
                derivative.errors[(row, axis)] += (other - derivative.matrix[(row, axis)]).abs();
            }
        }
    }
}

impl<M: ?Sized> Orbit<'_, M> {
    /// Dfⁿ, or that of the field, from the slopes of a point of the curve, in units of the scales.
    pub(super) fn derivative(&self, slopes: &DMatrix<f64>) -> DMatrix<f64> {
        let dimension = slopes.nrows();
        DMatrix::from_fn(dimension, dimension, |row, axis| {
            slopes[(row, axis)] / self.scales[axis] + self.kind.at_fold() * f64::from(row == axis)
        })
    }

    /// The same, with its errors.
    pub(super) fn uncertain_derivative(&self, of: &OnCurve) -> Uncertain {
        let dimension = of.slopes.nrows();
        let errors = DMatrix::from_fn(dimension, dimension, |row, axis| {
            of.errors[(row, axis)] / self.scales[axis]
        });
        Uncertain { matrix: self.derivative(&of.slopes), errors }
    }
}
