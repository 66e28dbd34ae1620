//! Attractors of maps and flows of several variables, found by recurrences to cells of a grid and tested as traps.
//!
//! The idea is that of G. Datseris and A. Wagemakers (Chaos 32, 023104, 2022; `AttractorsViaRecurrences` of Attractors.jl): an
//! orbit that visits only cells that it visited before has come to an attractor. A slow passage does the same. Here the cells
//! are a candidate only, which is tested before it is called an attractor; an orbit without a tested attractor is reported.

use crate::error::Error;
use crate::hyperrectangle::Hyperrectangle;
use crate::label::Label;
use crate::split_mix::SplitMix64;
use crate::state_grid::StateGrid;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// How attractors are searched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RecurrenceLimits {
    /// Cells along every side of the region. Attractors less than three cells apart are not separated.
    pub cells: usize,
    /// Consecutive steps to cells that the orbit has visited, after which these cells are a candidate.
    pub recurrences: usize,
    /// Steps that a candidate is followed before its cells are taken, and steps without a new cell after which all are taken. An orbit
    /// of a test must visit the candidate within as many steps, three times, after as many others.
    pub locate: usize,
    /// Most steps of an orbit.
    pub budget: usize,
    /// Consecutive steps outside the region, after which an orbit is given up.
    pub lost: usize,
    /// Orbits that test a candidate.
    pub tests: usize,
    /// A distance from the origin, in the largest coordinate, from where the caller knows that no orbit returns. Such an orbit has
    /// the label [`Attractors::ESCAPED`]. `None` if there is none.
    pub escape: Option<f64>,
}

impl Default for RecurrenceLimits {
    /// A hundred cells a side, a hundred recurrences, 1000 steps of location, 10⁵ steps in all, 1000 outside, and 200 tests.
    ///
    /// More cells separate closer attractors, and take longer to be visited again by chaotic orbits. Fewer recurrences take more
    /// transients for candidates, which the tests then refuse.
    fn default() -> Self {
        RecurrenceLimits {
            cells: 100,
            recurrences: 100,
            locate: 1000,
            budget: 100_000,
            lost: 1000,
            tests: 200,
            escape: None,
        }
    }
}

/// Why the orbit of a start belongs to no attractor.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UnmatchedReason {
    /// The budget of steps was used up.
    Budget,
    /// The features of the orbit are beside those of too few others, or of two groups.
    NoGroup,
    /// The orbit stayed outside the region.
    LeftRegion,
    /// The map has no value at a point of the orbit, or one that is not finite.
    Stopped,
    /// The orbit keeps to a few cells, but orbits that start in or beside these cells do not come to them and stay: the cells are a slow
    /// passage, or the attractor is too close to the boundary of its basin for this grid. The same for a group of features and orbits from
    /// beside it.
    NoTrap,
}

/// A start whose orbit belongs to no attractor.
#[derive(Debug, Clone, PartialEq)]
pub struct Unmatched {
    /// The start.
    pub start: Vec<f64>,
    /// The reason.
    pub reason: UnmatchedReason,
}

/// An attractor, located to the cells of a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractor {
    /// Its label: basin 1 for the first that was found, and so on.
    pub label: Label,
    /// Successive points of an orbit on it, as many as the limits locate.
    pub points: Vec<Vec<f64>>,
    /// The cells that contain them.
    cells: BTreeSet<u64>,
}

/// The attractors of a map in a region, and the orbits that belong to none.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractors {
    grid: StateGrid,
    limits: RecurrenceLimits,
    attractors: Vec<Attractor>,
    unmatched: Vec<Unmatched>,
}

/// The end of an orbit.
enum End {
    Known(Label),
    Unmatched(UnmatchedReason),
    /// The orbit recurs from this point on.
    Recurs(Vec<f64>),
}

impl Attractors {
    /// The label of orbits that pass [`RecurrenceLimits::escape`].
    pub const ESCAPED: Label = Label::numbered::<0>();

    /// Searches attractors by the orbits of `starts`, in their order.
    ///
    /// `map` is a step: a map, a return map, or a flow over some time; `None` if it has no value. It may have more variables than
    /// are of interest: starts on a plane are points of the whole state space.
    ///
    /// A candidate is tested by orbits that start in its cells and in the cells beside them, at random points. Each must come to the cells of the
    /// candidate, and after [`RecurrenceLimits::locate`] steps visit them in each of three stretches of as many steps. So an attractor is a trap at the scale of the grid, as far as the
    /// tests see: a part of its neighbourhood from which orbits leave is missed with n tests if it is smaller than 3/n, in 5 of 100 cases.
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
    /// [`Error::BadSearch`] for a distance of escape that is not positive and finite; [`Error::WrongDimension`] for a start of another
    /// dimension than the region; [`Error::TooManyAttractors`] beyond 65 000.
    pub fn search(
        map: &(impl Fn(&[f64]) -> Option<Vec<f64>> + Sync),
        region: Hyperrectangle,
        starts: &[Vec<f64>],
        limits: RecurrenceLimits,
    ) -> Result<Attractors, Error> {
        let grid = StateGrid::new(region, limits.cells)?;
        if let Some(value) = limits.escape.filter(|escape| !(*escape > 0.0 && escape.is_finite())) {
            let (name, remedy) = ("a distance of escape", "; give none if there is none");
            return Err(Error::BadSearch { name, value, remedy });
        }
        let mut found = Attractors { grid, limits, attractors: Vec::new(), unmatched: Vec::new() };
        for start in starts {
            let (expected, dimension) = (found.grid.dimension(), start.len());
            if dimension != expected {
                return Err(Error::WrongDimension { dimension, expected });
            }
            let reason = match found.follow(map, start) {
                End::Known(_) => continue,
                End::Unmatched(reason) => reason,
                End::Recurs(from) => {
                    if found.add_attractor(map, from)? {
                        continue;
                    }
                    UnmatchedReason::NoTrap
                }
            };
            found.unmatched.push(Unmatched { start: start.clone(), reason });
        }
        Ok(found)
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

    /// The label of the attractor to which the orbit of a point comes; undecided if it comes to none of them.
    ///
    /// The label is the same for each call: no attractor is added. So the points of a raster or of a sample can be labelled in
    /// parallel: `|x| attractors.label(&map, x)`. A point of another dimension is undecided.
    pub fn label(&self, map: &impl Fn(&[f64]) -> Option<Vec<f64>>, start: &[f64]) -> Label {
        match self.follow(map, start) {
            End::Known(label) => label,
            End::Unmatched(UnmatchedReason::Stopped) => Label::UNDECIDED_MAP,
            End::Unmatched(_) | End::Recurs(_) => Label::UNDECIDED,
        }
    }

    /// Follows an orbit until it comes to a cell of an attractor, recurs, or ends.
    fn follow(&self, map: &impl Fn(&[f64]) -> Option<Vec<f64>>, start: &[f64]) -> End {
        let limits = &self.limits;
        let mut visited: BTreeSet<u64> = BTreeSet::new();
        let (mut recurrences, mut outside) = (0, 0);
        let mut at = start.to_vec();
        for _ in 0..limits.budget {
            if at.iter().any(|x| !x.is_finite()) {
                return End::Unmatched(UnmatchedReason::Stopped);
            }
            if limits.escape.is_some_and(|escape| at.iter().any(|x| x.abs() > escape)) {
                return End::Known(Self::ESCAPED);
            }
            if let Some(cell) = self.grid.cell(&at) {
                outside = 0;
                let own = self.attractors.iter().find(|attractor| attractor.cells.contains(&cell));
                if let Some(attractor) = own {
                    return End::Known(attractor.label);
                }
                recurrences = if visited.insert(cell) { 0 } else { recurrences + 1 };
                if recurrences >= limits.recurrences {
                    return End::Recurs(at);
                }
            } else {
                (outside, recurrences) = (outside + 1, 0);
                if outside > limits.lost {
                    return End::Unmatched(UnmatchedReason::LeftRegion);
                }
            }
            let Some(next) = map(&at) else { return End::Unmatched(UnmatchedReason::Stopped) };
            at = next;
        }
        End::Unmatched(UnmatchedReason::Budget)
    }

    /// Locates and tests a candidate; `false` if the test refuses it.
    fn add_attractor(
        &mut self,
        map: &(impl Fn(&[f64]) -> Option<Vec<f64>> + Sync),
        from: Vec<f64>,
    ) -> Result<bool, Error> {
        // The first points may still approach the attractor, and their cells are no part of it.
        let Some(mut at) = self.after(map, from, self.limits.locate) else { return Ok(false) };
        let (mut points, mut cells) = (VecDeque::new(), BTreeSet::new());
        let mut known = 0;
        // A chaotic orbit visits new cells for long. It is followed until it visits none in `locate` steps, or to the budget: on a
        // fine grid some cells of the attractor remain unknown.
        for _ in 0..self.limits.budget.max(self.limits.locate) {
            if known >= self.limits.locate {
                break;
            }
            let Some(cell) = self.grid.cell(&at) else { return Ok(false) };
            known = if cells.insert(cell) { 0 } else { known + 1 };
            if points.len() >= self.limits.locate {
                points.pop_front();
            }
            let Some(next) = map(&at) else { return Ok(false) };
            points.push_back(std::mem::replace(&mut at, next));
        }
        let points: Vec<Vec<f64>> = points.into();
        if !self.is_trap(map, &cells) {
            return Ok(false);
        }
        let number =
            u16::try_from(self.attractors.len() + 1).ok().filter(|&n| n <= MOST_ATTRACTORS);
        let Some(label) = number.and_then(Label::basin) else {
            return Err(Error::TooManyAttractors { most: usize::from(MOST_ATTRACTORS) });
        };
        self.attractors.push(Attractor { label, points, cells });
        Ok(true)
    }

    /// The point after some steps; `None` if the orbit stops before.
    fn after(
        &self,
        map: &impl Fn(&[f64]) -> Option<Vec<f64>>,
        from: Vec<f64>,
        steps: usize,
    ) -> Option<Vec<f64>> {
        (0..steps).try_fold(from, |at, _| map(&at))
    }

    /// Whether orbits from random points of the cells and of the cells beside them come to the cells, and come back to them.
    fn is_trap(
        &self,
        map: &(impl Fn(&[f64]) -> Option<Vec<f64>> + Sync),
        cells: &BTreeSet<u64>,
    ) -> bool {
        /// Seed of the points. Another one tests other points.
        const SEED: u64 = 1;
        /// Stretches of `locate` steps in each of which an orbit must visit the cells. A passage that is left within some
        /// thousand steps shows itself in one of three. More would take longer.
        const STRETCHES: usize = 3;
        let mut near: BTreeSet<u64> = cells.clone();
        near.extend(cells.iter().flat_map(|&cell| self.grid.neighbours(cell)));
        let beside: Vec<u64> = near.difference(cells).copied().collect();
        let inside: Vec<u64> = cells.iter().copied().collect();
        let random = SplitMix64::from_seed(SEED);
        let dimension = self.grid.dimension() as u64;
        let stays = |test: usize| {
            // Every second point is beside the cells: from there a slow passage shows itself first.
            let among =
                if test.is_multiple_of(2) && !beside.is_empty() { &beside } else { &inside };
            let first = test as u64 * (dimension + 1);
            let pick = (random.uniform(first) * among.len() as f64) as usize;
            let Some(&cell) = among.get(pick) else { return false };
            let start = self.grid.point(cell, |k| random.uniform(first + 1 + k));
            // A map may expand before it contracts: excursions are allowed at first.
            let Some(mut at) = self.after(map, start, self.limits.locate) else { return false };
            (0..STRETCHES).all(|_| {
                let mut comes = false;
                for _ in 0..self.limits.locate {
                    comes |= self.grid.cell(&at).is_some_and(|cell| cells.contains(&cell));
                    let Some(next) = map(&at) else { return false };
                    at = next;
                }
                comes
            })
        };
        (0..self.limits.tests.max(1)).into_par_iter().all(stays)
    }
}

/// Attractors beyond this number would take labels that mean other things.
const MOST_ATTRACTORS: u16 = 65_000;
