//! A strip: several columns side by side, whose orbits hop together.
//!
//! ```text
//!   for every hump, from the lowest up:
//!     follow every 16th speed of every column
//!     as soon as the orbits of two neighbouring followed speeds have ended:
//!       if their itineraries agree    give all speeds between them their label
//!       else                          follow the middle speed as well
//!     store the labelled intervals: an orbit that descends into one has ended
//! ```
//!
//! A strip has several columns because one column has too few orbits at a time to fill the vectors of a processor.

use crate::error::Error;
use crate::fates::beside_edge::BesideEdge;
use crate::fates::fates_at_mass_ratio::{Fates, HOP_BUDGET};
use crate::fates::hopper_fate::HopperFate;
use crate::raster::column::Column;
use crate::raster::common_circles::CommonCircles;
use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::{KnownFate, KnownIntervals, NO_INTERVAL};
use crate::raster::laps::HUMPS_WITH_LAPS;
use crate::raster::speed_within::{is_inside, large_error, with_signs};
use basin_of_attraction::Label;
use passive_hopper::{HopWithin, LiftOffMap, alpha_star, index_below};
use std::ops::Range;

/// At first every 16th speed is followed.
///
/// With a larger step fewer orbits are followed where gaps close at once, but more rounds of halving are needed
/// elsewhere, and late rounds have few orbits to fill the vectors. The value was set when columns were first bisected;
/// it affects the time only.
const COARSEST: usize = 16;

/// The number of speeds of a strip over the number of additional speeds below them. Orbits that leave the window
/// downwards find intervals of known fate between the additional speeds. Without these speeds Fig. 9 takes 1.7 times as
/// long. Most of them are never followed.
const LOWER: usize = 2;

/// Largest number of speeds of a strip, its columns together and with the additional speeds. Half of the numbers
/// below 2³² remain for the intervals of traps. A strip of this size needs some 100 GB.
const LARGEST_STRIP: usize = 1 << 31;

/// A followed speed. A speed is given by its index in the column.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Followed {
    pub(crate) column: u32,
    pub(crate) at: u32,
    /// The neighbouring followed speeds when this orbit was started; the speed itself if there is none.
    left: u32,
    right: u32,
    pub(crate) itinerary: Itinerary,
    /// The number of hops of the oldest orbit when this one was started.
    pub(crate) since: usize,
}

/// The orbits of a hump. `index`, `hops` and `before` have one entry for every orbit that has not ended (invariant
/// LISTS).
#[derive(Default)]
pub(crate) struct Orbits<'a> {
    /// All orbits that have been started.
    pub(crate) all: Vec<Followed>,
    /// The orbits that have not ended, as indices of `all`.
    index: Vec<u32>,
    /// The maps and current speeds of these orbits, with bounds on their errors.
    hops: Vec<(&'a LiftOffMap, HopWithin)>,
    /// The speeds of these orbits before the last hop, with their errors; NaN for orbits that have not hopped.
    before: Vec<(f64, f64)>,
    /// The number of hops of the oldest orbit.
    pub(crate) count: usize,
    /// For each of these orbits, the interval of known fate that contains its speed; used by `retire` only.
    found: Vec<u32>,
    /// The orbits that have ended since the last call of `refine`.
    ended: Vec<u32>,
}

pub(crate) struct ColumnStrip<'a> {
    pub(crate) columns: Vec<Column<'a>>,
    pub(crate) speeds: Vec<f64>,
    /// The number of additional speeds, whose labels are not needed.
    lower: usize,
    pub(crate) intervals: KnownIntervals,
    pub(crate) orbits: Orbits<'a>,
    /// The circles that all columns share, if they are near enough to each other.
    pub(crate) common: Option<&'a CommonCircles>,
    /// Starts that fall onto fixed points, with the itineraries of all starts beside them.
    pub(crate) edges: Vec<(BesideEdge, Itinerary)>,
    /// For n = 0, 1, …: the number of orbits that jumped left of α*_n.
    pub(crate) jumped: Vec<usize>,
    /// The error from which a hop may need its second bound.
    pub(crate) large_error: f64,
    /// The last error of a fate that was computed for one speed alone.
    failed: Result<(), Error>,
}

/// The labels of `speeds` > 0, in increasing order, at every mass ratio.
pub(crate) fn labels(
    all: &[&Fates],
    speeds: &[f64],
    common: Option<&CommonCircles>,
) -> Result<Vec<Vec<Label>>, Error> {
    let large_error = large_error(speeds);
    let (speeds, lower) = with_lower_speeds(speeds);
    // Orbits and intervals are numbered by `u32`, at most one for each speed of each column.
    if speeds.len().saturating_mul(all.len()) > LARGEST_STRIP {
        let (speeds, columns) = (speeds.len(), all.len());
        return Err(Error::TooManySpeeds { speeds, columns, largest: LARGEST_STRIP });
    }
    let columns: Vec<_> =
        all.iter().map(|fates| Column::new(fates, &speeds)).collect::<Result<_, _>>()?;
    let mut intervals = KnownIntervals::new(columns.len(), &speeds, lower);
    for (at, column) in columns.iter().enumerate() {
        for (fate, ends) in column.known_traps() {
            intervals.add_between(at, &speeds, fate, ends);
        }
    }
    let orbits = Orbits::default();
    let (edges, jumped, failed) = (Vec::new(), Vec::new(), Ok(()));
    let mut strip = ColumnStrip {
        columns,
        speeds,
        lower,
        intervals,
        orbits,
        common,
        edges,
        jumped,
        large_error,
        failed,
    };
    strip.label()?;
    strip.failed?;
    Ok(strip.columns.into_iter().map(|mut column| column.labels.split_off(lower)).collect())
}

/// The additional speeds, equally spaced from 0 up to the first of `speeds`, followed by `speeds`; and the number of
/// additional speeds.
fn with_lower_speeds(speeds: &[f64]) -> (Vec<f64>, usize) {
    let first = speeds.first().copied().unwrap_or(0.0);
    let count = speeds.len() / LOWER;
    let lower = (0..count).map(|k| first * (k as f64 + 0.5) / count as f64);
    // Half of the smallest subnormal is 0, which is not a valid speed.
    let mut all: Vec<f64> = lower.filter(|&speed| speed > 0.0).collect();
    let count = all.len();
    all.extend_from_slice(speeds);
    (all, count)
}

impl ColumnStrip<'_> {
    fn label(&mut self) -> Result<(), Error> {
        let last = self.speeds.last().map_or(Ok(0), |&speed| index_below(speed))?;
        let with_laps = self.columns.iter().any(|column| column.laps.is_some());
        let mut first = 0;
        // DOWN: orbits only descend, so that the intervals of lower humps are complete when an orbit descends to them.
        // Without laps there are no such intervals, and all humps are treated as one.
        for n in 0..if with_laps { HUMPS_WITH_LAPS.min(last + 1) } else { 0 } {
            let star = alpha_star(n + 1);
            let end = first + self.speeds[first..].partition_point(|&speed| speed < star);
            self.label_hump(first..end, true);
            first = end;
        }
        self.label_hump(first..self.speeds.len(), false);
        Ok(())
    }

    /// Labels the speeds of a hump. Without laps every speed is followed.
    fn label_hump(&mut self, hump: Range<usize>, with_laps: bool) {
        self.orbits.count = 0;
        self.orbits.all.clear();
        for column in 0..self.columns.len() {
            self.start_column(column, &hump, with_laps);
        }
        self.retire(0);
        loop {
            self.refine();
            if self.orbits.index.is_empty() {
                break;
            }
            self.hop();
        }
        for (at, column) in self.columns.iter().enumerate() {
            for (range, itinerary, label) in column.closed_intervals(hump.clone()) {
                let ends = (self.speeds[range.start], self.speeds[range.end]);
                self.intervals.add(at, range, KnownFate { itinerary, label }, ends);
            }
        }
    }

    /// Starts the first orbits of a column: of every 16th speed and the last, or of all speeds without laps.
    fn start_column(&mut self, column: usize, hump: &Range<usize>, with_laps: bool) {
        if hump.is_empty() {
            return;
        }
        let (first, last) = (hump.start as u32, hump.end as u32 - 1);
        if !with_laps || self.columns[column].laps.is_none() {
            // No two itineraries would agree. Each orbit is followed alone.
            for at in hump.start.max(self.lower)..hump.end {
                self.start(column, at as u32, (at as u32, at as u32));
            }
            return;
        }
        let mut left = first;
        let mut at = first;
        loop {
            let right = (at + COARSEST as u32).min(last);
            self.start(column, at, (left, right));
            if at == last {
                break;
            }
            (left, at) = (at, right);
        }
    }

    fn start(&mut self, column: usize, at: u32, (left, right): (u32, u32)) {
        let map = self.columns[column].fates.map();
        let orbits = &mut self.orbits;
        orbits.index.push(orbits.all.len() as u32);
        orbits.hops.push((map, HopWithin::Next { speed: self.speeds[at as usize], error: 0.0 }));
        // NaN equals no speed, so that an orbit that has not hopped does not seem to repeat its speed.
        orbits.before.push((f64::NAN, f64::NAN));
        let (column, itinerary) = (column as u32, Itinerary::START);
        orbits.all.push(Followed { column, at, left, right, itinerary, since: orbits.count });
    }

    /// Computes the next hop of all orbits, and retires the orbits that end.
    fn hop(&mut self) {
        let Orbits { all, index, hops, before, .. } = &mut self.orbits;
        before.clear();
        before.extend(hops.iter().map(|hop| speed_and_error(&hop.1)));
        LiftOffMap::hops_within(hops);
        for (&at, &alpha) in index.iter().zip(before.iter()) {
            let Followed { column, itinerary, .. } = &mut all[at as usize];
            match &self.columns[*column as usize].laps {
                Some(laps) => itinerary.hop(laps.lap(alpha.0, alpha.1)),
                None => itinerary.give_up(),
            }
        }
        self.orbits.count += 1;
        self.retire(0);
    }

    /// Labels the orbits that have ended among those from `first` on, and removes them from the lists.
    fn retire(&mut self, first: usize) {
        // All look-ups are done first, in a loop without branches, so that the processor overlaps them.
        let Orbits { all, index, hops, before, found, .. } = &mut self.orbits;
        found.clear();
        let orbits = index[first..].iter().zip(&hops[first..]).zip(&before[first..]);
        found.extend(orbits.map(|((&at, hop), before)| {
            let (alpha, _) = speed_and_error(&hop.1);
            let found = self.intervals.find(all[at as usize].column as usize, alpha);
            // An orbit that repeats its speed is left to `ends`.
            if alpha == before.0 { NO_INTERVAL } else { found }
        }));
        let mut kept = first;
        for from in first..self.orbits.index.len() {
            let at = self.orbits.index[from];
            let mut hop = self.orbits.hops[from];
            let jumped = match self.slow_side(at, hop.1) {
                Some(slow) => self.jump(at, slow, hop.1),
                None => Some(hop.1),
            };
            let ended = match jumped {
                None => true,
                Some(next) if next != hop.1 => {
                    hop.1 = next;
                    false
                }
                // Not jumped: the budget of hops and repeated speeds count here too.
                Some(_) => {
                    let before = self.orbits.before[from];
                    // In a narrow window many orbits come near to fixed points, where the first bound grows fastest.
                    if self.common.is_some() || hop.1 == HopWithin::Inconclusive {
                        hop.1 = with_signs(hop.0, before, hop.1, self.large_error);
                    }
                    self.ends(at, (before.0, hop.1), self.orbits.found[from - first])
                }
            };
            if ended {
                self.orbits.ended.push(at);
            } else {
                // LISTS: `before` is not compacted, only shortened. Until the next hop fills it again, only the entries
                // of orbits started after the last hop are read.
                (self.orbits.index[kept], self.orbits.hops[kept]) = (at, hop);
                kept += 1;
            }
        }
        self.orbits.index.truncate(kept);
        self.orbits.hops.truncate(kept);
        self.orbits.before.truncate(kept);
    }

    /// Whether an orbit has ended; if so, labels it and completes its itinerary.
    #[inline]
    fn ends(&mut self, at: u32, (before, hop): (f64, HopWithin), found: u32) -> bool {
        let (alpha, error) = match hop {
            HopWithin::Next { speed, error } => (speed, error),
            HopWithin::Grounded => {
                let Followed { column, at: start, itinerary, .. } =
                    &mut self.orbits.all[at as usize];
                itinerary.end_on_ground();
                self.columns[*column as usize].labels[*start as usize] = HopperFate::GROUNDED;
                return true;
            }
            HopWithin::Inconclusive => {
                self.end_alone(at);
                return true;
            }
        };
        if found != NO_INTERVAL {
            let (known, ends) = self.intervals.get(found);
            if is_inside(alpha, error, ends) {
                self.end_in(at, &known);
                return true;
            }
        }
        let column = &self.columns[self.orbits.all[at as usize].column as usize];
        if alpha != before && self.orbits.count <= HOP_BUDGET {
            // The table of intervals misses parts of traps.
            match column.trap(alpha) {
                None => return false,
                Some((known, ends)) if is_inside(alpha, error, ends) => {
                    self.end_in(at, &known);
                    return true;
                }
                // The end of the trap lies within the error: the next speeds decide.
                Some((_, ends)) if ends.0 <= ends.1 => return false,
                // A trap that is not in the index.
                Some(_) => {}
            }
        }
        // The orbit repeats its speed or has used up its budget of hops.
        self.end_alone(at);
        true
    }

    /// Labels a speed by its fate, computed alone: this decides more orbits, and gives the reason for the others.
    #[cold]
    fn label_alone(&mut self, column: usize, at: usize) {
        let column = &mut self.columns[column];
        match column.fates.fate(self.speeds[at]) {
            Ok(fate) => column.labels[at] = fate.label(),
            Err(error) => self.failed = Err(error),
        }
    }

    /// Ends an orbit by the fate of its start, computed alone. Its itinerary agrees with no other.
    #[cold]
    pub(crate) fn end_alone(&mut self, at: u32) {
        let Followed { column, at: start, itinerary, .. } = &mut self.orbits.all[at as usize];
        itinerary.give_up();
        let (column, start) = (*column as usize, *start as usize);
        self.label_alone(column, start);
    }

    /// Ends an orbit that has reached an interval of known fate.
    #[inline]
    fn end_in(&mut self, at: u32, known: &KnownFate) {
        let Followed { column, at: start, itinerary, .. } = &mut self.orbits.all[at as usize];
        itinerary.end_in(&known.itinerary);
        self.columns[*column as usize].labels[*start as usize] = known.label;
    }

    /// Closes or halves the gaps beside all orbits that have ended, and repeats this as long as newly started orbits
    /// end at once.
    fn refine(&mut self) {
        while !self.orbits.ended.is_empty() {
            let mut ended = std::mem::take(&mut self.orbits.ended);
            let first = self.orbits.index.len();
            for index in ended.drain(..) {
                let Followed { column, at, left, right, itinerary, .. } =
                    self.orbits.all[index as usize];
                let column = column as usize;
                self.columns[column].finish(at as usize, itinerary);
                for (left, right) in [(left, at), (at, right)] {
                    if left < right
                        && let Some(middle) =
                            self.columns[column].close_gap(left as usize, right as usize)
                    {
                        self.start(column, middle as u32, (left, right));
                    }
                }
            }
            // The empty vector is put back, so that its memory is used again.
            self.orbits.ended = ended;
            // A started orbit may be in an interval of known fate already.
            self.retire(first);
        }
    }
}

/// The current speed of an orbit and its error; NaN if the orbit has ended.
#[inline]
fn speed_and_error(hop: &HopWithin) -> (f64, f64) {
    match *hop {
        HopWithin::Next { speed, error } => (speed, error),
        _ => (f64::NAN, f64::NAN),
    }
}
