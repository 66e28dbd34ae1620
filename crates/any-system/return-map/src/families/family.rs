//! Maps that depend on a parameter.

use super::differences::pushed;
use crate::error::Error;
use equations::Jet;

/// The image of a point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Image {
    /// The point.
    pub point: Vec<f64>,
    /// On which piece of the map the point is that was mapped: for a return map the modes and surfaces on the way. On one piece the
    /// map is smooth. A smooth map has one piece, without a name.
    pub itinerary: Vec<String>,
}

/// A map x ↦ f(x; p) of points with some components, which depends on a parameter p.
pub trait MapFamily: Sync {
    /// The number of components of a point.
    fn dimension(&self) -> usize;

    /// f(x; p).
    ///
    /// # Errors
    /// Why the point has no image.
    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error>;

    /// The image of a curve x(s), p(s), to third order in s: [`Jet`]s with the coefficients of 1, s, s² and s³. All derivatives of the
    /// map follow from such ones.
    ///
    /// Default: by differences of order six. On a smooth map with values to rounding, on the scale of max(1, |x|), the first
    /// derivative has some twelve digits, the second and the third have eight.
    ///
    /// # Errors
    /// Those of the map. [`Error::Differences`] if it has several pieces there.
    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Vec<Jet<4>>, Error> {
        pushed(self, curve, parameter)
    }
}

impl<T: MapFamily + ?Sized> MapFamily for &T {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }
    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        (**self).image(point, parameter)
    }
    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Vec<Jet<4>>, Error> {
        (**self).pushed(curve, parameter)
    }
}
