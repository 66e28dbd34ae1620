//! Attractors of maps and flows of several variables, found by recurrences to cells of a grid and tested as traps.
//!
//! The idea is that of G. Datseris and A. Wagemakers (Chaos 32, 023104, 2022; `AttractorsViaRecurrences` of
//! Attractors.jl): an orbit that visits only cells that it visited before has come to an attractor. A slow passage
//! does the same. Here the cells are a candidate only. It is followed for long (`followed_orbit`), and tested
//! before it is called an attractor; an orbit without a tested attractor is reported.

use crate::error::Error;
use crate::followed_orbit::{End, Orbit, Settled, drift};
use crate::hyperrectangle::Hyperrectangle;
use crate::known_cells::KnownCells;
use crate::label::Label;
use crate::recurrence_limits::RecurrenceLimits;
use crate::split_mix::SplitMix64;
use crate::state_grid::StateGrid;
use crate::state_map::StateMap;
use crate::unmatched::{Remedy, Unmatched, UnmatchedReason, remedy};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// With fewer cells a side each of them is at the border of the region, and no orbit can be seen to stay away from it.
const FEWEST_CELLS: usize = 3;

/// Fewest orbits that test a candidate. With 10 a slow spiral of a factor 1 − 10⁻⁶ passed as an attractor, with 50
/// it does not. More take longer: a test is three stretches.
const FEWEST_TESTS: usize = 50;

/// An attractor, located to the cells of a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractor {
    /// Its label: basin 1 for the first that was found, and so on.
    pub label: Label,
    /// Successive points of an orbit on it, as many as the limits locate, and then one point of each other cell.
    pub points: Vec<Vec<f64>>,
}

/// The attractors of a map in a region, and the orbits that belong to none.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractors {
    known: KnownCells,
    limits: RecurrenceLimits,
    attractors: Vec<Attractor>,
    unmatched: Vec<Unmatched>,
}

impl Attractors {
    /// The label of orbits that pass [`RecurrenceLimits::escape`]: [`Label::ESCAPED`], which is no basin's number.
    pub const ESCAPED: Label = Label::ESCAPED;

    /// Searches attractors by the orbits of `starts`, in their order.
    ///
    /// `map` is a step: a map, a return map, or a flow over some time; `None` if it has no value. It may have more
    /// variables than are of interest: starts on a plane are points of the whole state space.
    ///
    /// An orbit that recurs is followed ten times as long as it took to recur. It is a candidate only if its cells
    /// are then visited again. A candidate is tested by orbits that start in its cells and in the cells beside
    /// them, at random points: each must come to the cells, and visit them in each of three stretches of
    /// [`RecurrenceLimits::locate`] steps. So an attractor is a trap at the scale of a grid, as far as the tests
    /// see: a part of its neighbourhood from which orbits leave is missed with n tests if it is smaller than 3/n,
    /// in 5 of 100 cases. Grids of up to 16 times as many cells are tried before a candidate is refused.
    ///
    /// A candidate that still moves, and lies at the border of the region, is none: it may go on beyond. Two
    /// attractors closer than three cells of the finest grid may be found as one.
    ///
    /// Attractors whose orbits enter each other are one. Each start that belongs to none is
    /// [unmatched](Self::unmatched), with the reason; if no attractor is found, [`remedy`](Self::remedy) says what
    /// would help.
    ///
    /// ```
    /// use basin_of_attraction::{Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits};
    /// // Newton's method for z² = −1 in the plane converges to ±i.
    /// let newton = |z: &[f64]| {
    ///     let (x, y, square) = (z[0], z[1], z[0] * z[0] + z[1] * z[1]);
    ///     (square > 0.0).then(|| vec![0.5 * (x - x / square), 0.5 * (y + y / square)])
    /// };
    /// let region = Hyperrectangle::new(vec![Interval::new(-3.1, 3.0)?; 2])?;
    /// let starts = [vec![1.0, 2.0], vec![0.5, -0.1], vec![-2.0, 0.7], vec![1.0, 0.0]];
    /// let found = Attractors::search(&newton, region, &starts, RecurrenceLimits::default())?;
    /// assert_eq!(found.attractors().len(), 2);
    /// assert!((found.attractors()[0].points[0][1] - 1.0).abs() < 1e-9);
    /// assert_eq!(found.label(&newton, &[0.0, -7.0]), Label::from(2));
    /// // On the line y = 0 between the basins the orbit is chaotic. It belongs to no attractor.
    /// assert_eq!(found.unmatched()[0].start, [1.0, 0.0]);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadStateGrid`] for a grid without cells, of more than ten dimensions, or with more than 2⁶⁴ cells;
    /// [`Error::BadSearch`] for fewer than three cells a side, and for a distance of escape that is not positive and
    /// finite; [`Error::WrongDimension`] for a start of another dimension than the region;
    /// [`Error::TooManyAttractors`] beyond 65 000.
    pub fn search(
        map: &StateMap<'_>,
        region: Hyperrectangle,
        starts: &[Vec<f64>],
        limits: RecurrenceLimits,
    ) -> Result<Attractors, Error> {
        if limits.cells < FEWEST_CELLS {
            let (name, remedy) = ("a number of cells a side", "; give 3 or more");
            return Err(Error::BadSearch { name, value: limits.cells as f64, remedy });
        }
        let known = KnownCells::new(&region, limits.cells)?;
        if let Some(value) = limits.escape.filter(|escape| !(*escape > 0.0 && escape.is_finite())) {
            let (name, remedy) = ("a distance of escape", "; give none if there is none");
            return Err(Error::BadSearch { name, value, remedy });
        }
        let mut found = Attractors { known, limits, attractors: Vec::new(), unmatched: Vec::new() };
        // The end of the orbit that found each attractor, and for each unmatched start the attractors that were known.
        let (mut ends, mut known_then) = (Vec::new(), Vec::new());
        for start in starts {
            let (expected, dimension) = (found.known.dimension(), start.len());
            if dimension != expected {
                return Err(Error::WrongDimension { dimension, expected });
            }
            if let Some(reason) = found.search_from(map, start, &mut ends)? {
                found.unmatched.push(Unmatched { start: start.clone(), reason });
                known_then.push(found.attractors.len());
            }
        }
        let last = found.attractors.len();
        found.merge(map, &ends);
        // An attractor that was found later may be that of an earlier start.
        let still_unmatched: Vec<bool> = found
            .unmatched
            .iter()
            .zip(known_then)
            .map(|(own, then)| then == last || found.label(map, &own.start).is_undecided())
            .collect();
        let mut still = still_unmatched.into_iter();
        found.unmatched.retain(|_| still.next().unwrap_or(true));
        Ok(found)
    }

    /// Follows one start, and adds its attractor if it is new. Returns the reason if it belongs to none.
    fn search_from(
        &mut self,
        map: &StateMap<'_>,
        start: &[f64],
        ends: &mut Vec<Vec<f64>>,
    ) -> Result<Option<UnmatchedReason>, Error> {
        let mut orbit = Orbit::new(start);
        loop {
            return Ok(match orbit.follow(&self.known, &self.limits, map) {
                End::Known(_) | End::Escaped => None,
                End::Unmatched(reason) => Some(reason),
                End::Budget => {
                    let drift = drift(map, &orbit.at, self.limits.locate);
                    Some(UnmatchedReason::NotSettled { drift })
                }
                End::Settled(settled) => {
                    if self.add_attractor(map, &settled)? {
                        ends.push(orbit.at);
                        None
                    } else if settled.drifts {
                        // A slow passage: the search goes on from its end.
                        continue;
                    } else {
                        Some(UnmatchedReason::NoTrap)
                    }
                }
            });
        }
    }

    /// The attractors, in the order in which they were found.
    pub fn attractors(&self) -> &[Attractor] {
        &self.attractors
    }

    /// The points of each attractor, by its label, as [`match_attractors`](crate::match_attractors) takes them.
    pub fn positions(&self) -> BTreeMap<Label, Vec<Vec<f64>>> {
        let own = |attractor: &Attractor| (attractor.label, attractor.points.clone());
        self.attractors.iter().map(own).collect()
    }

    /// The starts whose orbits belong to no attractor.
    pub fn unmatched(&self) -> &[Unmatched] {
        &self.unmatched
    }

    /// What would help if no attractor was found: a larger region, more cells, or longer orbits, by the reason of
    /// most starts. `None` if there is an attractor, or if no start has such a reason.
    pub fn remedy(&self) -> Option<Remedy> {
        let finest = self.known.grids().last().map_or(0, StateGrid::cells) as usize;
        let none = self.attractors.is_empty();
        none.then(|| remedy(&self.unmatched, self.limits.budget, finest)).flatten()
    }

    /// The label of the attractor to which the orbit of a point comes; undecided if it comes to none of them.
    ///
    /// The label is the same for each call: no attractor is added. So the points of a raster or of a sample can be
    /// labelled in parallel: `|x| attractors.label(&map, x)`. A point of another dimension is undecided.
    pub fn label(&self, map: &StateMap<'_>, start: &[f64]) -> Label {
        if start.len() != self.known.dimension() {
            return Label::UNDECIDED;
        }
        let mut orbit = Orbit::new(start);
        loop {
            return match orbit.follow(&self.known, &self.limits, map) {
                End::Known(own) => self.attractors[own].label,
                End::Escaped => Label::ESCAPED,
                End::Unmatched(UnmatchedReason::Stopped) => Label::UNDECIDED_MAP,
                // It moves on, and may come to an attractor.
                End::Settled(Settled { drifts: true, .. }) => continue,
                End::Unmatched(_) | End::Budget | End::Settled(_) => Label::UNDECIDED,
            };
        }
    }

    /// Locates and tests a candidate, on one grid after the other; `false` if the tests refuse it on all of them.
    fn add_attractor(&mut self, map: &StateMap<'_>, settled: &Settled) -> Result<bool, Error> {
        for grid in 0..self.known.grids().len() {
            let Some((cells, last)) = self.visited(map, grid, settled) else { return Ok(false) };
            let own: BTreeSet<u64> = cells.keys().copied().collect();
            // No test can start beyond the region, where an orbit that moves on may lead.
            let moves_to_border = settled.drifts
                && own.iter().any(|&cell| self.known.grids()[grid].is_at_border(cell));
            if moves_to_border || !self.is_trap(map, &self.known.grids()[grid], &own, settled.pace)
            {
                continue;
            }
            let index = self.attractors.len();
            let label = label_of(index)?;
            let of_grid = &self.known.grids()[grid];
            let seen: BTreeSet<u64> = last.iter().filter_map(|point| of_grid.cell(point)).collect();
            let others = cells.into_iter().filter(|(cell, _)| !seen.contains(cell));
            let points = Vec::from(last).into_iter().chain(others.map(|(_, point)| point));
            self.attractors.push(Attractor { label, points: points.collect() });
            self.known.add(grid, own.into_iter(), index);
            return Ok(true);
        }
        Ok(false)
    }

    /// The cells of a grid that the orbit visits in the second half of its confirmation, each with its first point,
    /// and the last points. `None` if it leaves the region or stops.
    fn visited(
        &self,
        map: &StateMap<'_>,
        grid: usize,
        settled: &Settled,
    ) -> Option<(FirstPoints, VecDeque<Vec<f64>>)> {
        /// Half of the confirmation.
        const PACES: usize = 5;
        let (grid, most) = (&self.known.grids()[grid], self.limits.locate.max(1));
        let (mut cells, mut last) = (BTreeMap::new(), VecDeque::new());
        let mut at = settled.half.clone();
        for _ in 0..settled.pace.saturating_mul(PACES) {
            cells.entry(grid.cell(&at)?).or_insert_with(|| at.clone());
            if last.len() >= most {
                last.pop_front();
            }
            let next = map(&at)?;
            last.push_back(std::mem::replace(&mut at, next));
        }
        Some((cells, last))
    }

    /// Whether orbits from random points of the cells and of the cells beside them come to the cells, and come back
    /// to them.
    fn is_trap(
        &self,
        map: &StateMap<'_>,
        grid: &StateGrid,
        cells: &BTreeSet<u64>,
        pace: usize,
    ) -> bool {
        /// Seed of the points. Another one tests other points.
        const SEED: u64 = 1;
        /// Successive stretches of `locate` steps in each of which an orbit must visit the cells. A passage that is
        /// left within some thousand steps shows itself in one of three. More would take longer.
        const STRETCHES: usize = 3;
        /// The time that an orbit may take to come to the cells, in units of the time that the candidate took to be
        /// found.
        const PACES: usize = 4;
        let mut near: BTreeSet<u64> = cells.clone();
        near.extend(cells.iter().flat_map(|&cell| grid.neighbours(cell)));
        let beside: Vec<u64> = near.difference(cells).copied().collect();
        let inside: Vec<u64> = cells.iter().copied().collect();
        let random = SplitMix64::from_seed(SEED);
        let dimension = grid.dimension() as u64;
        let stretch = self.limits.locate.max(1);
        let most = STRETCHES + pace.saturating_mul(PACES).div_ceil(stretch);
        let stays = |test: usize| {
            // Every second point is beside the cells: from there a slow passage shows itself first.
            let among =
                if test.is_multiple_of(2) && !beside.is_empty() { &beside } else { &inside };
            let first = test as u64 * (dimension + 1);
            let pick = (random.uniform(first) * among.len() as f64) as usize;
            let Some(&cell) = among.get(pick) else { return false };
            let start = grid.point(cell, |k| random.uniform(first + 1 + k));
            // A map may expand before it contracts: excursions are allowed at first.
            let Some(mut at) = (0..stretch).try_fold(start, |at, _| map(&at)) else { return false };
            let mut visits = 0;
            for _ in 0..most {
                let mut comes = false;
                for _ in 0..stretch {
                    comes |= grid.cell(&at).is_some_and(|cell| cells.contains(&cell));
                    let Some(next) = map(&at) else { return false };
                    at = next;
                }
                visits = if comes { visits + 1 } else { 0 };
                if visits >= STRETCHES {
                    return true;
                }
            }
            false
        };
        (0..self.limits.tests.max(FEWEST_TESTS)).into_par_iter().all(stays)
    }

    /// Makes one of attractors whose orbits enter each other, and gives the labels again. `ends` are points of
    /// their orbits.
    fn merge(&mut self, map: &StateMap<'_>, ends: &[Vec<f64>]) {
        if self.attractors.len() < 2 {
            return;
        }
        let enters: Vec<Option<usize>> =
            ends.iter().enumerate().map(|(own, end)| self.entered(map, own, end)).collect();
        // The first attractor that was found stands for all that are one with it.
        let mut first: Vec<usize> = (0..ends.len()).collect();
        for (own, other) in
            enters.iter().enumerate().filter_map(|(own, other)| Some((own, (*other)?)))
        {
            let (one, two) = (first[own].min(first[other]), first[own].max(first[other]));
            first.iter_mut().filter(|class| **class == two).for_each(|class| *class = one);
        }
        let mut classes = first.clone();
        classes.sort_unstable();
        classes.dedup();
        let index: Vec<usize> =
            first.iter().map(|class| classes.partition_point(|other| other < class)).collect();
        let kept = classes.iter().enumerate().map(|(at, &class)| {
            // The orbit that enters no other one has come to the attractor.
            let members = || (0..first.len()).filter(|&own| first[own] == class);
            let own = members().find(|&own| enters[own].is_none()).unwrap_or(class);
            let points = self.attractors[own].points.clone();
            Attractor { label: self.attractors[at].label, points }
        });
        self.attractors = kept.collect();
        self.known.renumber(&index);
    }

    /// The attractor that the orbit of another one enters within the budget.
    fn entered(&self, map: &StateMap<'_>, own: usize, end: &[f64]) -> Option<usize> {
        let (mut at, mut anchor) = (end.to_vec(), end.to_vec());
        for step in 1..=self.limits.budget {
            if let Some(other) = self.known.other_owner(&at, own) {
                return Some(other);
            }
            at = map(&at)?;
            // An orbit that repeats itself to the last bit enters nothing more.
            if at == anchor {
                return None;
            }
            if step.is_power_of_two() {
                anchor.clone_from(&at);
            }
        }
        None
    }
}

/// The first point of an orbit in each cell.
type FirstPoints = BTreeMap<u64, Vec<f64>>;

/// Attractors beyond this number would take labels that mean other things.
const MOST_ATTRACTORS: u16 = 65_000;

/// The label of the attractor with this index.
fn label_of(index: usize) -> Result<Label, Error> {
    let number = u16::try_from(index + 1).ok().filter(|&number| number <= MOST_ATTRACTORS);
    let most = usize::from(MOST_ATTRACTORS);
    number.and_then(Label::basin).ok_or(Error::TooManyAttractors { most })
}
