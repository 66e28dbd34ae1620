//! Maps that depend on a parameter.

use super::border::{Border, BorderSite, Clearance};
use super::derivatives::{Linearized, Pushed};
use super::differences::differences;
use crate::error::Error;
use equations::Jet;
use hybrid_system::Certainty;
use std::ops::{ControlFlow, Deref};

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

    /// The images of a point, one after the other, at most so many: `see` receives each. If it breaks, the orbit ends there.
    ///
    /// A return map goes on with the execution: where its returns become infinitely many in finite time, as those of a chattering contact,
    /// the orbit passes their limit. Image for image it would come nearer to the limit for ever.
    ///
    /// # Errors
    /// Why the last point that `see` has received has no image.
    fn orbit(
        &self,
        start: &[f64],
        parameter: f64,
        images: usize,
        see: &mut dyn FnMut(Image) -> ControlFlow<()>,
    ) -> Result<(), Error> {
        let mut point = start.to_vec();
        for _ in 0..images {
            let image = self.image(&point, parameter)?;
            point.clone_from(&image.point);
            if see(image).is_break() {
                break;
            }
        }
        Ok(())
    }

    /// The image of a curve x(s), p(s), to third order in s: [`Jet`]s with the coefficients of 1, s, s² and s³. All derivatives of the
    /// map follow from such ones.
    ///
    /// Default: by differences of order six, twice, at two distances. They are shortened until both first derivatives agree to ten
    /// digits; where no distance gives that many, the best one is taken, if it has three. On a smooth map with values to rounding, on
    /// the scale of max(1, |x|), the first derivative has some twelve digits, the second and the third have eight. A feature that is narrower
    /// than 10⁻³ of this scale may be passed over: take units in which points, and what the map does to them, are of size 1.
    ///
    /// # Errors
    /// Those of the map. [`Error::Differences`] if it has several pieces there, or no derivative.
    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Pushed, Error> {
        differences(&|point: &[f64], parameter| self.image(point, parameter), curve, parameter)
    }

    /// The image, and its derivatives by the components of the point and, in the last column, by the parameter.
    ///
    /// Default: those of [`pushed`](Self::pushed).
    ///
    /// # Errors
    /// Those of the map and of its derivatives.
    fn linearized(&self, point: &[f64], parameter: f64) -> Result<Linearized, Error> {
        let image = self.image(point, parameter)?;
        let pushed = |curve: &[Jet<4>], parameter| self.pushed(curve, parameter);
        Linearized::along_axes(image, (point, parameter), pushed)
    }

    /// How near the orbits of a curve of starts come to the surfaces that they do not meet. On a branch a surface that is touched and
    /// left again between two of its points is found by it.
    ///
    /// Default: `None`. A map of numbers has no surfaces.
    ///
    /// # Errors
    /// Those of the map.
    fn clearances(
        &self,
        curve: &[Jet<4>],
        parameter: Jet<4>,
    ) -> Result<Option<Vec<Clearance>>, Error> {
        let _ = (curve, parameter);
        Ok(None)
    }

    /// What lies between the pieces `own` and `beyond`, which differ first at `place`, beside a point that is on one of them.
    /// `within` is the largest distance from the border, in parts of the size of the guard.
    ///
    /// Default: [`Border::Piece`].
    fn border(
        &self,
        at: (&[f64], f64),
        (own, beyond): (&[String], &[String]),
        place: usize,
        within: f64,
    ) -> BorderSite {
        let _ = (at, beyond, within);
        BorderSite { border: Border::Piece, itinerary: own.to_vec(), place, side: 1.0 }
    }

    /// The map of one piece, as it goes on smoothly beyond its borders. With a border the images have one component more, a number that
    /// is zero on it.
    ///
    /// # Errors
    /// [`Error::NoPassage`] if the map does not go on; [`Error::BorderNotFollowed`] for a border of another kind than a grazing or
    /// a corner. Default: the former.
    fn along(
        &self,
        itinerary: &[String],
        border: Option<&BorderSite>,
    ) -> Result<Box<dyn MapFamily + '_>, Error> {
        let _ = border;
        Err(Error::NoPassage { event: itinerary.join(", ") })
    }

    /// Why there are no further images at all: [`Error::Stopped`] of a map that is [watched](super::watched) and was stopped. Default: `None`.
    fn stopped(&self) -> Option<Error> {
        None
    }
}

/// A reference or a box of a map is this map.
impl<P: Deref<Target: MapFamily> + Sync> MapFamily for P {
    fn dimension(&self) -> usize {
        (**self).dimension()
    }
    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        (**self).image(point, parameter)
    }
    fn orbit(
        &self,
        start: &[f64],
        parameter: f64,
        images: usize,
        see: &mut dyn FnMut(Image) -> ControlFlow<()>,
    ) -> Result<(), Error> {
        (**self).orbit(start, parameter, images, see)
    }
    fn pushed(&self, curve: &[Jet<4>], parameter: Jet<4>) -> Result<Pushed, Error> {
        (**self).pushed(curve, parameter)
    }
    fn linearized(&self, point: &[f64], parameter: f64) -> Result<Linearized, Error> {
        (**self).linearized(point, parameter)
    }
    fn clearances(
        &self,
        curve: &[Jet<4>],
        parameter: Jet<4>,
    ) -> Result<Option<Vec<Clearance>>, Error> {
        (**self).clearances(curve, parameter)
    }
    fn border(
        &self,
        at: (&[f64], f64),
        pieces: (&[String], &[String]),
        place: usize,
        within: f64,
    ) -> BorderSite {
        (**self).border(at, pieces, place, within)
    }
    fn along(
        &self,
        itinerary: &[String],
        border: Option<&BorderSite>,
    ) -> Result<Box<dyn MapFamily + '_>, Error> {
        (**self).along(itinerary, border)
    }
    fn stopped(&self) -> Option<Error> {
        (**self).stopped()
    }
}
