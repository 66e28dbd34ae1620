//! Maps that depend on a parameter.

use super::differences::pushed;
use crate::error::Error;
use equations::Jet;
use hybrid_system::Certainty;

/// The image of a point.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// The point.
    pub point: Vec<f64>,
    /// On which piece of the map the point is that was mapped: for a return map the mode and surface of each event on the way. On one
    /// piece the map is smooth. A smooth map has one piece, without a name.
    pub itinerary: Vec<String>,
    /// How long the way took: the return time. 1 for a map of numbers.
    pub time: f64,
    /// How certain it is that no event on the way was missed: the least certain one counts. [`Certainty::Exact`] for a map of numbers.
    pub certainty: Certainty,
}

impl Image {
    /// The image under a map of numbers, on the piece with this name; without a name if the map has one piece.
    pub fn of_number(point: Vec<f64>, piece: Option<String>) -> Image {
        Image {
            point,
            itinerary: piece.into_iter().collect(),
            time: 1.0,
            certainty: Certainty::Exact,
        }
    }
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
