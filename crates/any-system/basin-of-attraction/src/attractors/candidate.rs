//! Is what recurs an attractor? Its cells are tested as a trap, on one grid after the other.

use crate::attractors::confirmation::Ends;
use crate::attractors::followed_orbit::Settled;
use crate::attractors::known_cells::{CellMap, CellSet, KnownCells};
use crate::attractors::many_orbits::{follow_some, in_parts};
use crate::attractors::recurrence_limits::RecurrenceLimits;
use crate::attractors::state_grid::StateGrid;
use crate::attractors::state_map::{Moving, Repeats, StateMap};
use crate::attractors::trap_test::{Test, TestOrbit, Trap};
use crate::statistics::split_mix::SplitMix64;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::AtomicBool;

/// Fewest orbits that test a candidate. With 10 a slow spiral of a factor 1 − 10⁻⁶ passed as an attractor, with 50
/// it does not. More take longer: a test is three stretches.
const FEWEST_TESTS: usize = 50;

/// An orbit has a period if it comes back to this part of the sides of the region: some digits more than a figure or a table shows, and
/// far above the rounding of a map.
const CLOSED: f64 = 1e-9;

/// The most cells beside those of a candidate that are listed, and the most numbers of its points: both are memory. In spaces of many dimensions a cell has
/// thousands of neighbours, and then only some cells have theirs listed.
const MOST_NEIGHBOURS: usize = 200_000;
const MOST_NUMBERS: usize = 20_000_000;

/// What recurs, and how it is tested.
pub(crate) struct Candidate<'a> {
    pub(crate) map: &'a dyn StateMap,
    pub(crate) known: &'a KnownCells,
    pub(crate) limits: &'a RecurrenceLimits,
    pub(crate) settled: &'a Settled,
    /// The points of the attractors that are known.
    pub(crate) others: Vec<&'a [Vec<f64>]>,
}

/// A candidate that has passed the tests, on one of the grids.
pub(crate) struct Located {
    pub(crate) grid: usize,
    pub(crate) cells: BTreeSet<u64>,
    pub(crate) points: Vec<Vec<f64>>,
    pub(crate) period: Option<usize>,
}

/// The cells of a grid that the candidate visits, each with a point.
struct Visited<'a> {
    number: usize,
    grid: &'a StateGrid,
    cells: BTreeMap<u64, &'a [f64]>,
}

/// Successive points of the candidate, as many coordinates each as a state has.
struct Points {
    coordinates: Vec<f64>,
    dimension: usize,
}

impl Points {
    fn all(&self) -> impl ExactSizeIterator<Item = &[f64]> {
        self.coordinates.chunks_exact(self.dimension)
    }

    /// The cells of a grid that they visit, each with its first point. `None` if one is outside the region.
    fn cells(&self, grid: &StateGrid) -> Option<BTreeMap<u64, &[f64]>> {
        let mut cells = CellMap::default();
        for point in self.all() {
            cells.entry(grid.cell(point)?).or_insert(point);
        }
        // An orbit that converges to the border of two cells may end in either.
        for point in self.all().filter(|point| grid.is_on_border(point)) {
            for cell in grid.touched(point) {
                cells.entry(cell).or_insert(point);
            }
        }
        Some(cells.into_iter().collect())
    }

    /// The ends of the later half, in cells of the finest grid.
    fn ends(&self, known: &KnownCells) -> Ends {
        let grids = known.grids();
        let finest = &grids[grids.len() - 1];
        let numbers = self.all().next().map_or(0, |point| finest.in_cells(point).count());
        let mut ends = Ends::new(numbers);
        let later = self.all().skip(self.all().len() / 2);
        later.for_each(|point| ends.add(finest.in_cells(point)));
        ends
    }

    /// Where they are on a grid. `most` is the largest number of successive points that are kept.
    fn located(&self, visited: Visited<'_>, most: usize, drifts: bool) -> Located {
        let Visited { number, grid, cells } = visited;
        let own: BTreeSet<u64> = cells.keys().copied().collect();
        let last: Vec<&[f64]> = self.all().skip(self.all().len().saturating_sub(most)).collect();
        let period = period(grid, &last, drifts);
        let points = match period {
            Some(period) => last[last.len() - period..].to_vec(),
            None => {
                let seen: BTreeSet<u64> = last.iter().filter_map(|at| grid.cell(at)).collect();
                let others = cells.into_iter().filter(|(cell, _)| !seen.contains(cell));
                last.into_iter().chain(others.map(|(_, point)| point)).collect()
            }
        };
        let points = points.into_iter().map(<[f64]>::to_vec).collect();
        Located { grid: number, cells: own, points, period }
    }
}

impl Candidate<'_> {
    /// Locates and tests the candidate, on one grid after the other; `None` if the tests refuse it on all of them.
    ///
    /// Where the cells of a grid hold several attractors a finer one may separate them. If none does, they are one.
    pub(crate) fn located(&self) -> Option<Located> {
        let points = self.points()?;
        let finest = self.known.grids().last()?;
        let finest: CellSet = points.all().filter_map(|point| finest.cell(point)).collect();
        let most = self.limits.locate.max(1);
        // Where it is together with other attractors on this and on all finer grids.
        let mut together = None;
        for (number, grid) in self.known.grids().iter().enumerate() {
            let cells = points.cells(grid)?;
            // No test can start beyond the region, where an orbit that moves on may lead.
            let moves_to_border =
                self.settled.drifts && cells.keys().any(|&cell| grid.is_at_border(cell));
            // Two attractors that are known have no cell in common.
            let test = match moves_to_border || self.has_another(grid, &cells) {
                true => Test::Leaves,
                false => self.test(grid, &cells, &finest, &points),
            };
            match test {
                Test::Leaves => together = None,
                Test::Stays => {
                    let visited = Visited { number, grid, cells };
                    return Some(points.located(visited, most, self.settled.drifts));
                }
                Test::Apart => together = together.or(Some(Visited { number, grid, cells })),
            }
        }
        together.map(|visited| points.located(visited, most, self.settled.drifts))
    }

    /// Whether a point of another attractor lies in the cells.
    fn has_another(&self, grid: &StateGrid, cells: &BTreeMap<u64, &[f64]>) -> bool {
        let mut points = self.others.iter().copied().flatten();
        points.any(|point| grid.cell(point).is_some_and(|cell| cells.contains_key(&cell)))
    }

    /// The points of the second half of the confirmation; two turns of a cycle. `None` if the map has no value at one.
    fn points(&self) -> Option<Points> {
        /// Half of the confirmation.
        const PACES: usize = 5;
        let mut point = Moving::from(&self.settled.half);
        let (mut repeats, mut enough) = (Repeats::default(), usize::MAX);
        let (mut coordinates, dimension) = (Vec::new(), point.at.len());
        let most = MOST_NUMBERS / dimension.max(1);
        for number in 0..self.settled.pace.saturating_mul(PACES).min(most) {
            if let Some(period) = repeats.see(&point.at) {
                enough = enough.min(period.saturating_mul(2));
            }
            if number >= enough {
                break;
            }
            coordinates.extend_from_slice(&point.at);
            if !self.known.step(self.map, &mut point) {
                return None;
            }
        }
        Some(Points { coordinates, dimension })
    }

    /// Whether orbits from random points of the cells and of the cells beside them come to the cells, and come back
    /// to them.
    fn test(
        &self,
        grid: &StateGrid,
        visited: &BTreeMap<u64, &[f64]>,
        finest: &CellSet,
        points: &Points,
    ) -> Test {
        /// Seed of the points. Another one tests other points.
        const SEED: u64 = 1;
        // A cell beside has the other coordinates of a state of a cell that it touches.
        let cells: CellSet = visited.keys().copied().collect();
        let mut beside: CellMap<&[f64]> = CellMap::default();
        let every = visited.len().div_ceil(MOST_NEIGHBOURS / grid.most_neighbours()).max(1);
        for (&cell, &state) in visited.iter().step_by(every) {
            for near in grid.neighbours(cell) {
                if !cells.contains(&near) {
                    beside.entry(near).or_insert(state);
                }
            }
        }
        let mut beside: Vec<(u64, &[f64])> = beside.into_iter().collect();
        beside.sort_unstable_by_key(|(cell, _)| *cell);
        let inside: Vec<(u64, &[f64])> = visited.iter().map(|(&cell, &at)| (cell, at)).collect();
        let random = SplitMix64::from_seed(SEED);
        let dimension = grid.dimension() as u64;
        let trap = Trap {
            known: self.known,
            grid,
            cells,
            finest,
            ends: points.ends(self.known),
            stretch: self.limits.locate.max(1),
            pace: self.settled.pace,
            is_refused: AtomicBool::new(false),
        };
        let start = |test: usize, state: &mut [f64]| {
            // Every second point is beside the cells: from there a slow passage shows itself first.
            let among =
                if test.is_multiple_of(2) && !beside.is_empty() { &beside } else { &inside };
            let first = test as u64 * (dimension + 1);
            let pick = (random.uniform(first) * among.len() as f64) as usize;
            let (cell, like) = among[pick.min(among.len() - 1)];
            state.copy_from_slice(like);
            grid.move_into(cell, |k| random.uniform(first + 1 + k), state);
        };
        let tests = self.limits.tests.max(FEWEST_TESTS);
        let mut found = vec![Test::Leaves; tests];
        in_parts(&mut found, |first, ends| {
            let begin = |k, orbit: &mut TestOrbit<'_>| orbit.restart(|at| start(first + k, at));
            follow_some(self.map, grid.dimension(), || TestOrbit::new(&trap), begin, ends);
        });
        found.into_iter().max().unwrap_or(Test::Leaves)
    }
}

/// The period of successive points, if the last ones repeat themselves. `drifts` as [`Settled::drifts`].
fn period(grid: &StateGrid, points: &[&[f64]], drifts: bool) -> Option<usize> {
    let repeats = |period: &usize| {
        (0..*period).all(|k| {
            let last = points.len() - 1 - k;
            apart(grid, points[last], points[last - period]) <= CLOSED
        })
    };
    let period = (1..=points.len() / 2).find(repeats)?;
    (period == 1 || is_cycle(grid, points, period, drifts)).then_some(period)
}

/// The largest distance of a coordinate.
fn apart(grid: &StateGrid, a: &[f64], b: &[f64]) -> f64 {
    (0..).zip(a.iter().zip(b)).map(|(k, (a, b))| grid.apart(k, *a, *b)).fold(0.0, f64::max)
}

/// Whether points that repeat themselves are those of a cycle, and not of a slow oscillation about a point that is still far.
///
/// From turn to turn the points move by d, and d shrinks by a factor q: they still go the way d·q/(1 − q). They are a cycle if that is short beside the
/// distances of the others from one of them. Movements without a direction are noise of the map, and go no way. One turn or two do not show q: then nothing may
/// drift, and the movement must be far shorter.
fn is_cycle(grid: &StateGrid, points: &[&[f64]], period: usize, drifts: bool) -> bool {
    /// The way that is still to go, as a part of the smallest distance. In an oscillation it is a half or more.
    const SHORT: f64 = 0.1;
    /// The same of a movement whose way is not known.
    const FAR_SHORTER: f64 = 1e-3;
    let begin = points.len() % period;
    let turns = points.len() / period - 1;
    let at = |turn: usize, k: usize| points[begin + turn * period + k];
    let moved = |turn: usize, other: usize| {
        let all = (0..period).map(|k| apart(grid, at(turn, k), at(other, k)));
        all.fold(0.0, f64::max)
    };
    let from_first = (1..period).map(|k| apart(grid, at(turns, 0), at(turns, k)));
    let smallest = from_first.fold(f64::INFINITY, f64::min);
    let (first, last) = (moved(0, 1), moved(turns - 1, turns));
    let way_so_far = moved(0, turns);
    let q = pxfm::f_pow(last / first, 1.0 / (turns - 1).max(1) as f64);
    if turns > 2 && q < 1.0 && way_so_far >= 0.5 * turns as f64 * last {
        return last * q / (1.0 - q) < SHORT * smallest;
    }
    let short = match turns {
        ..=2 if drifts && way_so_far > 0.0 => return false,
        ..=2 => FAR_SHORTER,
        _ => SHORT,
    };
    last.max(way_so_far) < short * smallest
}
