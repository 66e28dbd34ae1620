//! A test of the cells of a candidate: does an orbit from in or beside them come to them, and stay?

use crate::attractors::confirmation::{Ends, have_trend};
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

/// Windows to see a trend of an orbit, as many as show that of a candidate.
const WINDOWS: usize = 8;

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

    /// Whether a state lies in cells of the finest grid, or beside them: what lies on the border of two may be in either.
    fn is_near(&self, at: &[f64]) -> bool {
        let Some(grid) = self.known.grids().last() else { return true };
        let Some(cell) = grid.cell(at) else { return false };
        let mut beside = grid.neighbours(cell).into_iter();
        self.finest.contains(&cell) || beside.any(|near| self.finest.contains(&near))
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
    is_stopped: bool,
}

/// The parts of a test, one after the other.
enum Part {
    /// A map may expand before it contracts: excursions are allowed at first.
    Excursion,
    /// So many stretches in all, so many with visits in a row, and whether there is one in this stretch.
    Visits { stretches: usize, visits: usize, comes: bool },
    /// The orbit repeats itself: a turn shows all.
    Cycle { first: Vec<f64>, comes: bool, is_same: bool },
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
            is_stopped: false,
        }
    }

    pub(crate) fn restart(&mut self, start: impl Fn(&mut [f64])) {
        start(&mut self.point.at);
        (self.part, self.points, self.is_stopped) = (Part::Excursion, 0, false);
        self.repeats.forget();
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
            && self.repeats.see(&self.point.at).is_some()
        {
            self.part = Part::Cycle { first: Vec::new(), comes: false, is_same: false };
        }
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
                    self.part = Part::Comparison(vec![Ends::new(self.point.at.len())]);
                    return None;
                }
                let approach = self.trap.pace.saturating_mul(PACES).div_ceil(self.trap.stretch);
                (*stretches >= STRETCHES + approach).then_some(Test::Leaves)
            }
            Part::Cycle { first, comes, is_same } => {
                let is_turn = *first == self.point.at;
                if first.is_empty() {
                    first.clone_from(&self.point.at);
                }
                *comes = *comes || self.trap.contains(&self.point.at);
                *is_same = *is_same || self.trap.is_near(&self.point.at);
                match (*comes, *is_same) {
                    (true, true) => Some(Test::Stays),
                    (true, false) if is_turn => Some(Test::Apart),
                    _ => is_turn.then_some(Test::Leaves),
                }
            }
            Part::Comparison(windows) => {
                if self.trap.is_near(&self.point.at) {
                    return Some(Test::Stays);
                }
                if let Some(last) = windows.last_mut() {
                    last.add(&self.point.at);
                }
                if is_end && windows.len() == WINDOWS {
                    return Some(if have_trend(windows) { Test::Stays } else { Test::Apart });
                }
                if is_end {
                    windows.push(Ends::new(self.point.at.len()));
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

    fn moved(&mut self, has_image: bool) {
        self.is_stopped = !has_image;
        self.trap.known.wrap(&mut self.point.at);
    }
}
