//! Attractors of maps and flows of several variables, found by recurrences to cells of a grid and tested as traps.
//!
//! The idea is that of G. Datseris and A. Wagemakers (Chaos 32, 023104, 2022; `AttractorsViaRecurrences` of
//! Attractors.jl): an orbit that visits only cells that it visited before has come to an attractor. A slow passage
//! does the same. Here the cells are a candidate only. It is followed for long (`followed_orbit`), and tested
//! before it is called an attractor; an orbit without a tested attractor is reported.

use crate::attractors::candidate::Candidate;
use crate::attractors::confirmation::drift;
use crate::attractors::followed_orbit::{End, Orbit, Settled};
use crate::attractors::known_cells::KnownCells;
use crate::attractors::recurrence_limits::{MOST_TESTS, RecurrenceLimits};
use crate::attractors::state_grid::StateGrid;
use crate::attractors::state_map::{Moving, Repeats, StateMap, check_starts};
use crate::attractors::unmatched::{Remedy, Unmatched, UnmatchedReason, remedy};
use crate::error::Error;
use crate::space::label::{Label, label_of_attractor};
use std::collections::BTreeMap;

/// An attractor, located to the cells of a grid.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractor {
    /// Its label: basin 1 for the first that was found, and so on.
    pub label: Label,
    /// Successive points of an orbit on it. Of a cycle these are all of them, one period; else as many as the limits locate, and then one
    /// point of each other cell.
    pub points: Vec<Vec<f64>>,
    /// The smallest number of steps after which it comes back to each of its points, to 10⁻⁹ of the sides of the region, and of its size in a
    /// coordinate without cells: 1 for a fixed point. `None` if there is none up to half of the steps that the limits locate, and for a swing towards
    /// a point that is still far.
    pub period: Option<usize>,
    /// How many of the starts came to it.
    pub starts: usize,
}

/// The attractors of a map in a region, and the orbits that belong to none.
#[derive(Debug, Clone, PartialEq)]
pub struct Attractors {
    pub(crate) known: KnownCells,
    pub(crate) limits: RecurrenceLimits,
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
    /// use basin_of_attraction::{Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits, StateGrid, array_map};
    /// // Newton's method for z² = −1 in the plane converges to ±i.
    /// let newton = array_map(|[x, y]| {
    ///     let square = x * x + y * y;
    ///     (square > 0.0).then(|| [0.5 * (x - x / square), 0.5 * (y + y / square)])
    /// });
    /// let region = Hyperrectangle::new(vec![Interval::new(-3.1, 3.0)?; 2])?;
    /// let starts = [vec![1.0, 2.0], vec![0.5, -0.1], vec![-2.0, 0.7], vec![1.0, 0.0]];
    /// let grid = StateGrid::uniform(region, 100)?;
    /// let found = Attractors::search(&newton, grid, &starts, RecurrenceLimits::default())?;
    /// assert_eq!(found.attractors().len(), 2);
    /// assert_eq!(found.attractors()[0].period, Some(1));
    /// assert!((found.attractors()[0].points[0][1] - 1.0).abs() < 1e-9);
    /// assert_eq!(found.label(&newton, &[0.0, -7.0]), Label::from(2));
    /// // On the line y = 0 between the basins the orbit is chaotic. It belongs to no attractor.
    /// assert_eq!(found.unmatched()[0].start, [1.0, 0.0]);
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadSearch`] for a distance of escape that is not positive and finite; [`Error::TooManySamples`] for more than 10⁶ tests; [`Error::WrongDimension`] for a map or a start of
    /// another dimension than the states of the grid; [`Error::TooManyAttractors`] beyond 65 000.
    pub fn search(
        map: &dyn StateMap,
        grid: StateGrid,
        starts: &[Vec<f64>],
        limits: RecurrenceLimits,
    ) -> Result<Attractors, Error> {
        let known = KnownCells::new(grid);
        let expected = known.dimension();
        check_starts(map, starts, expected)?;
        if let Some(value) = limits.escape.filter(|escape| !(*escape > 0.0 && escape.is_finite())) {
            let (name, remedy) = ("a distance of escape", "; give none if there is none");
            return Err(Error::BadSearch { name, value, remedy });
        }
        if limits.tests > MOST_TESTS {
            let remedy =
                "these are the tests of one candidate: hundreds find all but small openings";
            return Err(Error::TooManySamples { samples: limits.tests, most: MOST_TESTS, remedy });
        }
        let mut found = Attractors { known, limits, attractors: Vec::new(), unmatched: Vec::new() };
        // The end of the orbit that found each attractor, and for each unmatched start the attractors that were known.
        let (mut ends, mut known_then) = (Vec::new(), Vec::new());
        for start in starts {
            if let Some(reason) = found.search_from(map, start, &mut ends)? {
                found.unmatched.push(Unmatched { start: start.clone(), reason });
                known_then.push(found.attractors.len());
            }
        }
        let last = found.attractors.len();
        found.merge(map, &ends);
        // An attractor that was found later may be that of an earlier start.
        for (own, then) in std::mem::take(&mut found.unmatched).into_iter().zip(known_then) {
            let label = if then == last { Label::UNDECIDED } else { found.label(map, &own.start) };
            match found.attractors.iter_mut().find(|attractor| attractor.label == label) {
                Some(attractor) => attractor.starts += 1,
                None if label.is_escaped() => {}
                None => found.unmatched.push(own),
            }
        }
        Ok(found)
    }

    /// Follows one start, and adds its attractor if it is new. Returns the reason if it belongs to none.
    fn search_from(
        &mut self,
        map: &dyn StateMap,
        start: &[f64],
        ends: &mut Vec<Vec<f64>>,
    ) -> Result<Option<UnmatchedReason>, Error> {
        let mut orbit = Orbit::new(&self.known, &self.limits, start);
        loop {
            return Ok(match orbit.follow(&self.known, &self.limits, map) {
                End::Known(own) => {
                    self.attractors[own].starts += 1;
                    None
                }
                End::Escaped => None,
                End::Unmatched(reason) => Some(reason),
                End::Budget => {
                    let drift = drift(map, &self.known, orbit.at(), self.limits.locate);
                    Some(UnmatchedReason::NotSettled { drift })
                }
                End::Settled(settled) => {
                    if self.add_attractor(map, &settled)? {
                        ends.push(orbit.at().to_vec());
                        None
                    } else if settled.drifts {
                        // A slow passage: the search goes on from its end.
                        orbit.go_on();
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
        let finest = self.known.grids().last().map_or(0, StateGrid::most_cells) as usize;
        let none = self.attractors.is_empty();
        none.then(|| remedy(&self.unmatched, self.limits.budget, finest)).flatten()
    }

    /// Locates and tests a candidate; `false` if the tests refuse it.
    fn add_attractor(&mut self, map: &dyn StateMap, settled: &Settled) -> Result<bool, Error> {
        let Attractors { known, limits, attractors, .. } = &*self;
        let others = attractors.iter().map(|other| other.points.as_slice()).collect();
        let Some(located) = (Candidate { map, known, limits, settled, others }).located() else {
            return Ok(false);
        };
        let index = self.attractors.len();
        let (label, points, period) =
            (label_of_attractor(index + 1)?, located.points, located.period);
        self.attractors.push(Attractor { label, points, period, starts: 1 });
        self.known.add(located.grid, located.cells.into_iter(), label);
        Ok(true)
    }

    /// Makes one of attractors whose orbits enter each other, and gives the labels again. `ends` are points of
    /// their orbits.
    fn merge(&mut self, map: &dyn StateMap, ends: &[Vec<f64>]) {
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
        let label =
            |class: &usize| self.attractors[classes.partition_point(|other| other < class)].label;
        let labels: Vec<Label> = first.iter().map(label).collect();
        let kept = classes.iter().enumerate().map(|(at, &class)| {
            // The orbit that enters no other one has come to the attractor.
            let members = || (0..first.len()).filter(|&own| first[own] == class);
            let own = members().find(|&own| enters[own].is_none()).unwrap_or(class);
            let starts = members().map(|own| self.attractors[own].starts).sum();
            Attractor { label: self.attractors[at].label, starts, ..self.attractors[own].clone() }
        });
        self.attractors = kept.collect();
        self.known.renumber(&labels);
    }

    /// The attractor that the orbit of another one enters within the budget. Where coordinates are hidden, an orbit that only crosses cells of another one has
    /// not entered it.
    fn entered(&self, map: &dyn StateMap, own: usize, end: &[f64]) -> Option<usize> {
        let (mut point, mut repeats) = (Moving::from(end), Repeats::default());
        let needed = if self.known.has_hidden() { self.limits.recurrences.max(1) } else { 1 };
        let mut stay = (None, 0);
        for _ in 0..self.limits.budget {
            let other = self.known.other_owner(&point.at, own);
            stay = (other, if other == stay.0 { stay.1 + 1 } else { 1 });
            if other.is_some() && stay.1 >= needed {
                return other;
            }
            // An orbit that repeats itself to the last bit enters nothing more.
            if repeats.see(&point.at).is_some() || !self.known.step(map, &mut point) {
                return None;
            }
        }
        None
    }
}
