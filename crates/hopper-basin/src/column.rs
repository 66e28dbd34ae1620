//! Speeds in increasing order at one mass ratio: their labels, and what their orbits have in common.

use crate::arcs::Arcs;
use crate::itinerary::Itinerary;
use crate::ladder::Ladder;
use crate::{Error, Fates, HopperFate};
use std::ops::Range;

/// Labels and itineraries of a column.
pub(crate) struct Column<'a> {
    pub(crate) fates: &'a Fates,
    pub(crate) ladder: Ladder,
    /// Where the map is proved to be monotone; nothing where too little is.
    pub(crate) arcs: Option<Arcs>,
    pub(crate) labels: Vec<u16>,
    /// Of the speeds whose orbits have come to their ends.
    itineraries: Vec<Option<Itinerary>>,
    /// Whether what lies between a speed and the next has the fate of both.
    closed: Vec<bool>,
}

impl<'a> Column<'a> {
    /// Nothing labelled yet.
    pub(crate) fn new(fates: &'a Fates, speeds: &[f64]) -> Result<Self, Error> {
        let largest = speeds.last().copied().unwrap_or(0.0);
        Ok(Column {
            fates,
            ladder: Ladder::below(fates, largest)?,
            arcs: Arcs::below(fates.map().mass_ratio(), largest)?,
            labels: vec![HopperFate::UNDECIDED; speeds.len()],
            itineraries: vec![None; speeds.len()],
            closed: vec![false; speeds.len()],
        })
    }

    /// The orbit of speed `at` has come to its end.
    pub(crate) fn finish(&mut self, at: usize, itinerary: Itinerary) {
        self.itineraries[at] = Some(itinerary);
    }

    /// Labels what is between two finished speeds, if it ends as they do; else gives the middle, if there is one.
    pub(crate) fn narrow(&mut self, left: usize, right: usize) -> Option<usize> {
        let (first, second) = (self.itineraries[left]?, self.itineraries[right]?);
        if first.leads_as(&second) {
            let label = self.labels[left];
            self.labels[left..right].fill(label);
            self.closed[left..right].fill(true);
            return None;
        }
        (right - left >= 2).then(|| left.midpoint(right))
    }

    /// What is closed between the speeds of `range`: from where, so many gaps, and how it ends.
    pub(crate) fn closed(&self, range: Range<usize>) -> Vec<(Range<usize>, Itinerary, u16)> {
        let mut found = Vec::new();
        let mut at = range.start;
        while at < range.end {
            let length = self.closed[at..range.end].iter().take_while(|&&closed| closed).count();
            if let (1.., Some(itinerary)) = (length, self.itineraries[at]) {
                found.push((at..at + length, itinerary, self.labels[at]));
            }
            at += length + 1;
        }
        found
    }
}
