//! A test of the cells of a candidate: does an orbit from in or beside them come to them, and stay?

use crate::attractors::confirmation::{Ends, WINDOWS, have_trend};
use crate::attractors::known_cells::{CellSet, KnownCells};
use crate::attractors::many_orbits::FollowedOrbit;
use crate::attractors::state_grid::StateGrid;
use crate::attractors::state_map::{Moving, Repeats};
use std::sync::atomic::{AtomicBool, Ordering};

/// Successive stretches in each of which an orbit must visit the cells. A passage that is left within some thousand steps shows itself in
/// one of three. More would take longer.
const STRETCHES: usize = 3;

/// The time that an orbit may take to come to the cells, in units of the time that the candidate took to be found.
const PACES: usize = 4;

/// Ends that are so many cells of the finest grid apart, or fewer, are those of one attractor.
const SAME_ENDS: f64 = 3.0;

/// An orbit comes to the candidate if it still goes this part of the way: the estimate of the rest from three windows is rough.
const COMES: f64 = 0.5;

/// What tests show of the cells of a candidate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Test {
    /// Orbits come to the cells, and to the candidate.
    Stays,
    /// Orbits come to the cells and stay, but to another attractor in them.
    Apart,
    /// An orbit leaves the cells.
    Leaves,
}

/// The cells of a candidate, as a trap that is tested.
pub(crate) struct Trap<'a> {
    pub(crate) known: &'a KnownCells,
    pub(crate) grid: &'a StateGrid,
    pub(crate) cells: CellSet,
    /// Its cells on the finest grid.
    pub(crate) finest: &'a CellSet,
    /// Its ends, in cells of the finest grid.
    pub(crate) ends: Ends,
    /// Steps of a stretch.
    pub(crate) stretch: usize,
    /// The steps that the candidate took to be found.
    pub(crate) pace: usize,
    /// An orbit has left the cells: no other one changes that.
    pub(crate) is_refused: AtomicBool,
}

impl Trap<'_> {
    fn contains(&self, at: &[f64]) -> bool {
        self.grid.cell(at).is_some_and(|cell| self.cells.contains(&cell))
    }

    /// Whether a state lies in cells of the candidate on the finest grid, or on their border.
    fn is_near(&self, at: &[f64]) -> bool {
        let Some(grid) = self.known.grids().last() else { return true };
        let Some(cell) = grid.cell(at) else { return false };
        self.finest.contains(&cell)
            || grid.touched(at).iter().any(|near| self.finest.contains(near))
    }

    fn add_to(&self, ends: &mut Ends, at: &[f64]) {
        if let Some(grid) = self.known.grids().last() {
            ends.add(grid.in_cells(at));
        }
    }

    /// What an orbit is that stays in the cells and does not come near the candidate, by its ends in windows, one after the other.
    ///
    /// If the ends agree they are one: cycles beside each other that all attract as one circle. If the orbit moves it may come to the candidate: its moves
    /// from window to window shrink by a factor q, so that it still goes as far as the last one times q/(1 − q).
    fn compare(&self, windows: &[Ends]) -> Test {
        let [.., before, last, now] = windows else {
            let is_same = windows.last().is_some_and(|only| only.distance(&self.ends) <= SAME_ENDS);
            return if is_same { Test::Stays } else { Test::Apart };
        };
        let away = now.distance(&self.ends);
        if away <= SAME_ENDS {
            return Test::Stays;
        }
        let (move_before, move_now) = (before.distance(last), last.distance(now));
        let q = move_now / move_before;
        let goes_on = if q < 1.0 { move_now * q / (1.0 - q) } else { f64::INFINITY };
        let comes = have_trend(windows) && goes_on >= COMES * away;
        if comes { Test::Stays } else { Test::Apart }
    }
}

/// An orbit from a point in or beside the cells.
pub(crate) struct TestOrbit<'a> {
    trap: &'a Trap<'a>,
    point: Moving,
    part: Part,
    /// Points of the stretch so far.
    points: usize,
    repeats: Repeats,
    /// Points that were looked at for repeats.
    looked: usize,
    is_stopped: bool,
}

/// Points in which an orbit is expected to repeat itself, if it does so soon: most orbits that come to a cycle of few points do. Those of chaos never do, and
/// a look takes as long as a step.
const LOOKED: usize = 256;

/// The parts of a test, one after the other.
enum Part {
    /// A map may expand before it contracts: excursions are allowed at first.
    Excursion,
    /// So many stretches in all, so many with visits in a row, and whether there is one in this stretch.
    Visits { stretches: usize, visits: usize, comes: bool },
    /// The orbit repeats itself: a turn shows all.
    Cycle { first: Vec<f64>, comes: bool, is_same: bool, ends: Ends },
    /// The orbit stays in the cells. If it is not near the candidate, and moves nowhere, there are several attractors in them.
    Comparison(Vec<Ends>),
}

impl<'a> TestOrbit<'a> {
    pub(crate) fn new(trap: &'a Trap<'a>) -> Self {
        TestOrbit {
            trap,
            point: Moving::from(&vec![0.0; trap.grid.dimension()]),
            part: Part::Excursion,
            points: 0,
            repeats: Repeats::default(),
            looked: 0,
            is_stopped: false,
        }
    }

    pub(crate) fn restart(&mut self, start: impl Fn(&mut [f64])) {
        start(&mut self.point.at);
        (self.part, self.points, self.is_stopped) = (Part::Excursion, 0, false);
        self.repeats.forget();
        self.looked = 0;
    }

    /// Counts a point; true at the end of a stretch.
    fn ends_stretch(&mut self) -> bool {
        self.points += 1;
        let ends = self.points >= self.trap.stretch;
        if ends {
            self.points = 0;
        }
        ends
    }

    fn test(&mut self) -> Option<Test> {
        if let Part::Excursion | Part::Visits { .. } = self.part
            && self.looked < LOOKED
            && self.repeats.see(&self.point.at).is_some()
        {
            let ends = self.trap.ends.empty();
            self.part = Part::Cycle { first: Vec::new(), comes: false, is_same: false, ends };
        }
        self.looked += 1;
        let is_end = self.ends_stretch();
        match &mut self.part {
            Part::Excursion => {
                if is_end {
                    self.part = Part::Visits { stretches: 0, visits: 0, comes: false };
                }
                None
            }
            Part::Visits { stretches, visits, comes } => {
                *comes = *comes || self.trap.contains(&self.point.at);
                if !is_end {
                    return None;
                }
                *visits = if *comes { *visits + 1 } else { 0 };
                (*comes, *stretches) = (false, *stretches + 1);
                if *visits >= STRETCHES {
                    self.part = Part::Comparison(vec![self.trap.ends.empty()]);
                    return None;
                }
                let approach = self.trap.pace.saturating_mul(PACES).div_ceil(self.trap.stretch);
                (*stretches >= STRETCHES + approach).then_some(Test::Leaves)
            }
            Part::Cycle { first, comes, is_same, ends } => {
                let is_turn = *first == self.point.at;
                if first.is_empty() {
                    first.clone_from(&self.point.at);
                }
                *comes = *comes || self.trap.contains(&self.point.at);
                *is_same = *is_same || self.trap.is_near(&self.point.at);
                self.trap.add_to(ends, &self.point.at);
                match (*comes, *is_same) {
                    (true, true) => Some(Test::Stays),
                    (true, false) if is_turn => Some(self.trap.compare(std::slice::from_ref(ends))),
                    _ => is_turn.then_some(Test::Leaves),
                }
            }
            Part::Comparison(windows) => {
                if self.trap.is_near(&self.point.at) {
                    return Some(Test::Stays);
                }
                if let Some(last) = windows.last_mut() {
                    self.trap.add_to(last, &self.point.at);
                }
                if is_end && windows.len() == WINDOWS {
                    return Some(self.trap.compare(windows));
                }
                if is_end {
                    windows.push(self.trap.ends.empty());
                }
                None
            }
        }
    }
}

impl FollowedOrbit for TestOrbit<'_> {
    type End = Test;

    fn see(&mut self) -> Option<Test> {
        let refused = &self.trap.is_refused;
        if self.is_stopped || refused.load(Ordering::Relaxed) {
            refused.store(true, Ordering::Relaxed);
            return Some(Test::Leaves);
        }
        let found = self.test();
        if found == Some(Test::Leaves) {
            self.trap.is_refused.store(true, Ordering::Relaxed);
        }
        found
    }

    fn point(&mut self) -> &mut Moving {
        &mut self.point
    }

    /// In an excursion, and behind a visit, only the end of the stretch counts. A state with periodic coordinates is moved into the period after each step.
    fn steps(&self) -> usize {
        let waits = matches!(self.part, Part::Excursion | Part::Visits { comes: true, .. });
        match waits && self.looked >= LOOKED && !self.trap.known.is_periodic() {
            true => self.trap.stretch - self.points,
            false => 1,
        }
    }

    fn moved(&mut self, steps: usize, has_image: bool) {
        self.is_stopped = !has_image;
        self.points += steps - 1;
        self.trap.known.wrap(&mut self.point.at);
    }
}
