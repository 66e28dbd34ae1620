//! Has an orbit that recurs settled, or is it a transient?

use crate::attractors::followed_orbit::{End, Settled};
use crate::attractors::known_cells::{CellMap, KnownCells};
use crate::attractors::state_map::{Moving, StateMap};
use crate::attractors::unmatched::{Border, UnmatchedReason};

/// An orbit is followed so many times as long as it took to be found. A point that is approached by a factor of 1 −
/// 10⁻⁴ a step has then come closer by e^−10. A larger number takes longer for each candidate.
pub(crate) const CONFIRMED: usize = 10;

/// Windows of these steps, to see a trend.
pub(crate) const WINDOWS: usize = 8;

/// The part of the steps of a quarter that must lie in cells of the other quarter. A chaotic attractor on a fine
/// grid has cells that are visited once; of a transient hardly any cell is visited again.
const SHARED: f64 = 0.9;

/// What an orbit that recurs does from then on.
pub(crate) struct Confirmation {
    pace: usize,
    pub(crate) length: usize,
    /// Points so far.
    points: usize,
    window: usize,
    windows: Vec<Ends>,
    quarters: [Quarter; 2],
    half: Vec<f64>,
}

impl Confirmation {
    pub(crate) fn new(dimension: usize, pace: usize, length: usize) -> Self {
        Confirmation {
            pace,
            length,
            points: 0,
            window: 0,
            windows: vec![Ends::new(dimension); WINDOWS],
            quarters: [Quarter::default(), Quarter::default()],
            half: Vec::new(),
        }
    }

    pub(crate) fn is_complete(&self) -> bool {
        self.points == self.length
    }

    pub(crate) fn add(&mut self, at: &[f64], known: &KnownCells) {
        // The window is the position in units of an eighth.
        if self.points as u128 * WINDOWS as u128 >= (self.window as u128 + 1) * self.length as u128
        {
            self.window += 1;
        }
        self.windows[self.window].add(at.iter().copied());
        if self.points == self.length / 2 {
            self.half = at.to_vec();
        }
        self.points += 1;
        let Some(late) = (2 * self.window).checked_sub(WINDOWS) else { return };
        let quarter = &mut self.quarters[usize::from(2 * late >= WINDOWS)];
        match known.cell(at) {
            Some(cell) => *quarter.cells.entry(cell).or_insert(0) += 1,
            None => quarter.see(known.beyond(at)),
        }
    }

    /// `None` for a transient. Where it left the region is then kept as `cut`.
    pub(crate) fn verdict(self, cut: &mut Option<Border>) -> Option<End> {
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
pub(crate) fn drift(map: &dyn StateMap, known: &KnownCells, from: &[f64], stretch: usize) -> f64 {
    let (mut point, stretch) = (Moving::from(from), stretch.max(1));
    let mut windows = Vec::new();
    for _ in 0..WINDOWS {
        let mut ends = Ends::new(point.at.len());
        for _ in 0..stretch {
            ends.add(point.at.iter().copied());
            if !known.step(map, &mut point) {
                return f64::NAN;
            }
        }
        windows.push(ends);
    }
    let changes = windows.windows(2).map(|pair| pair[0].distance(&pair[1]));
    changes.sum::<f64>() / (WINDOWS - 1) as f64 / stretch as f64
}

/// The largest values of each coordinate, and of its negative.
#[derive(Debug, Clone)]
pub(crate) struct Ends(Vec<f64>);

impl Ends {
    pub(crate) fn new(dimension: usize) -> Self {
        Ends(vec![f64::NEG_INFINITY; 2 * dimension])
    }

    /// The same number of coordinates, without a point.
    pub(crate) fn empty(&self) -> Self {
        Ends::new(self.0.len() / 2)
    }

    pub(crate) fn add(&mut self, point: impl Iterator<Item = f64>) {
        for (ends, x) in self.0.chunks_exact_mut(2).zip(point) {
            ends[0] = ends[0].max(x);
            ends[1] = ends[1].max(-x);
        }
    }

    pub(crate) fn distance(&self, other: &Ends) -> f64 {
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
    cells: CellMap<usize>,
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
