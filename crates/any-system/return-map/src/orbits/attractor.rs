//! Periodic orbits that attract, with a neighbourhood that leads to each.

use crate::branches::{BranchPoint, size_of, solve_periodic};
use crate::error::Error;
use crate::families::{MapFamily, orbit_after};
use nalgebra::{DMatrix, DVector};
use std::ops::ControlFlow;

/// An attracting periodic orbit, and a trap: an ellipsoid about its first point that fⁿ shrinks towards this point.
///
/// The shape of the ellipsoid is that in which the derivative of fⁿ contracts. Its size is the largest one, by halving, at which fⁿ brings
/// 256 points of it closer (on the line eight), on the same pieces of the map. What happens between these points is not proved.
#[derive(Debug, Clone, PartialEq)]
pub struct PeriodicAttractor {
    /// The first point, with multipliers and itinerary.
    pub point: BranchPoint,
    /// The points of the orbit, in order. Their number is the least period.
    pub orbit: Vec<Vec<f64>>,
    /// The ellipsoid: vᵀ P v ≤ r² for the distance v from the first point.
    shape: DMatrix<f64>,
    radius: f64,
}

/// Points of a trap that are tested, and the parts of its radius at which they are.
const TESTED: usize = 256;
const RADII: [f64; 4] = [1.0, 0.75, 0.5, 0.25];

/// The most halvings of a trap's size: from the size of its point to that of rounding.
const MOST_HALVINGS: usize = 50;

/// Doublings of the sum of the shape: for multipliers up to 1 − 10⁻⁹.
const MOST_DOUBLINGS: usize = 40;

impl PeriodicAttractor {
    /// The attracting orbit of this period through a point near `start`.
    ///
    /// # Errors
    /// [`Error::NoPeriodicPoint`] if none is found; [`Error::NoTrap`] if it does not attract, or if the map has a border at its points;
    /// those of the map.
    pub fn new<M: MapFamily + ?Sized>(
        map: &M,
        period: usize,
        (start, parameter): (&[f64], f64),
    ) -> Result<PeriodicAttractor, Error> {
        let (mut point, mut derivative) = solve_periodic(map, period, (start, parameter))?;
        let mut orbit = orbit_of(map, &point, period)?;
        // A point of a shorter period is one of the longer period, too.
        let size = size_of(orbit.iter().flatten().chain(start));
        let is_least = |n: &usize| {
            period.is_multiple_of(*n) && distance(&orbit[*n % period], &point.point) <= SAME * size
        };
        let least = (1..period).find(is_least).unwrap_or(period);
        if least < period {
            (point, derivative) = solve_periodic(map, least, (&point.point, parameter))?;
            orbit.truncate(least);
        }
        let no_trap = || Error::NoTrap {
            point: point.point.clone(),
            parameter,
            multiplier: point.spectral_radius(),
        };
        let shape = shape(&derivative).filter(|_| point.is_stable).ok_or_else(no_trap)?;
        let longest = shape.clone().symmetric_eigenvalues().max();
        let factor = root_of_mean(1.0 - 1.0 / longest);
        let root = shape.clone().cholesky().ok_or_else(no_trap)?.l().transpose();
        let tests = tests(&root).ok_or_else(no_trap)?;
        let error = no_trap();
        let radius = size * longest.sqrt();
        let mut found = PeriodicAttractor { point, orbit, shape, radius };
        for _ in 0..MOST_HALVINGS {
            if found.shrinks(map, &tests, factor) {
                // On the border of the trap a comparison could go either way.
                found.radius *= 0.99;
                return Ok(found);
            }
            found.radius *= 0.5;
        }
        Err(map.stopped().unwrap_or(error))
    }

    /// True if fⁿ brings these points of the ellipsoid closer, at least by a factor.
    fn shrinks<M: MapFamily + ?Sized>(
        &self,
        map: &M,
        tests: &[(f64, DVector<f64>)],
        factor: f64,
    ) -> bool {
        tests.iter().all(|(part, offset)| {
            let first = self.point.point.iter().zip(offset.iter());
            let start: Vec<f64> = first.map(|(x, v)| x + v * self.radius).collect();
            let after = orbit_after(map, (&start, self.point.parameter), self.orbit.len());
            after.is_ok_and(|(at, itinerary)| {
                self.distance(&at) <= factor * part * self.radius
                    && itinerary == self.point.itinerary
            })
        })
    }

    /// The distance from the first point, in the norm of the trap.
    fn distance(&self, point: &[f64]) -> f64 {
        let off: DVector<f64> = DVector::from_iterator(
            point.len(),
            point.iter().zip(&self.point.point).map(|(x, own)| x - own),
        );
        off.dot(&(&self.shape * &off)).sqrt()
    }

    /// True if a point is in the trap.
    pub fn contains(&self, point: &[f64]) -> bool {
        point.len() == self.point.point.len() && self.distance(point) <= self.radius
    }
}

/// Points of an orbit that are so close, on its scale, are the same one: Newton's method finds it to rounding, and one of a long period
/// to that of many images.
const SAME: f64 = 1e-9;

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
}

fn orbit_of<M: MapFamily + ?Sized>(
    map: &M,
    point: &BranchPoint,
    period: usize,
) -> Result<Vec<Vec<f64>>, Error> {
    let mut orbit = vec![point.point.clone()];
    for _ in 1..period {
        let last = orbit.last().map_or(&[][..], Vec::as_slice);
        orbit.push(map.image(last, point.parameter)?.point);
    }
    Ok(orbit)
}

/// Halfway between a contraction and none, of the squares of lengths.
fn root_of_mean(squared: f64) -> f64 {
    (0.5 * (1.0 + squared)).sqrt()
}

/// Σ (Aᵀ)ᵏ Aᵏ: in the norm of this matrix A contracts (Stein's equation P − AᵀPA = 1). `None` if the sum does not end.
fn shape(derivative: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let n = derivative.nrows();
    let (mut sum, mut power) = (DMatrix::identity(n, n), derivative.clone());
    for _ in 0..MOST_DOUBLINGS {
        let more = power.transpose() * &sum * &power;
        sum += &more;
        if more.amax() <= f64::EPSILON * sum.amax() {
            return Some(sum);
        }
        power = &power * &power;
    }
    None
}

/// Points of the ellipsoid vᵀ P v ≤ 1 that are tested: the part of its radius, and the offset v, where P = RᵀR for the `root` R. Both signs of
/// each direction are there, at each radius. `None` for a singular root.
fn tests(root: &DMatrix<f64>) -> Option<Vec<(f64, DVector<f64>)>> {
    let dimension = root.nrows();
    // On the line there are two directions.
    let directions = if dimension == 1 { 1 } else { TESTED / (2 * RADII.len()) };
    // The powers of the positive root of x^(d+1) = x + 1 have no small ratios (M. Roberts's sequence).
    let mut ratio: f64 = 1.5;
    for _ in 0..60 {
        ratio = pxfm::f_pow(1.0 + ratio, 1.0 / (dimension as f64 + 1.0));
    }
    let mut found = Vec::with_capacity(2 * RADII.len() * directions);
    for number in 0..directions {
        let direction = DVector::from_fn(dimension, |axis, _| {
            let step = pxfm::f_pow(ratio, -(axis as f64 + 1.0));
            2.0 * ((number as f64 + 0.5) * step).fract() - 1.0
        });
        let direction = direction.try_normalize(0.0)?;
        for part in RADII {
            let offset = root.solve_upper_triangular(&(&direction * part))?;
            found.push((part, -&offset));
            found.push((part, offset));
        }
    }
    Some(found)
}

/// The attracting periodic orbits, of periods up to `longest`, on which the orbits of some seeds settle after `transient` images. Each is
/// found once, in the order of the seeds. A seed whose orbit has no image, or settles on none of them, adds none: [`orbit_fate`] says
/// what becomes of it. `progress` receives the number of finished seeds; if it breaks, no further one begins. Seeds
/// after a stop of a watched map add none: `MapFamily::stopped` tells.
///
/// ```
/// use return_map::{periodic_attractors, scalar_family};
/// let logistic = scalar_family(|x, r| r * x * (1.0 - x));
/// let seeds = [vec![0.3], vec![0.7]];
/// let found = periodic_attractors(&logistic, 3.2, &seeds, (1000, 8), |_| std::ops::ControlFlow::Continue(()));
/// assert_eq!(found.len(), 1);
/// assert_eq!(found[0].orbit.len(), 2);
/// ```
///
/// [`orbit_fate`]: super::orbit_fate
pub fn periodic_attractors<M: MapFamily + ?Sized>(
    map: &M,
    parameter: f64,
    seeds: &[Vec<f64>],
    (transient, longest): (usize, usize),
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Vec<PeriodicAttractor> {
    let mut found: Vec<PeriodicAttractor> = Vec::new();
    for (finished, seed) in seeds.iter().enumerate() {
        if let Some(new) = settled(map, parameter, seed, (transient, longest), &found) {
            found.push(new);
        }
        if progress(finished + 1).is_break() {
            break;
        }
    }
    found
}

/// The attractor on which an orbit settles, if it is a new one.
fn settled<M: MapFamily + ?Sized>(
    map: &M,
    parameter: f64,
    seed: &[f64],
    (transient, longest): (usize, usize),
    known: &[PeriodicAttractor],
) -> Option<PeriodicAttractor> {
    let is_known = |point: &[f64]| known.iter().any(|known| known.contains(point));
    if is_known(seed) {
        return None;
    }
    let (mut at, mut known_met) = (seed.to_vec(), false);
    let settles = map.orbit(seed, parameter, transient, &mut |image| {
        at = image.point;
        known_met = is_known(&at);
        if known_met { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    if settles.is_err() || known_met {
        return None;
    }
    // The returns near the point, the nearest first.
    let (mut later, mut returns) = (at.clone(), Vec::new());
    for period in 1..=longest {
        later = map.image(&later, parameter).ok()?.point;
        returns.push((distance(&later, &at), period));
    }
    returns.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    for (_, period) in returns.into_iter().take(MOST_TRIES) {
        let Ok(new) = PeriodicAttractor::new(map, period, (&at, parameter)) else { continue };
        // A known one, whose trap the orbit has not reached.
        if new.orbit.iter().any(|own| is_known(own)) {
            return None;
        }
        // The orbit itself must reach it.
        let mut at = at.clone();
        for _ in 0..=transient + new.orbit.len() {
            if is_known(&at) {
                return None;
            }
            if new.contains(&at) {
                return Some(new);
            }
            at = map.image(&at, parameter).ok()?.point;
        }
    }
    None
}

/// Periods that are tried for one seed. An orbit that has settled returns nearest after its own period.
const MOST_TRIES: usize = 3;
