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

use crate::known_cells::KnownCells;
use crate::recurrence_limits::RecurrenceLimits;
use crate::state_map::StateMap;
use crate::unmatched::{Border, UnmatchedReason};
use std::collections::{BTreeMap, BTreeSet};

/// An orbit is followed so many times as long as it took to be found. A point that is approached by a factor of 1 −
/// 10⁻⁴ a step has then come closer by e^−10. A larger number takes longer for each candidate.
const CONFIRMED: usize = 10;

/// Windows of these steps, to see a trend.
const WINDOWS: usize = 8;

/// The part of the steps of a quarter that must lie in cells of the other quarter. A chaotic attractor on a fine
/// grid has cells that are visited once; of a transient hardly any cell is visited again.
const SHARED: f64 = 0.9;

/// An orbit, with the steps since its start.
pub(crate) struct Orbit {
    pub(crate) at: Vec<f64>,
    steps: usize,
    outside: usize,
    /// Where it was outside the region while it recurred, and still moved.
    cut: Option<Border>,
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
    pub(crate) fn new(start: &[f64]) -> Self {
        Orbit { at: start.to_vec(), steps: 0, outside: 0, cut: None }
    }

    /// Follows the orbit from where it is.
    pub(crate) fn follow(
        &mut self,
        known: &KnownCells,
        limits: &RecurrenceLimits,
        map: &StateMap<'_>,
    ) -> End {
        loop {
            if let Some(end) = self.until_it_recurs(known, limits, map) {
                return end;
            }
            // Each turn takes eleven times as long as all before it.
            match self.confirm(known, limits, map) {
                Err(end) => return end,
                Ok(Some(settled)) => return End::Settled(settled),
                Ok(None) => {}
            }
        }
    }

    fn until_it_recurs(
        &mut self,
        known: &KnownCells,
        limits: &RecurrenceLimits,
        map: &StateMap<'_>,
    ) -> Option<End> {
        let (mut visited, mut recurrences) = (BTreeSet::new(), 0);
        while recurrences < limits.recurrences {
            if self.steps >= limits.budget {
                let cut = |border| End::Unmatched(UnmatchedReason::CutByBorder(border));
                return Some(self.cut.map_or(End::Budget, cut));
            }
            match self.look(known, limits) {
                Look::End(end) => return Some(end),
                Look::Inside(cell) => {
                    recurrences = if visited.insert(cell) { 0 } else { recurrences + 1 };
                }
                Look::Outside => {}
            }
            if let Err(end) = self.step(map) {
                return Some(end);
            }
        }
        None
    }

    /// `None` for a transient.
    fn confirm(
        &mut self,
        known: &KnownCells,
        limits: &RecurrenceLimits,
        map: &StateMap<'_>,
    ) -> Result<Option<Settled>, End> {
        let pace = self.steps.max(limits.locate).max(1);
        let length = pace.saturating_mul(CONFIRMED);
        let mut windows = vec![Ends::new(known.dimension()); WINDOWS];
        let mut quarters = [Quarter::default(), Quarter::default()];
        let mut half = Vec::new();
        for k in 0..length {
            // The position in units of an eighth.
            let window = (k as u128 * WINDOWS as u128 / length as u128) as usize;
            windows[window].add(&self.at);
            if k == length / 2 {
                half.clone_from(&self.at);
            }
            let quarter =
                (2 * window).checked_sub(WINDOWS).map(|late| usize::from(2 * late >= WINDOWS));
            match self.look(known, limits) {
                Look::End(end) => return Err(end),
                Look::Inside(cell) => {
                    if let Some(quarter) = quarter {
                        *quarters[quarter].cells.entry(cell).or_insert(0) += 1;
                    }
                }
                Look::Outside => {
                    if let Some(quarter) = quarter {
                        quarters[quarter].see(known.beyond(&self.at));
                    }
                }
            }
            self.step(map)?;
        }
        let [third, fourth] = &quarters;
        let recurs = third.is_among(fourth) && fourth.is_among(third);
        let drifts = have_trend(&windows);
        match (recurs, third.farthest, fourth.farthest) {
            (true, None, None) => Ok(Some(Settled { half, pace, drifts })),
            (true, Some(_), Some(border)) if !drifts => {
                Err(End::Unmatched(UnmatchedReason::CutByBorder(border)))
            }
            (recurs, ..) => {
                self.cut = fourth.farthest.filter(|_| recurs);
                Ok(None)
            }
        }
    }

    fn look(&mut self, known: &KnownCells, limits: &RecurrenceLimits) -> Look {
        if self.at.iter().any(|x| !x.is_finite()) {
            return Look::End(End::Unmatched(UnmatchedReason::Stopped));
        }
        if limits.escape.is_some_and(|escape| self.at.iter().any(|x| x.abs() > escape)) {
            return Look::End(End::Escaped);
        }
        let Some(cell) = known.cell(&self.at) else {
            self.outside += 1;
            return match known.beyond(&self.at) {
                Some(border) if self.outside > limits.lost => {
                    Look::End(End::Unmatched(UnmatchedReason::LeftRegion(border)))
                }
                _ => Look::Outside,
            };
        };
        self.outside = 0;
        known.owner(&self.at).map_or(Look::Inside(cell), |own| Look::End(End::Known(own)))
    }

    fn step(&mut self, map: &StateMap<'_>) -> Result<(), End> {
        self.at = map(&self.at).ok_or(End::Unmatched(UnmatchedReason::Stopped))?;
        self.steps += 1;
        Ok(())
    }
}

/// How fast an orbit moves on from a point, a step: the mean change of the ends of stretches of so many steps, in
/// the largest coordinate. NaN if it stops.
pub(crate) fn drift(map: &StateMap<'_>, from: &[f64], stretch: usize) -> f64 {
    let (mut at, stretch) = (from.to_vec(), stretch.max(1));
    let mut windows = Vec::new();
    for _ in 0..WINDOWS {
        let mut ends = Ends::new(at.len());
        for _ in 0..stretch {
            ends.add(&at);
            let Some(next) = map(&at) else { return f64::NAN };
            at = next;
        }
        windows.push(ends);
    }
    let changes = windows.windows(2).map(|pair| pair[0].distance(&pair[1]));
    changes.sum::<f64>() / (WINDOWS - 1) as f64 / stretch as f64
}

/// The largest values of each coordinate, and of its negative.
#[derive(Clone)]
struct Ends(Vec<f64>);

impl Ends {
    fn new(dimension: usize) -> Self {
        Ends(vec![f64::NEG_INFINITY; 2 * dimension])
    }

    fn add(&mut self, point: &[f64]) {
        let both = point.iter().flat_map(|x| [*x, -x]);
        self.0.iter_mut().zip(both).for_each(|(end, x)| *end = end.max(x));
    }

    fn distance(&self, other: &Ends) -> f64 {
        let changes = self.0.iter().zip(&other.0).map(|(a, b)| (a - b).abs());
        changes.fold(0.0, f64::max)
    }
}

/// Whether an end moves in one direction from each window to the next one.
fn have_trend(windows: &[Ends]) -> bool {
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
