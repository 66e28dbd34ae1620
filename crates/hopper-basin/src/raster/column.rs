//! One column of a raster: increasing speeds at one mass ratio, their labels and their itineraries.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::KnownFate;
use crate::raster::laps::Laps;
use crate::traps::trap_index::{Lookup, TrapIndex};
use basin_of_attraction::Traps;
use std::ops::Range;

/// The labels and itineraries of a column.
pub(crate) struct Column<'a> {
    pub(crate) fates: &'a Fates,
    pub(crate) traps: TrapIndex,
    /// The laps of the map; `None` for mass ratios without laps.
    pub(crate) laps: Option<Laps>,
    pub(crate) labels: Vec<u16>,
    /// The itineraries of the speeds whose orbits have ended; `None` for speeds that are not followed, or not yet
    /// to the end.
    itineraries: Vec<Option<Itinerary>>,
    /// For every speed, whether the gap between it and the next is closed: all its speeds have the fate of both.
    closed: Vec<bool>,
}

impl<'a> Column<'a> {
    /// A column without labels.
    pub(crate) fn new(fates: &'a Fates, speeds: &[f64]) -> Result<Self, Error> {
        let largest = speeds.last().copied().unwrap_or(0.0);
        Ok(Column {
            fates,
            traps: TrapIndex::new(largest, |n| fates.trap(n))?,
            laps: Laps::below(fates.map().mass_ratio(), largest)?,
            labels: vec![HopperFate::UNDECIDED; speeds.len()],
            itineraries: vec![None; speeds.len()],
            closed: vec![false; speeds.len()],
        })
    }

    /// The fate of the trap that contains `alpha` > 0, and the ends of the trap; `None` outside traps.
    pub(crate) fn trap(&self, alpha: f64) -> Option<(KnownFate, (f64, f64))> {
        match self.traps.find(alpha) {
            Lookup::Trap(n, ends) => Some((fate_in_trap(n), ends)),
            Lookup::NoTrap => None,
            // The ends are unknown. NaN keeps the itinerary from agreeing with others: an orbit next to this one
            // may lie outside the trap.
            Lookup::NotIndexed => {
                let label = self.fates.label(alpha)?;
                Some((KnownFate { itinerary: Itinerary::START, label }, (f64::NAN, f64::NAN)))
            }
        }
    }

    /// The traps of the index as intervals of known fate.
    pub(crate) fn known_traps(&self) -> impl Iterator<Item = (KnownFate, (f64, f64))> {
        self.traps.ends().map(|(n, ends)| (fate_in_trap(n), ends))
    }

    /// Notes that the orbit of speed `at` has ended.
    pub(crate) fn finish(&mut self, at: usize, itinerary: Itinerary) {
        self.itineraries[at] = Some(itinerary);
    }

    /// Looks at the gap between two speeds. If the itineraries of both are complete and agree, labels all speeds in the
    /// gap. If they disagree, returns the middle speed, which is to be followed next, unless the two are neighbours.
    pub(crate) fn close_gap(&mut self, left: usize, right: usize) -> Option<usize> {
        let (first, second) = (self.itineraries[left]?, self.itineraries[right]?);
        if first.agrees_with(&second) {
            let label = self.labels[left];
            self.labels[left..right].fill(label);
            self.closed[left..right].fill(true);
            return None;
        }
        (right - left >= 2).then(|| left.midpoint(right))
    }

    /// The closed intervals among the speeds of `range`, each as long as possible: the speeds from the first to the
    /// last, which is not included, the common itinerary and the label.
    pub(crate) fn closed_intervals(
        &self,
        range: Range<usize>,
    ) -> Vec<(Range<usize>, Itinerary, u16)> {
        let mut found = Vec::new();
        let mut at = range.start;
        while at < range.end {
            let length = self.closed[at..range.end].iter().take_while(|&&closed| closed).count();
            // Neighbouring closed gaps share a followed speed between them, so that all have one itinerary.
            if let (1.., Some(itinerary)) = (length, self.itineraries[at]) {
                found.push((at..at + length, itinerary, self.labels[at]));
            }
            at += length + 1;
        }
        found
    }
}

fn fate_in_trap(n: u32) -> KnownFate {
    KnownFate { itinerary: Itinerary::in_trap(n), label: n as u16 }
}
