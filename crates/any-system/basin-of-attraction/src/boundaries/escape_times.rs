//! How fast orbits leave a region: the numbers that are left, and the rate of escape with intervals.

use crate::attractors::many_orbits::{FollowedOrbit, follow_some, in_parts};
use crate::attractors::state_map::{Moving, StateMap, check_map};
use crate::error::Error;
use crate::shares::sampling::check_count;
use crate::space::hyperrectangle::Hyperrectangle;
use crate::statistics::confidence_interval::{ConfidenceInterval, proportion_interval};
use crate::statistics::split_mix::SplitMix64;

/// Whether a state is in the region from which orbits escape.
pub type Inside<'a> = dyn Fn(&[f64]) -> bool + Sync + 'a;

/// The times after which random orbits leave a region for the first time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct EscapeTimes {
    /// Entry n: the number of orbits that are inside for n steps at least.
    survivors: Vec<usize>,
}

/// An orbit until it leaves.
struct Transient<'a> {
    point: Moving,
    inside: &'a Inside<'a>,
    steps: usize,
    most: usize,
    is_stopped: bool,
}

impl FollowedOrbit for Transient<'_> {
    /// The steps after which it is still inside; `None` if it begins outside.
    type End = Option<usize>;

    fn see(&mut self) -> Option<Option<usize>> {
        if self.is_stopped || !(self.inside)(&self.point.at) {
            return Some(self.steps.checked_sub(1));
        }
        (self.steps == self.most).then_some(Some(self.steps))
    }

    fn point(&mut self) -> &mut Moving {
        &mut self.point
    }

    fn moved(&mut self, _: usize, has_image: bool) {
        self.is_stopped = !has_image;
        self.steps += 1;
    }
}

impl EscapeTimes {
    /// The times of so many random points of a region, up to `most` steps. Points that are not `inside` do not count. A state without an image has
    /// left.
    ///
    /// ```
    /// use basin_of_attraction::{EscapeTimes, Interval, array_map};
    /// // The tent map of slope 3: a third of [0, 1] leaves in each step.
    /// let tent = array_map(|[x]: [f64; 1]| Some([3.0 * x.min(1.0 - x)]));
    /// let unit = Interval::new(0.0, 1.0)?.try_into()?;
    /// let times = EscapeTimes::of_random_points(&tent, &|x| (0.0..=1.0).contains(&x[0]), &unit, 100_000, 20, 1)?;
    /// assert!(times.rate(1, 12)?.covers(1.5f64.ln()));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for a map of another dimension; [`Error::TooManySamples`]; [`Error::NothingInside`] if no point is inside.
    pub fn of_random_points(
        map: &dyn StateMap,
        inside: &Inside<'_>,
        region: &Hyperrectangle,
        count: usize,
        most: usize,
        seed: u64,
    ) -> Result<EscapeTimes, Error> {
        check_count(count)?;
        check_count(most)?;
        let dimension = region.dimension();
        check_map(map, dimension)?;
        let random = SplitMix64::from_seed(seed);
        let mut times = vec![None; count];
        in_parts(&mut times, |first, ends| {
            let orbit = || Transient {
                point: Moving::from(&vec![0.0; dimension]),
                inside,
                steps: 0,
                most,
                is_stopped: false,
            };
            let begin = |k: usize, orbit: &mut Transient<'_>| {
                orbit.point.at = region.random_point(&random, (first + k) as u64);
                (orbit.steps, orbit.is_stopped) = (0, false);
            };
            follow_some(map, dimension, orbit, begin, ends);
        });
        let mut survivors = vec![0usize; most + 1];
        times.into_iter().flatten().for_each(|steps| survivors[steps] += 1);
        // Those that are inside for n + 1 steps are so for n.
        for n in (0..most).rev() {
            survivors[n] += survivors[n + 1];
        }
        if survivors[0] == 0 {
            return Err(Error::NothingInside { points: count });
        }
        Ok(EscapeTimes { survivors })
    }

    /// Entry n: the number of orbits that are inside for n steps at least.
    pub fn survivors(&self) -> &[usize] {
        &self.survivors
    }

    /// The rate of escape between two numbers of steps: ln(N(from)/N(to))/(to − from), with the 95 % interval of the binomial number that is left.
    ///
    /// The rate of the map is that of late times: before, the points are not distributed as those that stay. Rates of later ranges that agree show
    /// that it has settled. An upper end is infinite if none may be left.
    ///
    /// # Errors
    /// [`Error::BadSearch`] for a range that is empty or reaches beyond the steps, and where none is left at its beginning.
    pub fn rate(&self, from: usize, to: usize) -> Result<ConfidenceInterval, Error> {
        let refused = |value: usize, remedy| {
            let name = "a range of steps";
            Err(Error::BadSearch { name, value: value as f64, remedy })
        };
        if from >= to || to >= self.survivors.len() {
            return refused(
                to,
                ", with an end behind its beginning and up to the steps that were made",
            );
        }
        let (before, after) = (self.survivors[from], self.survivors[to]);
        if before == 0 {
            return refused(from, ", with orbits that are left at its beginning");
        }
        let left = proportion_interval(after, before)?;
        let rate = |part: f64| -pxfm::f_log(part) / (to - from) as f64;
        Ok(ConfidenceInterval {
            value: rate(left.value),
            lower: rate(left.upper),
            upper: rate(left.lower),
        })
    }
}
