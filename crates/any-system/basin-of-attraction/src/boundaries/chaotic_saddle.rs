//! Orbits on a chaotic saddle: the set of points whose orbits never leave a region, though almost all others do.

use crate::attractors::state_map::{Moving, StateMap, check_map};
use crate::boundaries::escape_times::Inside;
use crate::error::Error;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::statistics::split_mix::SplitMix64;

/// How an orbit on a chaotic saddle is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SaddleSearch {
    /// Each point of the orbit stays inside for more steps than this. It is then as near to the saddle as the unstable directions stretch in so many
    /// steps.
    pub stays: usize,
    /// The largest change of a coordinate of a point. Smaller changes are tried more often: their sizes are distributed evenly on a logarithmic scale.
    pub largest: f64,
    /// The smallest change that is tried.
    pub smallest: f64,
    /// Most changes of one point, and most random points for the first one.
    pub budget: usize,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl SaddleSearch {
    /// Points that stay for more than this number of steps; changes from 10⁻¹⁵ to 0.1, and up to 10⁵ of them.
    pub fn staying(stays: usize) -> SaddleSearch {
        SaddleSearch { stays, largest: 0.1, smallest: 1e-15, budget: 100_000, seed: 1 }
    }
}

/// An orbit beside a chaotic saddle, with small changes.
#[derive(Debug, Clone, PartialEq)]
pub struct SaddleOrbit {
    /// Its points.
    pub points: Vec<Vec<f64>>,
    /// How often a point was changed.
    pub changes: usize,
    /// The largest change of a coordinate.
    pub largest: f64,
    /// Why it has fewer points than were asked for: no change of the last point that was tried stays inside. `None` if it is complete.
    pub lost: Option<Vec<f64>>,
}

/// So many points of an orbit on the chaotic saddle of a region, by the method of D. Sweet, H. E. Nusse and J. A. Yorke (Phys. Rev. Lett. 86, 2261,
/// 2001), stagger and step: as long as a point stays inside for more than [`stays`](SaddleSearch::stays) steps its image is the next one; else it is
/// changed a little, at random, to one that does.
///
/// Each point is inside for more than `stays` steps, as far as `f64` follows: this is tested. That it is near the saddle follows if points away from
/// it leave sooner.
///
/// ```
/// use basin_of_attraction::{Interval, SaddleSearch, array_map, saddle_orbit};
/// // The tent map of slope 3 leaves Cantor's set.
/// let tent = array_map(|[x]: [f64; 1]| Some([3.0 * x.min(1.0 - x)]));
/// let unit = Interval::new(0.0, 1.0)?.try_into()?;
/// let found = saddle_orbit(&tent, &|x| (0.0..=1.0).contains(&x[0]), &unit, 1000, SaddleSearch::staying(20))?;
/// assert!(found.lost.is_none());
/// // No point is in the middle third, nor in those of the thirds.
/// let third = |x: f64| (3.0 * x) % 1.0;
/// assert!(found.points.iter().all(|x| [x[0], third(x[0])].iter().all(|x| !(0.3334..0.6666).contains(x))));
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::WrongDimension`] for a map of another dimension than the region; [`Error::BadSearch`] unless 0 < `smallest` ≤ `largest` < ∞, and if none
/// that stays is found in the region.
pub fn saddle_orbit(
    map: &dyn StateMap,
    inside: &Inside<'_>,
    region: &Hyperrectangle,
    points: usize,
    search: SaddleSearch,
) -> Result<SaddleOrbit, Error> {
    let dimension = region.dimension();
    check_map(map, dimension)?;
    let SaddleSearch { stays, largest, smallest, budget, seed } = search;
    if !(0.0 < smallest && smallest <= largest && (largest / smallest).is_finite()) {
        let remedy = ", not below the smallest one, which is positive";
        return Err(Error::BadSearch { name: "a largest change", value: largest, remedy });
    }
    let mut changes = Changes { random: SplitMix64::from_seed(seed), used: 0, largest, smallest };
    let mut staying = Staying { map, inside, stays, point: Moving::from(&vec![0.0; dimension]) };
    let first = first_point(region, &mut staying, &mut changes, budget)?;
    let mut found = SaddleOrbit { points: vec![first], changes: 0, largest: 0.0, lost: None };
    while found.points.len() < points {
        let Some(last) = found.points.last() else { break };
        let mut next = Moving::from(last);
        // The last point stays, so that it has an image.
        if !next.step(map) {
            found.lost = Some(last.clone());
            break;
        }
        if staying.contains(&next.at) {
            found.points.push(next.at);
            continue;
        }
        let changed = (0..budget).find_map(|_| {
            let other = changes.of(&next.at);
            staying.contains(&other).then_some(other)
        });
        let Some(other) = changed else {
            found.lost = Some(next.at);
            break;
        };
        found.changes += 1;
        let change = next.at.iter().zip(&other).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        found.largest = found.largest.max(change);
        found.points.push(other);
    }
    found.points.truncate(points);
    Ok(found)
}

/// Points that are inside for more than some steps.
struct Staying<'a> {
    map: &'a dyn StateMap,
    inside: &'a Inside<'a>,
    stays: usize,
    point: Moving,
}

impl Staying<'_> {
    fn contains(&mut self, start: &[f64]) -> bool {
        self.steps(start).is_some_and(|steps| steps > self.stays)
    }

    /// The steps after which a point is still inside, up to one more than it must stay; `None` outside.
    fn steps(&mut self, start: &[f64]) -> Option<usize> {
        self.point.at.copy_from_slice(start);
        let (map, inside, point) = (self.map, self.inside, &mut self.point);
        let stays = (0..=self.stays).take_while(|_| point.step(map) && inside(&point.at));
        inside(start).then(|| stays.count())
    }
}

/// Random changes of points.
struct Changes {
    random: SplitMix64,
    /// Random numbers that were used.
    used: u64,
    largest: f64,
    smallest: f64,
}

impl Changes {
    fn next(&mut self) -> f64 {
        self.used += 1;
        self.random.uniform(self.used - 1)
    }

    fn of(&mut self, point: &[f64]) -> Vec<f64> {
        let range = pxfm::f_log(self.largest / self.smallest);
        let size = self.largest * pxfm::f_exp(-range * self.next());
        point.iter().map(|x| x + size * (2.0 * self.next() - 1.0)).collect()
    }
}

/// A point of a region that stays: the best of some random ones, changed as long as it stays for fewer steps.
fn first_point(
    region: &Hyperrectangle,
    staying: &mut Staying<'_>,
    changes: &mut Changes,
    budget: usize,
) -> Result<Vec<f64>, Error> {
    /// The part of the budget for random points.
    const RANDOM: usize = 10;
    let random = (0..budget.div_ceil(RANDOM) as u64).map(|k| {
        let point = region.random_point(&changes.random, k);
        (staying.steps(&point), point)
    });
    let mut best = random.max_by_key(|(steps, _)| *steps);
    // Other random numbers than those of the points.
    changes.random = SplitMix64::from_seed(changes.random.bits(u64::MAX));
    for _ in 0..budget {
        match &best {
            Some((Some(steps), point)) if *steps > staying.stays => return Ok(point.clone()),
            Some((Some(steps), point)) => {
                let other = changes.of(point);
                let longer = staying.steps(&other).filter(|own| own > steps);
                best = longer.map_or(best, |own| Some((Some(own), other)));
            }
            _ => break,
        }
    }
    let remedy = ", or points that stay for fewer steps: none that does was found in the region";
    Err(Error::BadSearch { name: "a budget", value: budget as f64, remedy })
}
