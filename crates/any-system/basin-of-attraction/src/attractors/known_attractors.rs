//! Attractors that the caller knows by points, and basins by the distance from them.

use crate::attractors::many_orbits::{FollowedOrbit, follow_some, in_parts};
use crate::attractors::recurrence_limits::MOST_TESTS;
use crate::attractors::state_map::{Moving, StateMap, check_map};
use crate::error::Error;
use crate::space::label::Label;
use crate::space::vectors::check_dimension;
use crate::space::vectors::distance;
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// How orbits are followed to attractors that are known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct KnownLimits {
    /// Most steps of an orbit.
    pub budget: usize,
    /// Steps within which an orbit on an attractor comes near to its points again: the period of a cycle at least. A test takes four such
    /// stretches.
    pub stretch: usize,
    /// Orbits that test the distance of each attractor. With n of them a part of the neighbourhood from which orbits leave is missed if
    /// it is smaller than 3/n, in 5 of 100 cases.
    pub tests: usize,
}

impl Default for KnownLimits {
    /// 10⁵ steps, stretches of 1000 steps, 200 tests.
    fn default() -> Self {
        KnownLimits { budget: 100_000, stretch: 1000, tests: 200 }
    }
}

/// Attractors that are known by some of their points: fixed points, cycles, clouds of points of a chaotic attractor. An orbit has come to
/// one as soon as it is within a distance of one of its points, and its label is that of the nearest point.
///
/// The distance is tested as traps are: orbits from random states within it come back, nearer than they began, and never come to another
/// attractor.
///
/// ```
/// use basin_of_attraction::{KnownAttractors, KnownLimits, Label};
/// // 3x/2 − x³/2 has the attractors ±1. The fixed point 0 is between their basins.
/// let cubic = |x: &[f64]| Some(vec![1.5 * x[0] - 0.5 * x[0] * x[0] * x[0]]);
/// let points = [(Label::from(1), vec![vec![1.0]]), (Label::from(2), vec![vec![-1.0]])].into();
/// let known = KnownAttractors::suggested(&cubic, &points, KnownLimits::default())?;
/// assert_eq!(known.label(&cubic, &[0.3]), Label::from(1));
/// assert!(known.label(&cubic, &[0.0]).is_undecided());
/// // How many steps it takes.
/// let (label, steps) = known.convergence(&cubic, &[-1e-3])?;
/// assert!(label == Label::from(2) && steps > 10);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct KnownAttractors {
    /// All points with their labels, by their first coordinates.
    points: Vec<(Vec<f64>, Label)>,
    distance: f64,
    limits: KnownLimits,
}

/// The most points of all attractors together: the distances between attractors are those of all pairs.
const MOST_POINTS: usize = 100_000;

/// A suggested distance is halved at most so often, from half of the smallest distance between two attractors.
const MOST_HALVINGS: usize = 40;

/// Stretches of a test: in each of the last three an orbit comes back.
const STRETCHES: usize = 4;

/// Seed of the tests. Another one tests other states.
const SEED: u64 = 1;

impl KnownAttractors {
    /// The attractors with these points, and this distance, in the Euclidean norm.
    ///
    /// # Errors
    /// [`Error::NoDimension`] without attractors, for an attractor without points and points without coordinates;
    /// [`Error::WrongDimension`] for points of different dimensions; [`Error::TooManySamples`] for more than 10⁵ points or 10⁶ tests;
    /// [`Error::BadSearch`] for a label that is no basin, a point or a distance that is not finite, a distance that reaches more than half of
    /// the way to another attractor, no steps or tests, and a distance from which a test does not come back.
    pub fn new(
        map: &dyn StateMap,
        points: &BTreeMap<Label, Vec<Vec<f64>>>,
        distance: f64,
        limits: KnownLimits,
    ) -> Result<KnownAttractors, Error> {
        let mut known = KnownAttractors::untested(map, points, limits)?;
        if !(distance > 0.0 && distance.is_finite()) {
            let name = "a distance from attractors";
            return Err(Error::BadSearch { name, value: distance, remedy: "" });
        }
        if distance > 0.5 * known.closest_attractors() {
            let name = "a distance from attractors";
            let remedy = ", and at most half of the distance between two of them";
            return Err(Error::BadSearch { name, value: distance, remedy });
        }
        known.distance = distance;
        match known.is_trap(map) {
            true => Ok(known),
            false => Err(no_trap(distance)),
        }
    }

    /// The same with a distance that is suggested from the points: half of the smallest distance between two attractors, or of
    /// a single one the largest coordinate of its points, and 1 at least; halved until the tests pass.
    ///
    /// # Errors
    /// As [`new`](Self::new). No distance may pass: the points may be none of attractors, or too few of them.
    pub fn suggested(
        map: &dyn StateMap,
        points: &BTreeMap<Label, Vec<Vec<f64>>>,
        limits: KnownLimits,
    ) -> Result<KnownAttractors, Error> {
        let mut known = KnownAttractors::untested(map, points, limits)?;
        let size = |point: &Vec<f64>| point.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
        let largest = known.points.iter().map(|(point, _)| size(point)).fold(1.0, f64::max);
        known.distance = (0.5 * known.closest_attractors()).min(largest);
        for _ in 0..MOST_HALVINGS {
            if !(known.distance > 0.0) {
                break;
            }
            if known.is_trap(map) {
                return Ok(known);
            }
            known.distance *= 0.5;
        }
        Err(no_trap(known.distance))
    }

    fn untested(
        map: &dyn StateMap,
        points: &BTreeMap<Label, Vec<Vec<f64>>>,
        limits: KnownLimits,
    ) -> Result<KnownAttractors, Error> {
        let counts = [
            ("a budget", limits.budget),
            ("a stretch", limits.stretch),
            ("a number of tests", limits.tests),
        ];
        for (name, value) in counts {
            if value == 0 {
                return Err(Error::BadSearch { name, value: 0.0, remedy: "" });
            }
        }
        let all = points.values().map(Vec::len).sum();
        for (samples, most, remedy) in [
            (all, MOST_POINTS, "take fewer points of each attractor, and a larger distance"),
            (limits.tests, MOST_TESTS, "hundreds find all but small openings"),
        ] {
            if samples > most {
                return Err(Error::TooManySamples { samples, most, remedy });
            }
        }
        let expected = points.values().flatten().next().map_or(0, Vec::len);
        if expected == 0 || points.values().any(Vec::is_empty) {
            return Err(Error::NoDimension);
        }
        check_map(map, expected)?;
        let mut own = Vec::with_capacity(all);
        for (&label, points) in points {
            if label.basin_number().is_none() {
                let (name, remedy) = ("the code of a label", "; it must be that of a basin");
                return Err(Error::BadSearch { name, value: f64::from(label.code()), remedy });
            }
            for point in points {
                check_dimension(point.len(), expected)?;
                if let Some(&value) = point.iter().find(|x| !x.is_finite()) {
                    let (name, remedy) = ("a coordinate of a point", "; finite is enough");
                    return Err(Error::BadSearch { name, value, remedy });
                }
                own.push((point.clone(), label));
            }
        }
        own.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
        Ok(KnownAttractors { points: own, distance: f64::NAN, limits })
    }

    /// The distance within which an orbit has come to an attractor.
    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// The label of the attractor to which the orbit of a point comes; undecided if it comes to none of them within the budget.
    pub fn label(&self, map: &dyn StateMap, start: &[f64]) -> Label {
        self.convergence(map, start).map_or(Label::UNDECIDED, |(label, _)| label)
    }

    /// The label, and the number of steps until the orbit is within the distance: the time to convergence. Of an undecided orbit it is the
    /// number of steps that were made.
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for a point of another dimension.
    pub fn convergence(&self, map: &dyn StateMap, start: &[f64]) -> Result<(Label, usize), Error> {
        let dimension = self.points[0].0.len();
        check_dimension(start.len(), dimension)?;
        check_map(map, dimension)?;
        let mut orbit = Approach::new(self, map);
        orbit.restart(|at| at.copy_from_slice(start));
        Ok(orbit.follow(map))
    }

    /// The labels and times of many starts, as [`convergence`](Self::convergence) gives them: in parallel, and some orbits at a time where
    /// the map moves them together. `start` writes the start with a number.
    ///
    /// # Errors
    /// [`Error::WrongDimension`] for a map of another dimension.
    pub fn convergences(
        &self,
        map: &dyn StateMap,
        count: usize,
        start: impl Fn(usize, &mut [f64]) + Sync,
    ) -> Result<Vec<(Label, usize)>, Error> {
        let dimension = self.points[0].0.len();
        check_map(map, dimension)?;
        let mut all = vec![(Label::UNDECIDED, 0); count];
        in_parts(&mut all, |first, ends| {
            let begin =
                |k: usize, orbit: &mut Approach<'_>| orbit.restart(|at| start(first + k, at));
            follow_some(map, dimension, || Approach::new(self, map), begin, ends);
        });
        Ok(all)
    }

    /// The nearest point within a distance: its label, and how far it is.
    fn nearest(&self, at: &[f64], within: f64) -> Option<(Label, f64)> {
        let first = at[0];
        let begin = self.points.partition_point(|(point, _)| point[0] < first - within);
        let near = self.points[begin..].iter().take_while(|(point, _)| point[0] <= first + within);
        let all = near.map(|(point, label)| (*label, distance(point, at)));
        all.filter(|(_, d)| *d <= within).min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The smallest distance between points of two attractors; infinite for a single one.
    fn closest_attractors(&self) -> f64 {
        let mut smallest = f64::INFINITY;
        for (k, (point, label)) in self.points.iter().enumerate() {
            for (other, of) in &self.points[k + 1..] {
                if other[0] - point[0] >= smallest {
                    break;
                }
                if of != label {
                    smallest = smallest.min(distance(point, other));
                }
            }
        }
        smallest
    }

    /// Whether orbits from random states within the distance of each attractor come back to it, in each of three stretches, at last within
    /// half of the distance, and to no other one.
    fn is_trap(&self, map: &dyn StateMap) -> bool {
        let mut own: BTreeMap<Label, Vec<&Vec<f64>>> = BTreeMap::new();
        for (point, label) in &self.points {
            own.entry(*label).or_default().push(point);
        }
        own.iter().enumerate().all(|(number, (label, points))| {
            let random = SplitMix64::from_seed(SEED + number as u64);
            (0..self.limits.tests).into_par_iter().all(|test| {
                let random = SplitMix64::from_seed(random.bits(test as u64));
                let point = points[(random.uniform(0) * points.len() as f64) as usize];
                self.stays(map, self.beside(point, &random), *label)
            })
        })
    }

    /// A random state within the distance of a point: of a cube, moved to the surface of the ball if it is outside.
    fn beside(&self, point: &[f64], random: &SplitMix64) -> Vec<f64> {
        let aside: Vec<f64> =
            (1..).take(point.len()).map(|k| 2.0 * random.uniform(k) - 1.0).collect();
        let length = aside.iter().map(|x| x * x).sum::<f64>().sqrt().max(1.0);
        point.iter().zip(aside).map(|(x, off)| x + self.distance * off / length).collect()
    }

    fn stays(&self, map: &dyn StateMap, start: Vec<f64>, label: Label) -> bool {
        let mut point = Moving::from(&start);
        for stretch in 0..STRETCHES {
            let mut smallest = f64::INFINITY;
            for _ in 0..self.limits.stretch {
                match self.nearest(&point.at, self.distance) {
                    Some((other, _)) if other != label => return false,
                    Some((_, d)) => smallest = smallest.min(d),
                    None => {}
                }
                if !point.step(map) {
                    return false;
                }
            }
            // The first one may lead away before the orbit comes back.
            let within = if stretch + 1 == STRETCHES { 0.5 } else { 1.0 } * self.distance;
            if stretch > 0 && smallest > within {
                return false;
            }
        }
        true
    }
}

/// An orbit on its way to one of the attractors.
struct Approach<'a> {
    known: &'a KnownAttractors,
    map: &'a dyn StateMap,
    point: Moving,
    steps: usize,
    is_stopped: bool,
}

impl<'a> Approach<'a> {
    fn new(known: &'a KnownAttractors, map: &'a dyn StateMap) -> Self {
        let point = Moving::from(&known.points[0].0);
        Approach { known, map, point, steps: 0, is_stopped: false }
    }

    fn restart(&mut self, start: impl Fn(&mut [f64])) {
        start(&mut self.point.at);
        (self.steps, self.is_stopped) = (0, false);
    }
}

impl FollowedOrbit for Approach<'_> {
    type End = (Label, usize);

    fn see(&mut self) -> Option<(Label, usize)> {
        let label = if self.is_stopped || self.point.at.iter().any(|x| !x.is_finite()) {
            self.map.label_of_end(&self.point.at)
        } else if self.steps >= self.known.limits.budget {
            Label::UNDECIDED
        } else {
            self.known.nearest(&self.point.at, self.known.distance)?.0
        };
        Some((label, self.steps))
    }

    fn point(&mut self) -> &mut Moving {
        &mut self.point
    }

    fn moved(&mut self, _: usize, has_image: bool) {
        self.is_stopped = !has_image;
        self.steps += usize::from(has_image);
    }
}

fn no_trap(distance: f64) -> Error {
    let name = "a distance from attractors";
    let remedy = ", and so small that orbits from there come back: from this one some do not, so that the points may be none of an \
                  attractor, or too few";
    Error::BadSearch { name, value: distance, remedy }
}
