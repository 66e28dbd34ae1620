//! Derivatives of a map, and how far they are known.

use super::family::Image;
use crate::error::Error;
use equations::Jet;
use nalgebra::DMatrix;

/// The image of a curve under a map, to third order in its parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Pushed {
    /// The components, with the coefficients of 1, s, s² and s³.
    pub curve: Vec<Jet<4>>,
    /// How far the coefficient of s may be from the exact one, for each component: an estimate.
    pub errors: Vec<f64>,
}

impl Pushed {
    /// Coefficients that are exact to rounding.
    pub fn exact(curve: Vec<Jet<4>>) -> Pushed {
        let largest = curve.iter().fold(0.0, |largest: f64, jet| largest.max(jet.0[1].abs()));
        Pushed::within(curve, f64::EPSILON * largest)
    }

    /// Coefficients of which those of s are known to this error.
    pub(super) fn within<const T: usize>(curve: Vec<Jet<T>>, error: f64) -> Pushed {
        let errors = vec![error; curve.len()];
        Pushed { curve: curve.iter().map(third_order).collect(), errors }
    }
}

/// A jet with the terms up to the third one.
pub(super) fn third_order<const T: usize>(jet: &Jet<T>) -> Jet<4> {
    Jet([0, 1, 2, 3].map(|k| jet.0.get(k).copied().unwrap_or(0.0)))
}

/// The image of a point, with the derivatives of the map.
#[derive(Debug, Clone, PartialEq)]
pub struct Linearized {
    /// The image.
    pub image: Image,
    /// The derivatives by the components of the point, and in the last column by the parameter.
    pub slopes: DMatrix<f64>,
    /// How far each derivative may be from the exact one: an estimate. That of differences is what changes with their distance. That of an
    /// integrated motion is its tolerance for each arc, which grows as neighbours part on the way. That of formulas is one rounding of the
    /// largest: terms that cancel have more.
    pub errors: DMatrix<f64>,
}

impl Linearized {
    /// The derivatives along each component and the parameter, by the images of lines.
    pub(crate) fn along_axes<const T: usize>(
        image: Image,
        (point, parameter): (&[f64], f64),
        pushed: impl Fn(&[Jet<T>], Jet<T>) -> Result<Pushed, Error>,
    ) -> Result<Linearized, Error> {
        let mut slopes = DMatrix::zeros(image.point.len(), point.len() + 1);
        let mut errors = slopes.clone();
        for axis in 0..=point.len() {
            let along = |(k, x): (usize, &f64)| Jet::moving(*x, f64::from(k == axis));
            let curve: Vec<Jet<T>> = point.iter().enumerate().map(along).collect();
            let parameter = Jet::moving(parameter, f64::from(axis == point.len()));
            let found = pushed(&curve, parameter)?;
            for (row, (jet, error)) in found.curve.iter().zip(&found.errors).enumerate() {
                (slopes[(row, axis)], errors[(row, axis)]) = (jet.0[1], *error);
            }
        }
        Ok(Linearized { image, slopes, errors })
    }
}
