//! Lyapunov exponents of maps.

use crate::checks::check_dimension;
use crate::error::Error;
use crate::families::{Linearized, MapFamily, orbit_end};
use crate::orbits::fate::STILL;
use nalgebra::DMatrix;

/// A mean over an orbit, with an interval that holds the limit with 95 % if the orbit is typical.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OrbitMean {
    /// The mean.
    pub value: f64,
    /// Lower end.
    pub lower: f64,
    /// Upper end.
    pub upper: f64,
}

/// The orbit is divided into so many parts, whose means are compared: those of neighbouring parts must be nearly independent, so that
/// more parts need a longer orbit; fewer give a wider interval.
const BATCHES: usize = 16;

/// The 97.5 % quantile of Student's distribution with 15 degrees of freedom.
const STUDENT: f64 = 2.131_449_546;

/// The Lyapunov exponents of an orbit.
#[derive(Debug, Clone, PartialEq)]
pub struct LyapunovExponents {
    /// For one image of the map, from the largest to the smallest.
    pub per_image: Vec<OrbitMean>,
    /// For one unit of time, in the same order: those of the flow, of a return map. The direction of the flow, which is not on the
    /// section, adds the exponent 0.
    pub per_time: Vec<OrbitMean>,
    /// The mean time of an image.
    pub mean_time: f64,
}

/// The Lyapunov exponents of the orbit of a point.
///
/// The derivative of the map moves a frame of vectors, which is made orthogonal after each image (Benettin's method). The `transient` images
/// are not counted; the `steps` after them are, rounded up to a multiple of 16. The interval is that of the means over 16 parts of
/// the orbit. An
/// orbit with a singular derivative, as a superstable cycle, has the exponent −∞, whose interval has no ends (NaN).
///
/// ```
/// use return_map::{lyapunov_exponents, scalar_family};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let found = lyapunov_exponents(&logistic, (&[0.3], 4.0), 100, 100_000)?.per_image[0];
/// assert!(found.lower < 2f64.ln() && 2f64.ln() < found.upper);
/// # Ok::<(), return_map::Error>(())
/// ```
///
/// # Errors
/// Errors of the map, and of its derivatives: an orbit that grazes has none. [`Error::NoImage`] if the derivative is not finite;
/// [`Error::Accumulates`] for an orbit that comes to infinitely many returns in finite time, as those of a chattering contact.
pub fn lyapunov_exponents<M: MapFamily + ?Sized>(
    map: &M,
    (start, parameter): (&[f64], f64),
    transient: usize,
    steps: usize,
) -> Result<LyapunovExponents, Error> {
    let dimension = map.dimension();
    check_dimension("the start of an orbit", dimension, start.len())?;
    let mut point = orbit_end(map, (start, parameter), transient)?;
    let per_batch = steps.div_ceil(BATCHES).max(1);
    let mut frame = DMatrix::<f64>::identity(dimension, dimension);
    let (mut batches, mut times) = (vec![vec![0.0; dimension]; BATCHES], vec![0.0; BATCHES]);
    let (mut total, mut still) = (0.0, 0);
    for (sums, time) in batches.iter_mut().zip(&mut times) {
        for _ in 0..per_batch {
            let Linearized { image, slopes, .. } = map.linearized(&point, parameter)?;
            check_dimension("the image of a point", dimension, slopes.nrows())?;
            check_dimension("the derivatives of an image", dimension + 1, slopes.ncols())?;
            if !slopes.iter().chain(&image.point).all(|x| x.is_finite()) {
                return Err(Error::NoImage { point, parameter });
            }
            still = if total + image.time == total { still + 1 } else { 0 };
            if still == STILL {
                return Err(Error::Accumulates { point, parameter });
            }
            total += image.time;
            *time += image.time;
            let qr = (slopes.columns(0, dimension) * &frame).qr();
            let r = qr.r();
            for (axis, sum) in sums.iter_mut().enumerate() {
                *sum += pxfm::f_log(r[(axis, axis)].abs());
            }
            (frame, point) = (qr.q(), image.point);
        }
    }
    let count = per_batch as f64;
    let mut axes: Vec<[OrbitMean; 2]> = (0..dimension)
        .map(|axis| {
            let of = |unit: &dyn Fn(usize) -> f64| {
                mean(batches.iter().enumerate().map(|(k, sums)| sums[axis] / unit(k)))
            };
            [of(&|_| count), of(&|k| times[k])]
        })
        .collect();
    axes.sort_by(|a, b| b[0].value.total_cmp(&a[0].value));
    let (per_image, per_time) = axes.into_iter().map(|[image, time]| (image, time)).unzip();
    let mean_time = times.iter().sum::<f64>() / (count * BATCHES as f64);
    Ok(LyapunovExponents { per_image, per_time, mean_time })
}

/// The mean over the parts of an orbit.
fn mean(parts: impl Iterator<Item = f64>) -> OrbitMean {
    let parts: Vec<f64> = parts.collect();
    let count = parts.len() as f64;
    let value = parts.iter().sum::<f64>() / count;
    let squares = parts.iter().map(|part| (part - value) * (part - value)).sum::<f64>();
    let error = STUDENT * (squares / (count * (count - 1.0))).sqrt();
    OrbitMean { value, lower: value - error, upper: value + error }
}
