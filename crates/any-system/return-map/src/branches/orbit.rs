//! The equations of a periodic point, and what its orbit shows.

use super::curve::Curve;
use crate::error::{Error, check_dimension};
use crate::families::{MapFamily, curve_after, orbit_after, point_after};
use equations::Jet;
use nalgebra::{Complex, DMatrix, DVector, Schur};
use std::ops::AddAssign;

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
pub(super) type Pushed = (Vec<Jet<4>>, Jet<4>);

impl<M: MapFamily + ?Sized> Orbit<'_, M> {
    /// How often the map is applied.
    fn times(&self) -> usize {
        match self.kind {
            Kind::Periodic(period) => period,
            Kind::Equilibrium => 1,
        }
    }

    /// The image of a curve under fⁿ, or under the field, to third order.
    pub(super) fn pushed(&self, curve: Pushed) -> Result<Vec<Jet<4>>, Error> {
        curve_after(self.map, curve, self.times())
    }

    /// The straight line through a point in a direction, of the point and the parameter.
    pub(super) fn line(&self, at: &DVector<f64>, direction: &DVector<f64>) -> Pushed {
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

    fn slopes(&self, at: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        let (mut point, parameter) = split(at);
        let dimension = point.len();
        let mut slopes = DMatrix::zeros(dimension, dimension + 1);
        slopes.fill_diagonal(1.0);
        for _ in 0..self.times() {
            let (image, own) = self.map.linearized(&point, parameter)?;
            check_dimension("the image of a point", dimension, own.nrows())?;
            check_dimension("the derivatives of an image", dimension + 1, own.ncols())?;
            slopes = own.columns(0, dimension) * slopes;
            slopes.column_mut(dimension).add_assign(&own.column(dimension));
            point = image.point;
        }
        for axis in 0..dimension {
            slopes[(axis, axis)] -= self.kind.at_fold();
        }
        Ok(slopes)
    }

    fn scales(&self) -> &DVector<f64> {
        &self.scales
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
}

/// Sweeps of the method for eigenvalues, for each of them. A few are usual; LAPACK stops at as many.
const MOST_SWEEPS: usize = 30;

/// The eigenvalues of a matrix; none if it has an entry that is not finite, or if they are not found.
///
/// The shifts of the method do not converge for some matrices with much symmetry, such as that of a cyclic shift. In other coordinates
/// these have none.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return Vec::new();
    }
    let n = matrix.nrows();
    let found = |matrix: DMatrix<f64>| Schur::try_new(matrix, f64::EPSILON, MOST_SWEEPS * (n + 1));
    let schur = found(matrix.clone()).or_else(|| {
        // A reflection in a direction without symmetry.
        let mut normal =
            DVector::from_fn(n, |k, _| (0.618_033_988_75 * (k + 1) as f64).fract() + 0.1);
        normal /= normal.norm();
        let reflection = DMatrix::identity(n, n) - &normal * normal.transpose() * 2.0;
        found(&reflection * matrix * &reflection)
    });
    schur.map_or(Vec::new(), |schur| schur.complex_eigenvalues().iter().copied().collect())
}
