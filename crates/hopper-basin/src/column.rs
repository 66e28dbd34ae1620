//! Speeds in increasing order at one mass ratio: their labels, and what is known of those already labelled.

use crate::arcs::Arcs;
use crate::itinerary::Itinerary;
use crate::known::{Intervals, Known, Spacing};
use crate::ladder::Ladder;
use crate::{Error, Fates, HOP_BUDGET, HopperFate};
use std::ops::Range;

/// Labels and itineraries of a column.
pub(crate) struct Column<'a> {
    pub(crate) fates: &'a Fates,
    /// Where the map is proved to be monotone; nothing where too little is.
    pub(crate) arcs: Option<Arcs>,
    intervals: Intervals,
    pub(crate) labels: Vec<u16>,
    /// Of the speeds whose orbits have come to their ends.
    notes: Vec<Option<Itinerary>>,
    /// Whether what lies between a speed and the next has the fate of both.
    closed: Vec<bool>,
}

impl<'a> Column<'a> {
    /// Nothing labelled yet.
    pub(crate) fn new(fates: &'a Fates, speeds: &[f64]) -> Result<Self, Error> {
        let largest = speeds.last().copied().unwrap_or(0.0);
        let intervals = Intervals::new(Ladder::below(fates, largest)?, speeds);
        Ok(Column {
            fates,
            arcs: Arcs::below(fates.map().mass_ratio(), largest)?,
            intervals,
            labels: vec![HopperFate::UNDECIDED; speeds.len()],
            notes: vec![None; speeds.len()],
            closed: vec![false; speeds.len()],
        })
    }

    /// The label of an orbit that has come to its end, with the interval of known fate that it has come to, if any.
    /// It has come to `speed` from `before` in so many `hops`, having started from `start`.
    #[inline]
    pub(crate) fn end(
        &self,
        (start, before, speed): (f64, f64, Option<f64>),
        hops: usize,
        spacing: &Spacing,
    ) -> Option<(u16, Option<Known>)> {
        let Some(alpha) = speed else { return Some((HopperFate::GROUNDED, None)) };
        if alpha != before && alpha > 0.0 && hops <= HOP_BUDGET {
            let known = self.intervals.at(alpha, spacing, self.fates)?;
            // Higher indices share a label of the generic traps.
            if u64::from(known.label) != HopperFate::LARGEST_LABEL {
                return Some((known.label, Some(known)));
            }
        }
        Some((self.fates.label_of(start), None))
    }

    /// The orbit of speed `at` has come to its end.
    pub(crate) fn finish(&mut self, at: usize, note: Itinerary) {
        self.notes[at] = Some(note);
    }

    /// Labels what is between two finished speeds, if it ends as they do; else gives the middle, if there is one.
    pub(crate) fn narrow(&mut self, left: usize, right: usize) -> Option<usize> {
        let (Some(first), Some(second)) = (self.notes[left], self.notes[right]) else {
            return None;
        };
        if first.leads_as(&second) {
            let label = self.labels[left];
            self.labels[left..right].fill(label);
            self.closed[left..right].fill(true);
            return None;
        }
        (right - left >= 2).then(|| left.midpoint(right))
    }

    /// Keeps what is known between the speeds of `range`, for orbits that come down.
    pub(crate) fn keep(&mut self, range: Range<usize>, speeds: &[f64]) {
        let mut at = range.start;
        while at < range.end {
            let length = self.closed[at..range.end].iter().take_while(|&&closed| closed).count();
            if let (1.., Some(note)) = (length, self.notes[at]) {
                let known = note.known(self.labels[at], (speeds[at], speeds[at + length]));
                self.intervals.add(at..at + length, known);
            }
            at += length + 1;
        }
    }
}
