//! Where does an orbit end: at a known attractor, at a candidate for a new one, or nowhere?
//!
//! An orbit that visits only cells that it visited before has come to an attractor, or passes slowly. The
//! difference shows itself later:
//!
//! ```text
//!   0 ──────────── pace ─────────────────────────── 6 · pace ─────────── 8.5 · pace ────────── 11 · pace
//!     until it recurs        approach                    one quarter               another quarter
//! ```
//!
//! It is followed ten times as long as it took to be found. It has settled if the cells of the last two quarters
//! are the same. If not, it was a transient, and the search goes on from its end.

use crate::known_cells::{CellSet, KnownCells};
use crate::recurrence_limits::RecurrenceLimits;
use crate::state_map::{Moving, StateMap};
use crate::unmatched::{Border, UnmatchedReason};
use std::collections::BTreeMap;

/// An orbit is followed so many times as long as it took to be found. A point that is approached by a factor of 1 −
/// 10⁻⁴ a step has then come closer by e^−10. A larger number takes longer for each candidate.
const CONFIRMED: usize = 10;

/// Windows of these steps, to see a trend.
const WINDOWS: usize = 8;

/// The part of the steps of a quarter that must lie in cells of the other quarter. A chaotic attractor on a fine
/// grid has cells that are visited once; of a transient hardly any cell is visited again.
const SHARED: f64 = 0.9;

/// An orbit, with the steps since its start.
///
/// [`see`](Self::see) looks at the point where it is, and says when it has ended; else a step is to be made. So one orbit can be followed
/// alone, and several side by side.
pub(crate) struct Orbit {
    point: Moving,
    steps: usize,
    outside: usize,
    /// Where it was outside the region while it recurred, and still moved.
    cut: Option<Border>,
    visited: CellSet,
    /// Consecutive steps to visited cells.
    recurrences: usize,
    confirmation: Option<Box<Confirmation>>,
    /// The map had no value.
    is_stopped: bool,
}

/// Where an orbit ends.
pub(crate) enum End {
    /// At the attractor with this index.
    Known(usize),
    /// Beyond the distance of escape.
    Escaped,
    Unmatched(UnmatchedReason),
    /// Nowhere within the budget.
    Budget,
    /// It recurs.
    Settled(Settled),
}

/// An orbit that recurs.
pub(crate) struct Settled {
    /// A point in the middle of the confirmation.
    pub(crate) half: Vec<f64>,
    /// The steps until it was found.
    pub(crate) pace: usize,
    /// An end of its windows moves in one direction all the time: a slow approach, or a slow passage.
    pub(crate) drifts: bool,
}

/// What a look at a point shows.
enum Look {
    /// Inside the region, in this cell.
    Inside(u64),
    Outside,
    End(End),
}

impl Orbit {
    pub(crate) fn new(known: &KnownCells, start: &[f64]) -> Self {
        let mut point = Moving::from(start);
        known.wrap(&mut point.at);
        Orbit {
            point,
            steps: 0,
            outside: 0,
            cut: None,
            visited: CellSet::default(),
            recurrences: 0,
            confirmation: None,
            is_stopped: false,
        }
    }

    /// The same memory for another orbit.
    pub(crate) fn restart(&mut self, known: &KnownCells, start: &[f64]) {
        self.point.at.copy_from_slice(start);
        known.wrap(&mut self.point.at);
        (self.steps, self.outside, self.cut, self.is_stopped) = (0, 0, None, false);
        self.go_on();
    }

    /// Forgets what recurred: a transient, from whose end the search goes on.
    pub(crate) fn go_on(&mut self) {
        self.visited.clear();
        self.recurrences = 0;
        self.confirmation = None;
    }

    /// Where it is.
    pub(crate) fn at(&self) -> &[f64] {
        &self.point.at
    }

    /// Where it is, to be moved by one step.
    pub(crate) fn at_mut(&mut self) -> &mut [f64] {
        &mut self.point.at
    }

    pub(crate) fn steps(&self) -> usize {
        self.steps
    }

    /// Follows the orbit from where it is.
    pub(crate) fn follow(
        &mut self,
        known: &KnownCells,
        limits: &RecurrenceLimits,
        map: &dyn StateMap,
    ) -> End {
        loop {
            if let Some(end) = self.see(known, limits) {
                return end;
            }
            let has_image = self.point.step(map);
            self.moved(known, has_image);
        }
    }

    /// Notes that a step was made, or that the map had no value.
    pub(crate) fn moved(&mut self, known: &KnownCells, has_image: bool) {
        self.is_stopped = !has_image;
        self.steps += usize::from(has_image);
        known.wrap(&mut self.point.at);
    }

    /// Looks at the point where the orbit is; `None` if it is to be followed further.
    pub(crate) fn see(&mut self, known: &KnownCells, limits: &RecurrenceLimits) -> Option<End> {
        if self.confirmation.as_ref().is_some_and(|own| own.is_complete()) {
            let confirmation = self.confirmation.take()?;
            let verdict = confirmation.verdict(&mut self.cut);
            if verdict.is_some() {
                return verdict;
            }
            // Each turn takes eleven times as long as all before it.
            self.go_on();
        }
        if self.confirmation.is_none() && self.recurrences >= limits.recurrences.max(1) {
            let pace = self.steps.max(limits.locate).max(1);
            self.confirmation = Some(Box::new(Confirmation::new(known.dimension(), pace)));
        }
        if self.confirmation.is_none() && self.steps >= limits.budget {
            let cut = |border| End::Unmatched(UnmatchedReason::CutByBorder(border));
            return Some(self.cut.map_or(End::Budget, cut));
        }
        let look = self.look(known, limits);
        if let Some(confirmation) = &mut self.confirmation {
            return confirmation.add(&self.point.at, known, look);
        }
        match look {
            Look::End(end) => Some(end),
            Look::Inside(cell) => {
                let is_new = self.visited.insert(cell);
                self.recurrences = if is_new { 0 } else { self.recurrences + 1 };
                None
            }
            Look::Outside => None,
        }
    }

    fn look(&mut self, known: &KnownCells, limits: &RecurrenceLimits) -> Look {
        let at = &self.point.at;
        if self.is_stopped || at.iter().any(|x| !x.is_finite()) {
            return Look::End(End::Unmatched(UnmatchedReason::Stopped));
        }
        if limits.escape.is_some_and(|escape| at.iter().any(|x| x.abs() > escape)) {
            return Look::End(End::Escaped);
        }
        let Some(cell) = known.cell(at) else {
            self.outside += 1;
            return match known.beyond(at) {
                Some(border) if self.outside > limits.lost => {
                    Look::End(End::Unmatched(UnmatchedReason::LeftRegion(border)))
                }
                _ => Look::Outside,
            };
        };
        self.outside = 0;
        known.owner(at).map_or(Look::Inside(cell), |own| Look::End(End::Known(own)))
    }
}

/// What an orbit that recurs does from then on.
struct Confirmation {
    pace: usize,
    length: usize,
    /// Points so far.
    points: usize,
    window: usize,
    windows: Vec<Ends>,
    quarters: [Quarter; 2],
    half: Vec<f64>,
}

impl Confirmation {
    fn new(dimension: usize, pace: usize) -> Self {
        Confirmation {
            pace,
            length: pace.saturating_mul(CONFIRMED),
            points: 0,
            window: 0,
            windows: vec![Ends::new(dimension); WINDOWS],
            quarters: [Quarter::default(), Quarter::default()],
            half: Vec::new(),
        }
    }

    fn is_complete(&self) -> bool {
        self.points == self.length
    }

    fn add(&mut self, at: &[f64], known: &KnownCells, look: Look) -> Option<End> {
        // The window is the position in units of an eighth.
        if self.points as u128 * WINDOWS as u128 >= (self.window as u128 + 1) * self.length as u128
        {
            self.window += 1;
        }
        self.windows[self.window].add(at);
        if self.points == self.length / 2 {
            self.half = at.to_vec();
        }
        self.points += 1;
        let late = (2 * self.window).checked_sub(WINDOWS);
        let quarter = late.map(|late| &mut self.quarters[usize::from(2 * late >= WINDOWS)]);
        match (look, quarter) {
            (Look::End(end), _) => return Some(end),
            (Look::Inside(cell), Some(quarter)) => *quarter.cells.entry(cell).or_insert(0) += 1,
            (Look::Outside, Some(quarter)) => quarter.see(known.beyond(at)),
            (_, None) => {}
        }
        None
    }

    /// `None` for a transient. Where it left the region is then kept as `cut`.
    fn verdict(self, cut: &mut Option<Border>) -> Option<End> {
        let [third, fourth] = &self.quarters;
        let recurs = third.is_among(fourth) && fourth.is_among(third);
        let drifts = have_trend(&self.windows);
        match (recurs, third.farthest, fourth.farthest) {
            (true, None, None) => {
                Some(End::Settled(Settled { half: self.half, pace: self.pace, drifts }))
            }
            (true, Some(_), Some(border)) if !drifts => {
                Some(End::Unmatched(UnmatchedReason::CutByBorder(border)))
            }
            (recurs, ..) => {
                *cut = fourth.farthest.filter(|_| recurs);
                None
            }
        }
    }
}

/// How fast an orbit moves on from a point, a step: the mean change of the ends of stretches of so many steps, in
/// the largest coordinate. NaN if it stops.
pub(crate) fn drift(map: &dyn StateMap, from: &[f64], stretch: usize) -> f64 {
    let (mut point, stretch) = (Moving::from(from), stretch.max(1));
    let mut windows = Vec::new();
    for _ in 0..WINDOWS {
        let mut ends = Ends::new(point.at.len());
        for _ in 0..stretch {
            ends.add(&point.at);
            if !point.step(map) {
                return f64::NAN;
            }
        }
        windows.push(ends);
    }
    let changes = windows.windows(2).map(|pair| pair[0].distance(&pair[1]));
    changes.sum::<f64>() / (WINDOWS - 1) as f64 / stretch as f64
}

/// The largest values of each coordinate, and of its negative.
#[derive(Clone)]
pub(crate) struct Ends(Vec<f64>);

impl Ends {
    pub(crate) fn new(dimension: usize) -> Self {
        Ends(vec![f64::NEG_INFINITY; 2 * dimension])
    }

    pub(crate) fn add(&mut self, point: &[f64]) {
        let both = point.iter().flat_map(|x| [*x, -x]);
        self.0.iter_mut().zip(both).for_each(|(end, x)| *end = end.max(x));
    }

    fn distance(&self, other: &Ends) -> f64 {
        let changes = self.0.iter().zip(&other.0).map(|(a, b)| (a - b).abs());
        changes.fold(0.0, f64::max)
    }
}

/// Whether an end moves in one direction from each window to the next one.
pub(crate) fn have_trend(windows: &[Ends]) -> bool {
    let ends = windows.first().map_or(0, |first| first.0.len());
    (0..ends).any(|j| {
        let moves = |by: fn(&f64, &f64) -> bool| {
            windows.windows(2).all(|pair| by(&pair[0].0[j], &pair[1].0[j]))
        };
        moves(f64::lt) || moves(f64::gt)
    })
}

/// What an orbit visits in a quarter of its confirmation.
#[derive(Default)]
struct Quarter {
    /// Steps in each cell.
    cells: BTreeMap<u64, usize>,
    /// The farthest point outside the region.
    farthest: Option<Border>,
}

impl Quarter {
    fn see(&mut self, border: Option<Border>) {
        if let Some(border) = border
            && self.farthest.is_none_or(|own| border.excess() > own.excess())
        {
            self.farthest = Some(border);
        }
    }

    /// Whether most of its steps lie in cells of the other quarter.
    fn is_among(&self, other: &Quarter) -> bool {
        let all: usize = self.cells.values().sum();
        let again = self.cells.iter().filter(|(cell, _)| other.cells.contains_key(cell));
        all > 0 && again.map(|(_, steps)| *steps).sum::<usize>() as f64 >= SHARED * all as f64
    }
}
