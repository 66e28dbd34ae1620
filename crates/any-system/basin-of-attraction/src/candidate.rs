//! Is what recurs an attractor? Its cells are tested as a trap, on one grid after the other.

use crate::followed_orbit::{Ends, Settled, have_trend};
use crate::known_cells::{CellSet, KnownCells};
use crate::recurrence_limits::RecurrenceLimits;
use crate::split_mix::SplitMix64;
use crate::state_grid::StateGrid;
use crate::state_map::{Moving, Repeats, StateMap};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, VecDeque};

/// Fewest orbits that test a candidate. With 10 a slow spiral of a factor 1 − 10⁻⁶ passed as an attractor, with 50
/// it does not. More take longer: a test is three stretches.
const FEWEST_TESTS: usize = 50;

/// An orbit has a period if it comes back to this part of the sides of the region: some digits more than a figure or a table shows, and
/// far above the rounding of a map.
const CLOSED: f64 = 1e-9;

/// What recurs, and how it is tested.
pub(crate) struct Candidate<'a> {
    pub(crate) map: &'a dyn StateMap,
    pub(crate) known: &'a KnownCells,
    pub(crate) limits: &'a RecurrenceLimits,
    pub(crate) settled: &'a Settled,
}

/// A candidate that has passed the tests, on one of the grids.
pub(crate) struct Located {
    pub(crate) grid: usize,
    pub(crate) cells: BTreeSet<u64>,
    pub(crate) points: Vec<Vec<f64>>,
    pub(crate) period: Option<usize>,
}

/// What an orbit visits: each cell with its first point, the last points, and the cells of the finest grid.
struct Visited {
    cells: BTreeMap<u64, Vec<f64>>,
    last: VecDeque<Vec<f64>>,
    finest: CellSet,
}

/// What tests show of the cells of a candidate.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Test {
    /// Orbits come to the cells, and to the candidate.
    Stays,
    /// Orbits come to the cells and stay, but to another attractor in them.
    Apart,
    /// An orbit leaves the cells.
    Leaves,
}

impl Visited {
    fn located(self, number: usize, grid: &StateGrid) -> Located {
        let Visited { cells, last, .. } = self;
        let own: BTreeSet<u64> = cells.keys().copied().collect();
        let last = Vec::from(last);
        let period = period(grid, &last);
        let points = match period {
            Some(period) => last[last.len() - period..].to_vec(),
            None => {
                let seen: BTreeSet<u64> = last.iter().filter_map(|at| grid.cell(at)).collect();
                let others = cells.into_iter().filter(|(cell, _)| !seen.contains(cell));
                last.into_iter().chain(others.map(|(_, point)| point)).collect()
            }
        };
        Located { grid: number, cells: own, points, period }
    }
}

impl Candidate<'_> {
    /// Locates and tests the candidate, on one grid after the other; `None` if the tests refuse it on all of them.
    ///
    /// Where the cells of a grid hold several attractors a finer one may separate them. If none does, they are one: the cycles of a turn by a
    /// rational part of a circle, each beside the others, attract as a circle only.
    pub(crate) fn located(&self) -> Option<Located> {
        let mut together = None;
        for (number, grid) in self.known.grids().iter().enumerate() {
            let visited = self.visited(grid)?;
            // No test can start beyond the region, where an orbit that moves on may lead.
            let moves_to_border =
                self.settled.drifts && visited.cells.keys().any(|&cell| grid.is_at_border(cell));
            if moves_to_border {
                continue;
            }
            match self.test(grid, &visited) {
                Test::Leaves => {}
                Test::Stays => return Some(visited.located(number, grid)),
                Test::Apart => {
                    together.get_or_insert_with(|| visited.located(number, grid));
                }
            }
        }
        together
    }

    fn finest(&self) -> Option<&StateGrid> {
        self.known.grids().last()
    }

    /// What the orbit visits in the second half of its confirmation. `None` if it leaves the region or stops.
    fn visited(&self, grid: &StateGrid) -> Option<Visited> {
        /// Half of the confirmation.
        const PACES: usize = 5;
        let most = self.limits.locate.max(1);
        let mut found =
            Visited { cells: BTreeMap::new(), last: VecDeque::new(), finest: CellSet::default() };
        let finest = self.finest()?;
        let mut point = Moving::from(&self.settled.half);
        for _ in 0..self.settled.pace.saturating_mul(PACES) {
            found.cells.entry(grid.cell(&point.at)?).or_insert_with(|| point.at.clone());
            found.finest.extend(finest.cell(&point.at));
            if found.last.len() >= most {
                found.last.pop_front();
            }
            found.last.push_back(point.at.clone());
            if !self.step(&mut point) {
                return None;
            }
        }
        Some(found)
    }

    fn step(&self, point: &mut Moving) -> bool {
        let found = point.step(self.map);
        self.known.wrap(&mut point.at);
        found
    }

    /// Whether orbits from random points of the cells and of the cells beside them come to the cells, and come back
    /// to them.
    fn test(&self, grid: &StateGrid, visited: &Visited) -> Test {
        /// Seed of the points. Another one tests other points.
        const SEED: u64 = 1;
        // A cell beside has the other coordinates of a state of a cell that it touches.
        let mut beside: BTreeMap<u64, &Vec<f64>> = BTreeMap::new();
        for (&cell, state) in &visited.cells {
            for near in grid.neighbours(cell) {
                if !visited.cells.contains_key(&near) {
                    beside.entry(near).or_insert(state);
                }
            }
        }
        let beside: Vec<(u64, &Vec<f64>)> = beside.into_iter().collect();
        let inside: Vec<(u64, &Vec<f64>)> = visited.cells.iter().map(|(&c, at)| (c, at)).collect();
        let cells: CellSet = visited.cells.keys().copied().collect();
        let random = SplitMix64::from_seed(SEED);
        let dimension = grid.dimension() as u64;
        let follow = |test: usize| {
            // Every second point is beside the cells: from there a slow passage shows itself first.
            let among =
                if test.is_multiple_of(2) && !beside.is_empty() { &beside } else { &inside };
            let first = test as u64 * (dimension + 1);
            let pick = (random.uniform(first) * among.len() as f64) as usize;
            let &(cell, state) = among.get(pick).ok_or(Test::Leaves)?;
            let mut start = state.clone();
            grid.move_into(cell, |k| random.uniform(first + 1 + k), &mut start);
            let test = self.follow(grid, &cells, &visited.finest, &start);
            // No other test changes that.
            if test == Test::Leaves { Err(test) } else { Ok(test) }
        };
        let tests = (0..self.limits.tests.max(FEWEST_TESTS)).into_par_iter().map(follow);
        tests.try_reduce(|| Test::Stays, |a, b| Ok(a.max(b))).unwrap_or_else(|leaves| leaves)
    }

    /// Whether an orbit comes to the cells in each of three stretches, and whether it is another attractor in the same cells.
    fn follow(&self, grid: &StateGrid, cells: &CellSet, finest: &CellSet, start: &[f64]) -> Test {
        /// Successive stretches of `locate` steps in each of which an orbit must visit the cells. A passage that is
        /// left within some thousand steps shows itself in one of three. More would take longer.
        const STRETCHES: usize = 3;
        /// The time that an orbit may take to come to the cells, in units of the time that the candidate took to be
        /// found.
        const PACES: usize = 4;
        let stretch = self.limits.locate.max(1);
        let most = STRETCHES + self.settled.pace.saturating_mul(PACES).div_ceil(stretch);
        let (mut point, mut repeats) = (Moving::from(start), Repeats::default());
        let is_in = |at: &[f64]| grid.cell(at).is_some_and(|cell| cells.contains(&cell));
        // A map may expand before it contracts: excursions are allowed at first.
        for _ in 0..stretch {
            if !self.step(&mut point) {
                return Test::Leaves;
            }
        }
        let mut visits = 0;
        for _ in 0..most {
            let mut comes = false;
            for _ in 0..stretch {
                if repeats.see(&point.at) {
                    return self.follow_cycle(point, is_in, finest);
                }
                comes |= is_in(&point.at);
                if !self.step(&mut point) {
                    return Test::Leaves;
                }
            }
            visits = if comes { visits + 1 } else { 0 };
            if visits >= STRETCHES {
                return self.compare(point, finest);
            }
        }
        Test::Leaves
    }

    /// The same for an orbit that repeats itself: a turn of it shows all.
    fn follow_cycle(
        &self,
        mut point: Moving,
        is_in: impl Fn(&[f64]) -> bool,
        finest: &CellSet,
    ) -> Test {
        let first = point.at.clone();
        let (mut comes, mut same) = (false, false);
        while !(comes && same) {
            comes |= is_in(&point.at);
            same |= self.is_near(&point.at, finest);
            if !self.step(&mut point) {
                return Test::Leaves;
            }
            if point.at == first {
                break;
            }
        }
        match (comes, same) {
            (false, _) => Test::Leaves,
            (true, false) => Test::Apart,
            (true, true) => Test::Stays,
        }
    }

    /// Whether an orbit that stays in the cells comes to the candidate, as far as the finest grid shows. If not, and if it moves nowhere,
    /// there are several attractors in the cells.
    fn compare(&self, mut point: Moving, finest: &CellSet) -> Test {
        /// As many as show a trend of a candidate.
        const WINDOWS: usize = 8;
        let mut windows = Vec::new();
        for _ in 0..WINDOWS {
            let mut ends = Ends::new(point.at.len());
            for _ in 0..self.limits.locate.max(1) {
                if self.is_near(&point.at, finest) {
                    return Test::Stays;
                }
                ends.add(&point.at);
                if !self.step(&mut point) {
                    return Test::Leaves;
                }
            }
            windows.push(ends);
        }
        if have_trend(&windows) { Test::Stays } else { Test::Apart }
    }

    /// Whether a state lies in cells of the finest grid, or beside them: what lies on the border of two may be in either.
    fn is_near(&self, at: &[f64], finest: &CellSet) -> bool {
        let Some(grid) = self.finest() else { return true };
        let Some(cell) = grid.cell(at) else { return false };
        finest.contains(&cell) || grid.neighbours(cell).iter().any(|near| finest.contains(near))
    }
}

/// The period of successive points, if the last ones repeat themselves.
fn period(grid: &StateGrid, points: &[Vec<f64>]) -> Option<usize> {
    let closed = |a: &Vec<f64>, b: &Vec<f64>| {
        let scales = (0..a.len()).map(|k| grid.side(k).unwrap_or(a[k].abs().max(b[k].abs())));
        a.iter().zip(b).zip(scales).all(|((a, b), scale)| (a - b).abs() <= CLOSED * scale)
    };
    let repeats = |period: &usize| {
        (0..*period).all(|k| {
            let last = points.len() - 1 - k;
            closed(&points[last], &points[last - period])
        })
    };
    (1..=points.len() / 2).find(repeats)
}
