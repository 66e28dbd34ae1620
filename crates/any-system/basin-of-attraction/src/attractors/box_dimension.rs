//! The box dimension of an attractor, from the boxes that an orbit visits.

use crate::attractors::known_cells::{CellHasher, CellSet};
use crate::attractors::state_map::{Moving, StateMap};
use crate::error::Error;
use crate::shares::sampling::check_count;
use crate::statistics::power_law::{PowerLaw, power_law};
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::hash::Hasher;

/// Replicates with other offsets of the boxes: enough for an interval of their chance.
const REPLICATES: u64 = 8;

/// The law N(ε) ∝ ε^(−D) of the number of boxes of size ε that an orbit of so many points visits, from a point of an attractor: `exponent` is D. Boxes are
/// cubes with random offsets, for eight replicates. The sizes need three decades for an interval, and the orbit many points for each of the smallest
/// boxes: with too few of them the local slopes fall at small sizes, and the interval grows, or is refused.
///
/// ```
/// use basin_of_attraction::{array_map, box_dimension};
/// // A rotation by an irrational angle fills a circle.
/// let (sine, cosine) = 1f64.sin_cos();
/// let turn = array_map(move |[x, y]: [f64; 2]| Some([cosine * x - sine * y, sine * x + cosine * y]));
/// let sizes: Vec<f64> = (0..10).map(|k| 0.3 * 10f64.powf(-3.1 * f64::from(k) / 9.0)).collect();
/// let law = box_dimension(&turn, &[1.0, 0.0], 200_000, &sizes, 1)?;
/// assert!(law.interval.is_ok_and(|interval| interval.covers(1.0) && interval.half_width() < 0.05));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::TooManySamples`]; [`Error::BadPoints`] if the orbit stops or is not finite; [`Error::BadBoxSize`] for sizes that are not positive, or so small
/// that boxes could not be numbered; as [`power_law`](crate::power_law()).
pub fn box_dimension(
    map: &dyn StateMap,
    start: &[f64],
    points: usize,
    sizes: &[f64],
    seed: u64,
) -> Result<PowerLaw, Error> {
    check_count(points)?;
    let orbit = orbit(map, start, points)?;
    let largest = orbit.iter().fold(0.0f64, |most, x| most.max(x.abs()));
    // The number of a box along an axis has no fraction beyond 2⁵².
    let above = f64::EPSILON * largest;
    if let Some(&size) = sizes.iter().find(|size| !(**size > above && size.is_finite())) {
        return Err(Error::BadBoxSize { size, above, largest: f64::INFINITY });
    }
    let random = SplitMix64::from_seed(seed);
    let dimension = start.len();
    let replicate = |number: u64| {
        let offsets: Vec<f64> =
            (0..dimension as u64).map(|k| random.uniform(number * dimension as u64 + k)).collect();
        // One over the number, so that the exponent is the dimension.
        let at = |&size: &f64| (size, 1.0 / visited(&orbit, &offsets, size) as f64);
        sizes.iter().map(at).collect::<Vec<(f64, f64)>>()
    };
    let replicates: Vec<Vec<(f64, f64)>> = (0..REPLICATES).into_par_iter().map(replicate).collect();
    power_law(&replicates)
}

/// The coordinates of successive points.
fn orbit(map: &dyn StateMap, start: &[f64], points: usize) -> Result<Vec<f64>, Error> {
    let mut point = Moving::from(start);
    let mut coordinates = Vec::new();
    for number in 0..points {
        if point.at.iter().any(|x| !x.is_finite()) || (number > 0 && !point.step(map)) {
            return Err(Error::BadPoints { bad: points - number, points, left: 0.0 });
        }
        coordinates.extend_from_slice(&point.at);
    }
    Ok(coordinates)
}

/// The number of boxes of a size, shifted by these parts of it.
fn visited(orbit: &[f64], offsets: &[f64], size: f64) -> usize {
    let mut boxes = CellSet::default();
    for point in orbit.chunks_exact(offsets.len().max(1)) {
        // Boxes by the hash of their numbers: of 10⁶ of them two have the same one in 1 of 10⁷ cases.
        let mut hasher = CellHasher::default();
        for (x, offset) in point.iter().zip(offsets) {
            hasher.write_u64(((x / size + offset).floor() as i64).cast_unsigned());
        }
        boxes.insert(hasher.finish());
    }
    boxes.len()
}
