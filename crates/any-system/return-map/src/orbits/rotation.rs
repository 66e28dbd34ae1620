//! How fast an orbit turns: the rotation number.

use crate::error::Error;
use crate::families::{MapFamily, orbit_end};
use std::ops::ControlFlow;

/// The mean number of turns of an orbit for one image.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotationNumber {
    /// The weighted mean. On a smooth circle with an irrational number of Diophantine type its error falls faster than any power of the
    /// number of images.
    pub value: f64,
    /// Lower end: the plain mean less one turn over the number of images. For a map of the circle that keeps the order of points the limit
    /// is between both ends (H. Poincaré).
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

/// The rotation number of the orbit of a point. `turn` gives the part of a turn from a point to its image. The `transient` images are
/// not counted; the `images` after them are.
///
/// The mean has weights that vanish at both ends with all derivatives: S. Das, Y. Saiki, E. Sander, J. A. Yorke, *Quantitative
/// quasiperiodicity*, Nonlinearity 30, 4111 (2017).
///
/// ```
/// use return_map::{rotation_number, scalar_family};
/// // The circle map in turns, without taking off whole turns.
/// let circle = scalar_family(|x, w| x + w - 0.1 * (std::f64::consts::TAU * x).sin() / 6.0);
/// let found = rotation_number(&circle, (&[0.2], 0.5), 5000, 1000, |x, image| image[0] - x[0])?;
/// // By symmetry there is a cycle of period two.
/// assert!((found.value - 0.5).abs() < 1e-9);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// Errors of the map; [`Error::NoImage`] if a turn is not finite; [`Error::BadArgument`] without images, and if the sum of the turns is not
/// finite.
pub fn rotation_number<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    transient: usize,
    images: usize,
    turn: impl Fn(&[f64], &[f64]) -> f64,
) -> Result<RotationNumber, Error> {
    if images == 0 {
        return Err(Error::BadArgument {
            what: "the number of images of a rotation number",
            value: 0.0,
        });
    }
    let mut point = orbit_end(map, (start, parameter), transient)?;
    let first = point.clone();
    let (mut sum, mut weighted, mut weights) = (0.0, 0.0, 0.0);
    let (mut k, mut failed) = (0usize, None);
    map.orbit(&first, parameter, images, &mut |image| {
        let part = turn(&point, &image.point);
        if !part.is_finite() {
            failed = Some(Error::NoImage { point: point.clone(), parameter });
            return ControlFlow::Break(());
        }
        let place = (k as f64 + 0.5) / images as f64;
        let weight = pxfm::f_exp(-1.0 / (place * (1.0 - place)));
        sum += part;
        weighted += weight * part;
        weights += weight;
        k += 1;
        point.clone_from(&image.point);
        ControlFlow::Continue(())
    })?;
    if let Some(error) = failed {
        return Err(error);
    }
    let count = images as f64;
    let mean = sum / count;
    if !(mean.is_finite() && weighted.is_finite()) {
        return Err(Error::BadArgument { what: "the number of turns of an orbit", value: mean });
    }
    Ok(RotationNumber {
        value: weighted / weights,
        lower: mean - 1.0 / count,
        upper: mean + 1.0 / count,
    })
}
