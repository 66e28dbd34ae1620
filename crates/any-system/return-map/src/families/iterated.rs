//! A map that is applied several times.

use super::family::{Image, MapFamily};
use crate::checks::check_dimension;
use crate::error::Error;
use equations::Jet;
use std::ops::ControlFlow;

/// The image of a point, which has as many components. A map of a caller may break this promise.
pub(crate) fn image_of<M: MapFamily + ?Sized>(
    map: &M,
    point: &[f64],
    parameter: f64,
) -> Result<Image, Error> {
    let image = map.image(point, parameter)?;
    check_dimension("the image of a point", map.dimension(), image.point.len())?;
    Ok(image)
}

/// The point after some images.
pub(crate) fn point_after<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    images: usize,
) -> Result<Vec<f64>, Error> {
    let mut point = start.to_vec();
    for _ in 0..images {
        point = image_of(map, &point, parameter)?.point;
    }
    Ok(point)
}

/// The point to which an orbit comes with some images. It goes on behind a limit of infinitely many returns in finite time, to which image for
/// image it would come nearer for ever.
pub(crate) fn orbit_end<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    images: usize,
) -> Result<Vec<f64>, Error> {
    let mut last = start.to_vec();
    map.orbit(start, parameter, images, &mut |image| {
        last = image.point;
        ControlFlow::Continue(())
    })?;
    check_dimension("the image of a point", map.dimension(), last.len())?;
    Ok(last)
}

/// The point after some images, and the pieces of the map on the way.
pub(crate) fn orbit_after<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    images: usize,
) -> Result<(Vec<f64>, Vec<String>), Error> {
    let (mut point, mut itinerary) = (start.to_vec(), Vec::new());
    for _ in 0..images {
        let image = image_of(map, &point, parameter)?;
        itinerary.extend(image.itinerary);
        point = image.point;
    }
    Ok((point, itinerary))
}

/// A curve after some images, to third order.
pub(crate) fn curve_after<M: MapFamily + ?Sized>(
    map: &M,
    (mut curve, parameter): (Vec<Jet<4>>, Jet<4>),
    images: usize,
) -> Result<Vec<Jet<4>>, Error> {
    for _ in 0..images {
        curve = map.pushed(&curve, parameter)?.curve;
        check_dimension("the image of a curve", map.dimension(), curve.len())?;
    }
    Ok(curve)
}

/// The place at which two sequences of pieces differ first.
pub(crate) fn first_difference(a: &[String], b: &[String]) -> usize {
    let place = a.iter().zip(b).position(|(a, b)| a != b);
    place.unwrap_or(a.len().min(b.len()))
}
