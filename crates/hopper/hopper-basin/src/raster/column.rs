//! One column of a raster: increasing speeds at one mass ratio, their labels and their itineraries.

use crate::error::Error;
use crate::fates::fates_at_mass_ratio::Fates;
use crate::fates::hopper_fate::HopperFate;
use crate::fates::slow_sides::SlowZones;
use crate::raster::arcs::Arcs;
use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::KnownFate;
use crate::raster::laps::Laps;
use crate::raster::rising_windows::trap_with_window;
use crate::traps::trap_index::{Lookup, TrapIndex};
use basin_of_attraction::{Label, Traps};
use passive_hopper::index_below;
use std::ops::Range;

/// The number of fixed points on whose slow sides the orbits of a raster jump. Others are followed, or labelled alone.
const SLOW_SIDES: u64 = 64;

/// The labels and itineraries of a column.
pub(crate) struct Column<'a> {
    pub(crate) fates: &'a Fates,
    pub(crate) traps: TrapIndex,
    /// The laps of the map; `None` for mass ratios without laps.
    pub(crate) laps: Option<Laps>,
    pub(crate) labels: Vec<Label>,
    /// The itineraries of the speeds whose orbits have ended; `None` for all other speeds.
    itineraries: Vec<Option<Itinerary>>,
    /// For every speed, whether the gap up to the next speed is closed: all speeds in a closed gap have the fate of
    /// both.
    closed: Vec<bool>,
    pub(crate) zones: SlowZones,
    /// The known arcs of the circles of α*_1, α*_2, …
    pub(crate) arcs: Vec<Arcs>,
    /// The number of orbits that came to a slow side, too far for a jump.
    pub(crate) walkers: usize,
    /// The number of searches for starts that fall onto a fixed point that found none.
    pub(crate) missed_edges: usize,
}

impl<'a> Column<'a> {
    /// A column without labels.
    pub(crate) fn new(fates: &'a Fates, speeds: &[f64]) -> Result<Self, Error> {
        let largest = speeds.last().copied().unwrap_or(0.0);
        let slow_sides = (index_below(largest)? + 1).min(SLOW_SIDES);
        Ok(Column {
            fates,
            traps: TrapIndex::new(largest, |n| trap_with_window(fates, n))?,
            laps: Laps::below(fates.map().mass_ratio(), largest)?,
            labels: vec![HopperFate::UNDECIDED; speeds.len()],
            itineraries: vec![None; speeds.len()],
            closed: vec![false; speeds.len()],
            zones: SlowZones::new(fates.map().mass_ratio(), slow_sides),
            arcs: Vec::new(),
            walkers: 0,
            missed_edges: 0,
        })
    }

    /// The fate of the trap that contains `alpha` > 0, and the ends of the trap; `None` outside traps.
    pub(crate) fn trap(&self, alpha: f64) -> Option<(KnownFate, (f64, f64))> {
        match self.traps.find(alpha) {
            Lookup::Trap(n, ends) => Some((fate_in_trap(n), ends)),
            Lookup::NoTrap => None,
            // The ends are unknown. With ends of NaN the itinerary agrees with no other: an orbit next to this one may
            // lie outside the trap.
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

    /// Whether the speeds next to α*_n, on its left, have a lap.
    pub(crate) fn has_lap_below(&self, n: u64) -> bool {
        self.laps.as_ref().is_some_and(|laps| laps.has_lap_below(n))
    }

    /// The known arcs of the circle of α*_n, n ≥ 1.
    pub(crate) fn arcs(&mut self, n: u64) -> &mut Arcs {
        let n = n as usize;
        if self.arcs.len() <= n {
            self.arcs.resize_with(n + 1, Arcs::default);
        }
        &mut self.arcs[n]
    }

    /// Stores the itinerary of the speed with index `at`, whose orbit has ended.
    pub(crate) fn finish(&mut self, at: usize, itinerary: Itinerary) {
        self.itineraries[at] = Some(itinerary);
    }

    /// Closes the gap between two speeds if the itineraries of both are complete and agree: all speeds in the gap get
    /// their label. If the itineraries disagree, returns the middle speed, which is to be followed next, unless the two
    /// speeds are neighbours.
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

    /// The closed intervals among the speeds of `range`, each as long as possible: its speeds without the last one, the
    /// common itinerary, and the label.
    pub(crate) fn closed_intervals(
        &self,
        range: Range<usize>,
    ) -> Vec<(Range<usize>, Itinerary, Label)> {
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
    KnownFate {
        itinerary: Itinerary::in_trap(n),
        label: HopperFate::label_of_fixed_point(n.into()),
    }
}
