//! Attractors of maps and flows of several variables, found by features of their orbits.
//!
//! The idea is that of `AttractorsViaFeaturizing` of Attractors.jl (G. Datseris, A. Wagemakers, Chaos 32, 023104,
//! 2022; M. Stender, N. Hoffmann, Nonlinear Dyn. 107, 671, 2022): a caller who knows what distinguishes the
//! attractors makes numbers of a stretch of an orbit, and orbits with similar numbers have one attractor. Here no
//! orbit is given to the nearest group: it belongs to a group if several successive stretches do, and a group is an
//! attractor only if orbits beside it come to it.

use crate::attractors::recurrence_limits::MOST_TESTS;
use crate::attractors::state_map::{Moving, OrbitFeature, StateMap};
use crate::attractors::unmatched::{Unmatched, UnmatchedReason};
use crate::error::Error;
use crate::features::feature_groups::{FeatureGroups, check_feature_count};
use crate::features::metric::Metric;
use crate::space::label::Label;
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// How orbits are made into features, and features into groups.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FeatureLimits {
    /// Steps before the first stretch.
    pub transient: usize,
    /// Steps of a stretch, of which one feature vector is made.
    pub stretch: usize,
    /// Successive stretches whose features must belong to one group.
    pub agree: usize,
    /// Most stretches of an orbit.
    pub budget: usize,
    /// Largest Euclidean distance of neighbouring features of a group.
    pub radius: f64,
    /// Fewest orbits with features within the radius of one that founds a group.
    pub fewest: usize,
    /// Orbits that test a group.
    pub tests: usize,
    /// Largest change of every coordinate of a state of a group, from where these orbits start.
    pub beside: f64,
}

impl FeatureLimits {
    /// With a transient of 1000 steps, 3 successive stretches of 1000 steps out of 30 at most, groups of 4 orbits
    /// and 100 tests.
    ///
    /// Longer stretches narrow the features of chaotic attractors, so that a smaller radius separates them from
    /// others. `beside` is the scale on which attractors are traps: an attractor whose basin ends within this
    /// distance is refused.
    pub fn new(radius: f64, beside: f64) -> Self {
        FeatureLimits {
            transient: 1000,
            stretch: 1000,
            agree: 3,
            budget: 30,
            radius,
            fewest: 4,
            tests: 100,
            beside,
        }
    }

    fn check(&self) -> Result<(), Error> {
        /// Points of a stretch are kept while it is followed; more would take gigabytes for each thread.
        const LONGEST: usize = 10_000_000;
        /// An orbit that comes to no group is followed through the whole budget: some minutes with so many steps.
        const MOST_STEPS: usize = 1_000_000_000;
        let counts = [("a stretch", self.stretch), ("a number of stretches", self.agree)];
        for (name, value) in counts {
            if value == 0 {
                return Err(Error::BadSearch { name, value: 0.0, remedy: "" });
            }
        }
        if self.budget < self.agree {
            let (name, remedy) =
                ("a budget of stretches", ", and not below the number that must agree");
            return Err(Error::BadSearch { name, value: self.budget as f64, remedy });
        }
        let steps = self.stretch.saturating_mul(self.budget).saturating_add(self.transient);
        for (samples, most, remedy) in [
            (self.stretch, LONGEST, "take shorter stretches, of every tenth step or less"),
            (
                steps,
                MOST_STEPS,
                "these are the steps of one orbit: take a smaller budget, or a shorter transient",
            ),
            (
                self.tests,
                MOST_TESTS,
                "these are the tests of one group: hundreds find all but small openings",
            ),
        ] {
            if samples > most {
                return Err(Error::TooManySamples { samples, most, remedy });
            }
        }
        if !(self.beside > 0.0 && self.beside.is_finite()) {
            let name = "a distance of tests";
            return Err(Error::BadSearch { name, value: self.beside, remedy: "" });
        }
        Ok(())
    }
}

/// An attractor known by its features.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureAttractor {
    /// Its label: basin 1 for the one of the first start that has any, and so on.
    pub label: Label,
    /// The points of one stretch of the first orbit that came to it.
    pub points: Vec<Vec<f64>>,
}

/// The attractors of a map by the features of their orbits, and the orbits that belong to none.
#[derive(Debug, Clone, PartialEq)]
pub struct FeatureAttractors {
    limits: FeatureLimits,
    groups: FeatureGroups,
    attractors: Vec<FeatureAttractor>,
    unmatched: Vec<Unmatched>,
}

/// The first stretches of an orbit: their features, and the points of the last one.
struct Beginning {
    features: Vec<Vec<f64>>,
    points: Vec<Vec<f64>>,
}

impl FeatureAttractors {
    /// Searches attractors by the orbits of `starts`.
    ///
    /// `map` is a step: a map, a return map, or a flow over some time; `None` if it has no value. `feature` makes
    /// numbers of the points of a stretch, such as their mean: all attractors must differ in them by more than the
    /// radius, and on one of them they must vary in steps smaller than it.
    ///
    /// 1. Every start is followed through the transient and [`agree`](FeatureLimits::agree) stretches. All features
    ///    are grouped: see [`FeatureGroups`].
    /// 2. A group is tested by orbits that start beside its states, at random. All must come to the group. So a
    ///    slow passage that is left within the budget is no attractor, nor is the state between two basins. A part
    ///    of the neighbourhood from which orbits leave is missed with n tests if it is smaller than 3/n, in 5 of
    ///    100 cases.
    /// 3. A start belongs to the group in which its features are in `agree` successive stretches. A start that
    ///    finds none within the budget is listed.
    ///
    /// A transient with the features of an attractor, for three stretches, is taken for it.
    ///
    /// ```
    /// use basin_of_attraction::{FeatureAttractors, FeatureLimits, Label};
    /// // 3x/2 − x³/2 has the attractors ±1. The start 0 is the fixed point between their basins.
    /// let cubic = |x: &[f64]| Some(vec![1.5 * x[0] - 0.5 * x[0] * x[0] * x[0]]);
    /// let mean = |points: &[Vec<f64>]| vec![points.iter().map(|x| x[0]).sum::<f64>() / points.len() as f64];
    /// let starts: Vec<Vec<f64>> = (-10..=10).map(|k| vec![0.15 * f64::from(k)]).collect();
    /// let limits = FeatureLimits { transient: 100, stretch: 10, ..FeatureLimits::new(0.1, 0.01) };
    /// let found = FeatureAttractors::search(&cubic, &mean, &starts, limits)?;
    /// assert_eq!((found.attractors().len(), found.unmatched().len()), (2, 1));
    /// assert_eq!(found.unmatched()[0].start, [0.0]);
    /// assert_eq!(found.label(&cubic, &mean, &[0.3]), Label::from(2));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadSearch`] for a radius or a distance that is not positive and finite, stretches without steps, and
    /// a budget that is too small; [`Error::WrongDimension`] and [`Error::NoDimension`] for features of different
    /// lengths or none; [`Error::TooManySamples`] for more than 20 000 features, as many as starts times `agree`,
    /// stretches of more than 10⁷ steps, a transient and a budget of more than 10⁹ steps together, and more than 10⁶
    /// tests; [`Error::TooManyAttractors`] beyond 65 000.
    pub fn search(
        map: &dyn StateMap,
        feature: &OrbitFeature<'_>,
        starts: &[Vec<f64>],
        limits: FeatureLimits,
    ) -> Result<FeatureAttractors, Error> {
        FeatureAttractors::search_by(Metric::euclidean(), map, feature, starts, limits)
    }

    /// The same with any distance of features.
    ///
    /// # Errors
    /// As [`search`](Self::search).
    pub fn search_by(
        metric: Metric,
        map: &dyn StateMap,
        feature: &OrbitFeature<'_>,
        starts: &[Vec<f64>],
        limits: FeatureLimits,
    ) -> Result<FeatureAttractors, Error> {
        limits.check()?;
        // Before the orbits are followed: each has as many features as stretches that must agree.
        check_feature_count(starts.len().saturating_mul(limits.agree))?;
        let begin = |start: &Vec<f64>| beginning(map, feature, start, limits);
        let orbits: Vec<Option<Beginning>> = starts.par_iter().map(begin).collect();
        let vectors: Vec<(usize, Vec<f64>)> = orbits
            .iter()
            .enumerate()
            .filter_map(|(k, orbit)| Some((k, &orbit.as_ref()?.features)))
            .flat_map(|(k, features)| features.iter().map(move |feature| (k, feature.clone())))
            .collect();
        let groups = FeatureGroups::by_density(metric, &vectors, limits.radius, limits.fewest)?;
        let all =
            FeatureAttractors { limits, groups, attractors: Vec::new(), unmatched: Vec::new() };
        let mut kept: BTreeSet<Label> = BTreeSet::new();
        for label in all.groups.labels() {
            let own: Vec<&Beginning> = orbits
                .iter()
                .flatten()
                .filter(|orbit| all.common(&orbit.features) == label)
                .collect();
            if all.is_trap(map, feature, &own, label) {
                kept.insert(label);
            }
        }
        let before = all.groups.clone();
        let mut found = FeatureAttractors { groups: all.groups.only(&kept), ..all };
        let match_one = |(start, orbit): (&Vec<f64>, &Option<Beginning>)| {
            let Some(orbit) = orbit else { return Err(UnmatchedReason::Stopped) };
            let label = found.common(&orbit.features);
            if label.is_decided() {
                return Ok(label);
            }
            found.follow(map, feature, &mut Moving::from(start)).map_err(|reason| {
                let refused =
                    orbit.features.last().is_some_and(|own| before.label(own).is_decided());
                match reason {
                    UnmatchedReason::NoGroup if refused => UnmatchedReason::NoTrap,
                    reason => reason,
                }
            })
        };
        let matched: Vec<Result<Label, UnmatchedReason>> =
            starts.par_iter().zip(&orbits).map(match_one).collect();
        for label in found.groups.labels() {
            let own = orbits.iter().flatten().find(|orbit| found.common(&orbit.features) == label);
            let points = own.map_or(Vec::new(), |orbit| orbit.points.clone());
            found.attractors.push(FeatureAttractor { label, points });
        }
        for (start, matched) in starts.iter().zip(matched) {
            if let Err(reason) = matched {
                found.unmatched.push(Unmatched { start: start.clone(), reason });
            }
        }
        Ok(found)
    }

    /// The attractors with these features, without a search or a test of them: the caller knows them.
    ///
    /// The `budget`, `stretch`, `transient` and `agree` of the limits are used. The radius is that of the groups.
    ///
    /// # Errors
    /// As [`search`](Self::search) for the limits.
    pub fn from_groups(groups: FeatureGroups, limits: FeatureLimits) -> Result<Self, Error> {
        limits.check()?;
        let known = |label| FeatureAttractor { label, points: Vec::new() };
        let attractors = groups.labels().into_iter().map(known).collect();
        Ok(FeatureAttractors { limits, groups, attractors, unmatched: Vec::new() })
    }

    /// The attractors, by their labels.
    pub fn attractors(&self) -> &[FeatureAttractor] {
        &self.attractors
    }

    /// The points of each attractor, by its label, as [`match_attractors`](crate::match_attractors) takes them.
    pub fn positions(&self) -> BTreeMap<Label, Vec<Vec<f64>>> {
        self.attractors.iter().map(|own| (own.label, own.points.clone())).collect()
    }

    /// The features of the attractors.
    pub fn groups(&self) -> &FeatureGroups {
        &self.groups
    }

    /// The starts whose orbits belong to no attractor.
    pub fn unmatched(&self) -> &[Unmatched] {
        &self.unmatched
    }

    /// The label of the attractor to which the orbit of a point comes; undecided if it comes to none of them within
    /// the budget.
    ///
    /// No attractor is added, so that points can be labelled in parallel.
    pub fn label(&self, map: &dyn StateMap, feature: &OrbitFeature<'_>, start: &[f64]) -> Label {
        let mut at = Moving::from(start);
        self.follow(map, feature, &mut at).unwrap_or_else(|reason| match reason {
            UnmatchedReason::Stopped => map.label_of_end(&at.at),
            _ => Label::UNDECIDED,
        })
    }

    /// The label that all these features have; undecided if there is none.
    fn common(&self, features: &[Vec<f64>]) -> Label {
        let mut labels = features.iter().map(|feature| self.groups.label(feature));
        match labels.next() {
            Some(first) if labels.all(|label| label == first) => first,
            _ => Label::UNDECIDED,
        }
    }

    /// Follows an orbit until `agree` successive stretches have one label.
    fn follow(
        &self,
        map: &dyn StateMap,
        feature: &OrbitFeature<'_>,
        at: &mut Moving,
    ) -> Result<Label, UnmatchedReason> {
        let limits = &self.limits;
        after(map, at, limits.transient).ok_or(UnmatchedReason::Stopped)?;
        let (mut last, mut same) = (Label::UNDECIDED, 0);
        for _ in 0..limits.budget {
            let points = stretch(map, at, limits.stretch).ok_or(UnmatchedReason::Stopped)?;
            let label = self.groups.label(&feature(&points));
            same = if label == last { same + 1 } else { 1 };
            last = label;
            if same >= limits.agree && label.is_decided() {
                return Ok(label);
            }
        }
        // The last stretches are of no group, or of different ones.
        let changes = last.is_decided() && same < limits.agree;
        Err(if changes { UnmatchedReason::Budget } else { UnmatchedReason::NoGroup })
    }

    /// Whether orbits from random states beside those of a group come to the group.
    fn is_trap(
        &self,
        map: &dyn StateMap,
        feature: &OrbitFeature<'_>,
        orbits: &[&Beginning],
        label: Label,
    ) -> bool {
        /// Seed of the states. Another one tests other states.
        const SEED: u64 = 1;
        let random = SplitMix64::from_seed(SEED);
        let comes = |test: usize| {
            // Each test takes numbers of a generator of its own: the number of coordinates is the caller's.
            let random = SplitMix64::from_seed(random.bits(test as u64));
            let pick = |k: u64, among: usize| (random.uniform(k) * among as f64) as usize;
            let Some(orbit) = orbits.get(pick(0, orbits.len())) else { return false };
            let Some(state) = orbit.points.get(pick(1, orbit.points.len())) else { return false };
            let aside =
                |(k, x): (u64, &f64)| x + self.limits.beside * (2.0 * random.uniform(k) - 1.0);
            let start: Vec<f64> = (2..).zip(state).map(aside).collect();
            self.follow(map, feature, &mut Moving::from(&start)) == Ok(label)
        };
        (0..self.limits.tests.max(1)).into_par_iter().all(comes)
    }
}

/// The first stretches of an orbit; `None` if it stops, or has features that are not finite.
fn beginning(
    map: &dyn StateMap,
    feature: &OrbitFeature<'_>,
    start: &[f64],
    limits: FeatureLimits,
) -> Option<Beginning> {
    let mut at = Moving::from(start);
    after(map, &mut at, limits.transient)?;
    let (mut features, mut points) = (Vec::new(), Vec::new());
    for _ in 0..limits.agree {
        points = stretch(map, &mut at, limits.stretch)?;
        let own = feature(&points);
        if own.iter().any(|x| !x.is_finite()) {
            return None;
        }
        features.push(own);
    }
    Some(Beginning { features, points })
}

/// Moves by some steps; `None` if the orbit stops or is not finite.
fn after(map: &dyn StateMap, point: &mut Moving, steps: usize) -> Option<()> {
    let is_finite = |at: &[f64]| at.iter().all(|x| x.is_finite());
    for _ in 0..steps {
        if !is_finite(&point.at) || !point.step(map) {
            return None;
        }
    }
    is_finite(&point.at).then_some(())
}

/// The next states of an orbit, which moves to the last of them.
fn stretch(map: &dyn StateMap, point: &mut Moving, steps: usize) -> Option<Vec<Vec<f64>>> {
    let next = |_| {
        let found = point.step(map) && point.at.iter().all(|x| x.is_finite());
        found.then(|| point.at.clone())
    };
    (0..steps).map(next).collect()
}
