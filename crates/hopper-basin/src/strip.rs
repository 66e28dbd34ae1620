//! Columns side by side, their orbits hopping together.
//!
//! ```text
//!   hump by hump from below
//!     every so many-th speed is followed
//!     as soon as two neighbours have come to their ends
//!       with a common itinerary      all between them is labelled as they are
//!       else                         the middle is followed
//!     what is between such neighbours is known to orbits that come down to it
//! ```
//!
//! Several columns, because the hops of one are too few to fill the vectors of a processor.

use crate::arcs::RUNGS;
use crate::column::Column;
use crate::itinerary::Itinerary;
use crate::known::{Intervals, Known, NOWHERE};
use crate::{Error, Fates, HOP_BUDGET, HopperFate};
use passive_hopper::{LiftOffMap, alpha_star, index_below};
use std::ops::Range;

/// At first every 16th speed is followed.
const COARSEST: usize = 16;

/// Below a column's speeds there are so many times fewer others, for orbits that come down.
const LOWER: usize = 2;

/// A speed that is followed.
#[derive(Debug, Clone, Copy)]
struct Followed {
    column: u32,
    at: u32,
    /// The next speeds that are followed below and above; itself if there is none.
    left: u32,
    right: u32,
    itinerary: Itinerary,
}

/// The orbits of a hump.
#[derive(Default)]
struct Orbits<'a> {
    /// All that have been followed.
    all: Vec<Followed>,
    /// Which of them are on their way, their maps, where they are, and where they were.
    index: Vec<u32>,
    hops: Vec<(&'a LiftOffMap, Option<f64>)>,
    before: Vec<f64>,
    /// Hops of the oldest.
    count: usize,
    /// Intervals of known fate that those on their way have come to.
    found: Vec<u32>,
    /// Those that have come to their ends since this was last emptied.
    ended: Vec<u32>,
}

struct Strip<'a> {
    columns: Vec<Column<'a>>,
    speeds: Vec<f64>,
    intervals: Intervals,
    orbits: Orbits<'a>,
    failed: Result<(), Error>,
}

/// The labels of `speeds` > 0, in increasing order, at every mass ratio.
pub(crate) fn labels(all: &[&Fates], speeds: &[f64]) -> Result<Vec<Vec<u16>>, Error> {
    let (speeds, lower) = from_zero(speeds);
    let columns: Vec<_> =
        all.iter().map(|fates| Column::new(fates, &speeds)).collect::<Result<_, _>>()?;
    let mut intervals = Intervals::new(columns.len(), &speeds, lower);
    for (at, column) in columns.iter().enumerate() {
        for (trap, between) in column.ladder.traps() {
            intervals.add_anywhere(at, &speeds, trap, between);
        }
    }
    let orbits = Orbits::default();
    let mut strip = Strip { columns, speeds, intervals, orbits, failed: Ok(()) };
    strip.label()?;
    strip.failed?;
    Ok(strip.columns.into_iter().map(|mut column| column.labels.split_off(lower)).collect())
}

/// `speeds`, and before them fewer from 0 up; and how many these are.
fn from_zero(speeds: &[f64]) -> (Vec<f64>, usize) {
    let first = speeds.first().copied().unwrap_or(0.0);
    let count = speeds.len() / LOWER;
    let lower = (0..count).map(|k| first * (k as f64 + 0.5) / count as f64);
    // Half of the smallest number is none.
    let mut all: Vec<f64> = lower.filter(|&speed| speed > 0.0).collect();
    let count = all.len();
    all.extend_from_slice(speeds);
    (all, count)
}

impl Strip<'_> {
    fn label(&mut self) -> Result<(), Error> {
        let last = self.speeds.last().map_or(Ok(0), |&speed| index_below(speed))?;
        let with_arcs = self.columns.iter().any(|column| column.arcs.is_some());
        let mut first = 0;
        // Without arcs there are no intervals to wait for.
        for n in 0..if with_arcs { RUNGS.min(last + 1) } else { 0 } {
            let star = alpha_star(n + 1);
            let end = first + self.speeds[first..].partition_point(|&speed| speed < star);
            self.label_hump(first..end, true);
            first = end;
        }
        self.label_hump(first..self.speeds.len(), false);
        Ok(())
    }

    /// Labels the speeds of a hump, with arcs or without.
    fn label_hump(&mut self, hump: Range<usize>, with_arcs: bool) {
        self.orbits.count = 0;
        self.orbits.all.clear();
        for column in 0..self.columns.len() {
            self.add_first(column, &hump, with_arcs);
        }
        self.sort_out(0);
        loop {
            self.narrow();
            if self.orbits.index.is_empty() {
                break;
            }
            self.hop();
        }
        for (at, column) in self.columns.iter().enumerate() {
            for (range, itinerary, label) in column.closed(hump.clone()) {
                let between = (self.speeds[range.start], self.speeds[range.end]);
                self.intervals.add(at, range, Known { itinerary, label }, between);
            }
        }
    }

    /// The first speeds of a column that are followed: all of them where no arcs are known.
    fn add_first(&mut self, column: usize, hump: &Range<usize>, with_arcs: bool) {
        if hump.is_empty() {
            return;
        }
        let (first, last) = (hump.start as u32, hump.end as u32 - 1);
        if !with_arcs || self.columns[column].arcs.is_none() {
            for at in first..=last {
                self.add(column, at, (at, at));
            }
            return;
        }
        let mut left = first;
        let mut at = first;
        loop {
            let right = (at + COARSEST as u32).min(last);
            self.add(column, at, (left, right));
            if at == last {
                break;
            }
            (left, at) = (at, right);
        }
    }

    fn add(&mut self, column: usize, at: u32, (left, right): (u32, u32)) {
        let map = self.columns[column].fates.map();
        let orbits = &mut self.orbits;
        orbits.index.push(orbits.all.len() as u32);
        orbits.hops.push((map, Some(self.speeds[at as usize])));
        orbits.before.push(f64::NAN); // nowhere before: no number equals it
        let (column, itinerary) = (column as u32, Itinerary::START);
        orbits.all.push(Followed { column, at, left, right, itinerary });
    }

    /// Takes all one hop on; those that come to an end are labelled.
    fn hop(&mut self) {
        let Orbits { all, index, hops, before, .. } = &mut self.orbits;
        before.clear();
        before.extend(hops.iter().map(|hop| hop.1.unwrap_or(f64::NAN)));
        // Those with an error keep their speeds, and are sorted out one by one.
        let _ = LiftOffMap::images_of_pairs(hops);
        for ((&at, hop), &alpha) in index.iter().zip(hops.iter()).zip(before.iter()) {
            let Followed { column, itinerary, .. } = &mut all[at as usize];
            match &self.columns[*column as usize].arcs {
                Some(arcs) => itinerary.hop(alpha, hop.1, arcs, hop.0),
                None => itinerary.give_up(),
            }
        }
        self.orbits.count += 1;
        self.sort_out(0);
    }

    /// From orbit `first` on: labels those that have come to an end, and keeps the others.
    fn sort_out(&mut self, first: usize) {
        // First all that is known, without a branch.
        let Orbits { all, index, hops, before, found, .. } = &mut self.orbits;
        found.clear();
        let orbits = index[first..].iter().zip(&hops[first..]).zip(&before[first..]);
        found.extend(orbits.map(|((&at, hop), before)| {
            let alpha = hop.1.unwrap_or(f64::NAN);
            let found = self.intervals.at(all[at as usize].column as usize, alpha);
            if alpha == *before { NOWHERE } else { found }
        }));
        let mut kept = first;
        for from in first..self.orbits.index.len() {
            let at = self.orbits.index[from];
            let hop = self.orbits.hops[from];
            if self.ends(at, (self.orbits.before[from], hop.1), self.orbits.found[from - first]) {
                self.orbits.ended.push(at);
            } else {
                (self.orbits.index[kept], self.orbits.hops[kept]) = (at, hop);
                kept += 1;
            }
        }
        self.orbits.index.truncate(kept);
        self.orbits.hops.truncate(kept);
        self.orbits.before.truncate(kept);
    }

    /// Whether an orbit has come to its end, which is noted.
    #[inline]
    fn ends(&mut self, at: u32, (before, speed): (f64, Option<f64>), found: u32) -> bool {
        if found != NOWHERE {
            let (known, between) = self.intervals.get(found);
            self.end_in(at, speed.unwrap_or(f64::NAN), (known, between));
            return true;
        }
        let Followed { column, at: start, itinerary, .. } = &mut self.orbits.all[at as usize];
        let Column { labels, ladder, fates, .. } = &mut self.columns[*column as usize];
        let Some(alpha) = speed else {
            labels[*start as usize] = HopperFate::GROUNDED;
            return true;
        };
        if alpha != before && alpha > 0.0 && self.orbits.count <= HOP_BUDGET {
            // The intervals do not show all that is in a trap.
            match ladder.trap(alpha, fates) {
                None => return false,
                Some(trap) if u64::from(trap.0.label) != HopperFate::LARGEST_LABEL => {
                    self.end_in(at, alpha, trap);
                    return true;
                }
                // Higher indices share a label of the generic traps.
                Some(_) => {}
            }
        }
        itinerary.give_up();
        match fates.fate(self.speeds[*start as usize]) {
            Ok(fate) => labels[*start as usize] = fate.label(),
            Err(error) => self.failed = Err(error),
        }
        true
    }

    /// An orbit has come to `alpha` in an interval of known fate.
    #[inline]
    fn end_in(&mut self, at: u32, alpha: f64, (known, between): (Known, (f64, f64))) {
        let Followed { column, at, itinerary, .. } = &mut self.orbits.all[at as usize];
        itinerary.end_in(alpha, &known.itinerary, between);
        self.columns[*column as usize].labels[*at as usize] = known.label;
    }

    /// Looks at the gaps beside those that have ended, until only orbits on their way are left.
    fn narrow(&mut self) {
        while !self.orbits.ended.is_empty() {
            let mut ended = std::mem::take(&mut self.orbits.ended);
            let first = self.orbits.index.len();
            for index in ended.drain(..) {
                let Followed { column, at, left, right, itinerary } =
                    self.orbits.all[index as usize];
                let column = column as usize;
                self.columns[column].finish(at as usize, itinerary);
                for (left, right) in [(left, at), (at, right)] {
                    if left < right
                        && let Some(middle) =
                            self.columns[column].narrow(left as usize, right as usize)
                    {
                        self.add(column, middle as u32, (left, right));
                    }
                }
            }
            self.orbits.ended = ended;
            self.sort_out(first);
        }
    }
}
