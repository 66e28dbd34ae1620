//! Maps by functions of numbers.

use super::family::{Image, MapFamily};
use crate::checks::check_dimension;
use crate::error::Error;

/// A map by a closure, whose derivatives are differences.
#[derive(Debug, Clone, Copy)]
pub struct Closure<F> {
    dimension: usize,
    map: F,
}

impl<F: Fn(&[f64], f64) -> Result<Image, Error> + Sync> MapFamily for Closure<F> {
    fn dimension(&self) -> usize {
        self.dimension
    }

    fn image(&self, point: &[f64], parameter: f64) -> Result<Image, Error> {
        check_dimension("a point of a map", self.dimension, point.len())?;
        let image = (self.map)(point, parameter)?;
        check_dimension("the image of a point", self.dimension, image.point.len())?;
        match image.point.iter().all(|x| x.is_finite()) {
            true => Ok(image),
            false => Err(Error::NoImage { point: point.to_vec(), parameter }),
        }
    }
}

/// A smooth map of numbers by its formula f(x, p).
///
/// ```
/// use return_map::{MapFamily, scalar_family};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// assert_eq!(logistic.image(&[0.5], 3.0)?.point, [0.75]);
/// # Ok::<(), return_map::Error>(())
/// ```
pub fn scalar_family(map: impl Fn(f64, f64) -> f64 + Sync) -> impl MapFamily {
    let map = move |x: &[f64], p: f64| {
        let x = x.first().copied().unwrap_or(f64::NAN);
        Ok(Image::of_number(vec![map(x, p)], None))
    };
    Closure { dimension: 1, map }
}

/// A smooth map of points with this number of components, f(x, p). Each image takes the time 1.
pub fn family(
    dimension: usize,
    map: impl Fn(&[f64], f64) -> Result<Vec<f64>, Error> + Sync,
) -> impl MapFamily {
    let map = move |x: &[f64], p: f64| Ok(Image::of_number(map(x, p)?, None));
    Closure { dimension, map }
}

/// A map of several pieces: the image f(x, p), and the name of the piece on which x is. On one piece the map is smooth.
pub fn pieces<N: ToString>(
    dimension: usize,
    map: impl Fn(&[f64], f64) -> Result<(Vec<f64>, N), Error> + Sync,
) -> impl MapFamily {
    let map = move |x: &[f64], p: f64| {
        let (point, piece) = map(x, p)?;
        Ok(Image::of_number(point, Some(piece.to_string())))
    };
    Closure { dimension, map }
}
