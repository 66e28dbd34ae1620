//! The equations of a periodic point, and what its orbit shows.

use super::curve::Curve;
use crate::error::Error;
use crate::families::MapFamily;
use equations::Jet;
use nalgebra::{Complex, DMatrix, DVector};

/// The curve fⁿ(x; p) = x of points and parameters: the unknowns are the components of x, and p.
pub(super) struct Orbit<'m, M: ?Sized> {
    pub(super) map: &'m M,
    pub(super) period: usize,
    pub(super) scales: DVector<f64>,
}

/// A curve of points and parameters: the components, and the parameter.
pub(super) type Pushed = (Vec<Jet<4>>, Jet<4>);

impl<M: MapFamily + ?Sized> Orbit<'_, M> {
    /// The image of a curve under fⁿ, to third order.
    pub(super) fn pushed(&self, (mut curve, parameter): Pushed) -> Result<Vec<Jet<4>>, Error> {
        for _ in 0..self.period {
            curve = self.map.pushed(&curve, parameter)?;
        }
        Ok(curve)
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
        let (mut point, parameter) = split(at);
        let mut itinerary = Vec::new();
        for _ in 0..self.period {
            let image = self.map.image(&point, parameter)?;
            itinerary.extend(image.itinerary);
            point = image.point;
        }
        Ok(itinerary)
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
        let mut point = start.clone();
        for _ in 0..self.period {
            point = self.map.image(&point, parameter)?.point;
        }
        Ok(DVector::from_iterator(start.len(), point.iter().zip(&start).map(|(f, x)| f - x)))
    }

    fn slopes(&self, at: &DVector<f64>) -> Result<DMatrix<f64>, Error> {
        let dimension = self.map.dimension();
        let mut slopes = DMatrix::zeros(dimension, dimension + 1);
        for axis in 0..=dimension {
            let mut direction = DVector::zeros(dimension + 1);
            direction[axis] = 1.0;
            let image = self.pushed(self.line(at, &direction))?;
            for (row, jet) in image.iter().enumerate() {
                slopes[(row, axis)] = jet.0[1] - f64::from(row == axis);
            }
        }
        Ok(slopes)
    }

    fn scales(&self) -> &DVector<f64> {
        &self.scales
    }
}

/// Dfⁿ from the slopes of a point of the curve, in units of the scales.
pub(super) fn derivative(slopes: &DMatrix<f64>, scales: &DVector<f64>) -> DMatrix<f64> {
    let dimension = slopes.nrows();
    DMatrix::from_fn(dimension, dimension, |row, axis| {
        slopes[(row, axis)] / scales[axis] + f64::from(row == axis)
    })
}

/// The eigenvalues of a matrix; none if it has an entry that is not finite.
pub(super) fn eigenvalues(matrix: &DMatrix<f64>) -> Vec<Complex<f64>> {
    match matrix.iter().all(|entry| entry.is_finite()) {
        true => matrix.complex_eigenvalues().iter().copied().collect(),
        false => Vec::new(),
    }
}
