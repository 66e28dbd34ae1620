//! The minimal fatal shock of a state: the smallest displacement that takes it to another basin (L. Halekotte, U.
//! Feudel, Sci. Rep. 10, 11783, 2020).
//!
//! # The search
//! Rays leave the state in many directions. On each the first state of another basin, among equally spaced ones, is
//! bisected against the state before it. The shortest shocks are then improved: the direction is changed at random,
//! and a shock in the new direction that is just shorter than the old one is tried. If it is fatal, it is shortened
//! by bisection, and the changes become larger; else they become smaller. Half of all changes succeed far from a
//! minimum, and fewer close to it, so that the changes shrink with the distance from it.
//!
//! # What the result is
//! Every shock found is fatal: its end is a witness, and its size an upper bound. No number of labels gives a lower
//! bound: between the rays, and in basins thinner than the spacing, a smaller one may be missed. On the line
//! [`IntervalBasins::distance_to_boundary`](crate::IntervalBasins::distance_to_boundary) has both bounds.

use crate::error::Error;
use crate::shares::sampling::check_count;
use crate::space::label::Label;
use crate::space::vectors::check_point;
use crate::statistics::split_mix::SplitMix64;
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// How a minimal fatal shock is searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShockSearch {
    /// The largest shock of interest.
    pub farthest: f64,
    /// Directions: equally spaced in the plane, random in more dimensions, both on the line.
    pub directions: usize,
    /// States along each ray, equally spaced up to `farthest`.
    pub along: usize,
    /// How many of the shortest shocks are improved.
    pub improved: usize,
    /// Most changes of the direction of each.
    pub changes: usize,
    /// Shocks are shortened until they are known to this part of their size.
    pub precision: f64,
    /// Seed of the random directions.
    pub seed: u64,
}

impl ShockSearch {
    /// 360 directions with 200 states each, up to shocks of size `farthest`; the 20 shortest shocks are improved by
    /// up to 2000 changes each, to 10⁻¹⁰ of their size.
    ///
    /// More directions and states find thinner parts of other basins. More changes come closer to the minimum of each.
    pub fn up_to(farthest: f64) -> ShockSearch {
        let (directions, along, improved, changes) = (360, 200, 20, 2000);
        ShockSearch { farthest, directions, along, improved, changes, precision: 1e-10, seed: 1 }
    }

    /// The number of labels of a search, for a state with so many coordinates: an estimate from above but for the bisections, which take some forty for
    /// each change that helps. With default limits in the plane it is 112 000: where a label takes a millisecond, two minutes.
    pub fn labels(&self, dimension: usize) -> usize {
        let directions = if dimension == 1 { 2 } else { self.directions };
        let changes = if dimension == 1 { 0 } else { self.changes };
        let rays = directions.saturating_mul(self.along);
        rays.saturating_add(self.improved.clamp(1, directions.max(1)).saturating_mul(changes))
    }
}

/// A shock that takes a state to another basin.
#[derive(Debug, Clone, PartialEq)]
pub struct FatalShock {
    /// The displacement. The state plus this is in another basin, up to the rounding of the sum.
    pub shock: Vec<f64>,
    /// Its length: an upper bound on the minimal fatal shock.
    pub size: f64,
    /// The basin to which it leads.
    pub label: Label,
    /// How many states on the rays had no known basin. A smaller shock may lead there.
    pub undecided: usize,
    /// Whether the search was stopped before its end. The shock is fatal all the same.
    pub is_stopped: bool,
}

/// A unit vector, and the length of a fatal shock along it.
struct Ray {
    direction: Vec<f64>,
    size: f64,
    label: Label,
}

/// The smallest fatal shock that the search finds; `None` if it finds none.
///
/// Undecided states, and states outside the region of interest, are not fatal. With default limits it takes 112 000 labels in the plane
/// ([`ShockSearch::labels`]); [`minimal_fatal_shock_watched`] shows progress.
///
/// ```
/// use basin_of_attraction::{Label, ShockSearch, minimal_fatal_shock};
/// // An elliptic basin: its boundary is nearest in the direction of the short axis.
/// let ellipse = |x: &[f64]| Label::from(x[0] * x[0] + 4.0 * x[1] * x[1] < 1.0);
/// let found = minimal_fatal_shock(&[0.3, 0.0], ShockSearch::up_to(2.0), ellipse)?.expect("a shock");
/// // The nearest point of the ellipse to (0.3, 0) is (0.4, √0.21).
/// assert!((found.size - (0.01f64 + 0.21).sqrt()).abs() < 1e-9);
/// assert!(ellipse(&[0.3 + found.shock[0], found.shock[1]]) == found.label);
/// # Ok::<(), basin_of_attraction::Error>(())
/// ```
///
/// # Errors
/// [`Error::NoBasin`] for a state that is undecided or outside; [`Error::NoDimension`] and [`Error::BadPoint`] for a
/// state without, or with bad coordinates; [`Error::BadSearch`] unless `farthest`, `directions`, `along` and
/// `precision` are positive and finite; [`Error::TooManySamples`] for more than a billion states on the rays, or
/// changes of all shocks.
pub fn minimal_fatal_shock(
    state: &[f64],
    search: ShockSearch,
    label: impl Fn(&[f64]) -> Label + Sync,
) -> Result<Option<FatalShock>, Error> {
    minimal_fatal_shock_watched(state, search, label, |_| ControlFlow::Continue(()))
}

/// The same with progress: it receives the number of labels so far, after each one, to be compared with [`ShockSearch::labels`]. If it breaks, the
/// search ends, and the smallest shock so far is the result.
///
/// # Errors
/// As [`minimal_fatal_shock`].
pub fn minimal_fatal_shock_watched(
    state: &[f64],
    search: ShockSearch,
    label: impl Fn(&[f64]) -> Label + Sync,
    progress: impl Fn(usize) -> ControlFlow<()> + Sync,
) -> Result<Option<FatalShock>, Error> {
    let (count, is_stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let label = |state: &[f64]| {
        if is_stopped.load(Ordering::Relaxed) {
            return Label::UNDECIDED;
        }
        let found = label(state);
        if progress(count.fetch_add(1, Ordering::Relaxed) + 1).is_break() {
            is_stopped.store(true, Ordering::Relaxed);
        }
        found
    };
    let ShockSearch { farthest, directions, along, precision, .. } = search;
    if state.is_empty() {
        return Err(Error::NoDimension);
    }
    check_point(state)?;
    let numbers = [
        ("a farthest shock", farthest),
        ("a number of directions", directions as f64),
        ("a number of states along a ray", along as f64),
        ("a precision", precision),
    ];
    if let Some(&(name, value)) = numbers.iter().find(|(_, x)| !(*x > 0.0 && x.is_finite())) {
        return Err(Error::BadSearch { name, value, remedy: "" });
    }
    check_count(directions.saturating_mul(along))?;
    check_count(search.changes.saturating_mul(search.improved.clamp(1, directions)))?;
    let own = label(state);
    if !own.is_decided() {
        return Err(Error::NoBasin { label: own });
    }
    let probe = Probe { state, label: &label, own, precision };
    let random = SplitMix64::from_seed(search.seed);
    // Any more directions on the line would repeat these two.
    let count = if state.len() == 1 { 2 } else { directions };
    let found: Vec<(Option<Ray>, usize)> = (0..count)
        .into_par_iter()
        .map(|k| probe.along_ray(direction(state.len(), k, count, &random), farthest, along))
        .collect();
    let undecided = found.iter().map(|(_, undecided)| undecided).sum();
    let mut rays: Vec<Ray> = found.into_iter().filter_map(|(ray, _)| ray).collect();
    rays.sort_by(|a, b| a.size.total_cmp(&b.size));
    let kept = rays.len().min(search.improved.max(1));
    rays.truncate(kept);
    // The angle between neighbouring directions, roughly.
    let angle =
        std::f64::consts::TAU * pxfm::f_pow(count as f64, -1.0 / (state.len().max(2) - 1) as f64);
    let improved = rays.into_par_iter().enumerate().map(|(at, ray)| {
        // Random numbers from here on: those of the directions were counted from 0.
        let random = SplitMix64::from_seed(search.seed.wrapping_add(at as u64 + 1));
        probe.improved(ray, angle, if state.len() == 1 { 0 } else { search.changes }, &random)
    });
    let best = improved.collect::<Vec<Ray>>().into_iter().min_by(|a, b| a.size.total_cmp(&b.size));
    Ok(best.map(|Ray { direction, size, label }| FatalShock {
        shock: direction.iter().map(|x| size * x).collect(),
        size,
        label,
        undecided,
        is_stopped: is_stopped.load(Ordering::Relaxed),
    }))
}

/// Unit vector k of `count`.
fn direction(dimension: usize, k: usize, count: usize, random: &SplitMix64) -> Vec<f64> {
    match dimension {
        1 => vec![if k == 0 { 1.0 } else { -1.0 }],
        2 => {
            let angle = std::f64::consts::TAU * (k as f64 / count as f64);
            vec![pxfm::f_cos(angle), pxfm::f_sin(angle)]
        }
        _ => unit(normal(dimension, k as u64, random)).unwrap_or_else(|| axis(dimension)),
    }
}

/// The first unit vector, for random numbers that give the vector 0.
fn axis(dimension: usize) -> Vec<f64> {
    (0..dimension).map(|k| if k == 0 { 1.0 } else { 0.0 }).collect()
}

/// Vector `number` of normally distributed coordinates (Box and Muller).
fn normal(dimension: usize, number: u64, random: &SplitMix64) -> Vec<f64> {
    let coordinate = |k: u64| {
        let first = 2 * (number.wrapping_mul(dimension as u64).wrapping_add(k));
        // From (0, 1]: its logarithm is finite.
        let radius = (-2.0 * pxfm::f_log(1.0 - random.uniform(first))).sqrt();
        radius * pxfm::f_cos(std::f64::consts::TAU * random.uniform(first.wrapping_add(1)))
    };
    (0..dimension as u64).map(coordinate).collect()
}

fn unit(vector: Vec<f64>) -> Option<Vec<f64>> {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 0.0).then(|| vector.iter().map(|x| x / length).collect())
}

/// The labels around a state.
struct Probe<'a, L> {
    state: &'a [f64],
    label: &'a L,
    own: Label,
    precision: f64,
}

impl<L: Fn(&[f64]) -> Label> Probe<'_, L> {
    /// The label after a shock of this size.
    fn at(&self, direction: &[f64], size: f64) -> Label {
        let shocked: Vec<f64> =
            self.state.iter().zip(direction).map(|(x, part)| x + size * part).collect();
        (self.label)(&shocked)
    }

    fn is_fatal(&self, label: Label) -> bool {
        label.is_decided() && label != self.own
    }

    /// The first fatal shock along a ray, and the number of undecided states on it.
    fn along_ray(&self, direction: Vec<f64>, farthest: f64, along: usize) -> (Option<Ray>, usize) {
        let mut undecided = 0;
        for k in 1..=along {
            let at = |k: usize| farthest * (k as f64 / along as f64);
            let label = self.at(&direction, at(k));
            undecided += usize::from(label.is_undecided());
            if self.is_fatal(label) {
                let (size, label) = self.shortened(&direction, at(k - 1), at(k), label);
                return (Some(Ray { direction, size, label }), undecided);
            }
        }
        (None, undecided)
    }

    /// A shorter fatal shock between one that is not known to be fatal and one that is.
    fn shortened(
        &self,
        direction: &[f64],
        mut safe: f64,
        mut fatal: f64,
        mut label: Label,
    ) -> (f64, Label) {
        while fatal - safe > self.precision * fatal {
            let middle = 0.5 * safe + 0.5 * fatal;
            if middle <= safe || middle >= fatal {
                break;
            }
            let found = self.at(direction, middle);
            if self.is_fatal(found) { (fatal, label) = (middle, found) } else { safe = middle }
        }
        (fatal, label)
    }

    /// The shock after random changes of its direction, of the size `angle` at first.
    fn improved(&self, mut ray: Ray, angle: f64, changes: usize, random: &SplitMix64) -> Ray {
        /// After a success the changes grow by this factor, and after four failures they are as large as before: so
        /// about one in five succeeds (I. Rechenberg, Evolutionsstrategie, 1973). A factor closer to 1 would adapt
        /// more slowly.
        const GROWTH: f64 = 1.5;
        let shrink = pxfm::f_pow(GROWTH, -0.25);
        let mut step = angle;
        for change in 0..changes {
            if step < self.precision {
                break;
            }
            let by = normal(ray.direction.len(), change as u64, random);
            let moved = ray.direction.iter().zip(&by).map(|(x, y)| x + step * y).collect();
            let Some(direction) = unit(moved) else { continue };
            let shorter = ray.size * (1.0 - self.precision);
            let label = self.at(&direction, shorter);
            if !self.is_fatal(label) {
                step *= shrink;
                continue;
            }
            // Backwards along the ray to a shock that is not fatal. The state itself is not in another basin.
            let (mut fatal, mut found, mut back) = (shorter, label, step * ray.size);
            let safe = loop {
                let safe = (shorter - back).max(0.0);
                let there = if safe > 0.0 { self.at(&direction, safe) } else { self.own };
                if !self.is_fatal(there) {
                    break safe;
                }
                (fatal, found) = (safe, there);
                back *= 2.0;
            };
            let (size, label) = self.shortened(&direction, safe, fatal, found);
            ray = Ray { direction, size, label };
            step = (step * GROWTH).min(angle);
        }
        ray
    }
}
