//! Known arcs of the circle of fates: the part of it that the orbits of a column have shown.
//!
//! All orbits left of α*_n jump to the same turn of the Fatou coordinate, on which f^k rises with the phase (docs/theory.md,
//! Theorems 81 and 85). If the orbits of two phases agree from there on, all phases between them have their fate.

use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::KnownFate;

/// The phases of followed orbits, in increasing order, with what the orbits did after their jump.
#[derive(Debug, Default)]
pub(crate) struct Arcs {
    points: Vec<(f64, KnownFate)>,
}

impl Arcs {
    /// The fate of all phases within `error` of `phase`, if two neighbouring orbits around them agree.
    pub(crate) fn find(&self, phase: f64, error: f64) -> Option<KnownFate> {
        let above = self.points.partition_point(|point| point.0 < phase);
        let (right, left) = (self.points.get(above)?, self.points.get(above.checked_sub(1)?)?);
        // A phase that is one of the points has no arc on its left, unless its error is zero; it does not matter.
        let inside = phase - left.0 >= error && right.0 - phase >= error;
        (inside && left.1.itinerary.agrees_with(&right.1.itinerary)).then_some(left.1)
    }

    /// Adds the orbit of a phase.
    pub(crate) fn add(&mut self, phase: f64, itinerary: Itinerary, label: u16) {
        let at = self.points.partition_point(|point| point.0 < phase);
        self.points.insert(at, (phase, KnownFate { itinerary, label }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_phases_between_agreeing_orbits_are_known() {
        let mut arcs = Arcs::default();
        let (first, second) = (Itinerary::in_trap(1), Itinerary::in_trap(0));
        for (phase, itinerary, label) in [(0.4, first, 1), (0.2, first, 1), (0.6, second, 0)] {
            arcs.add(phase, itinerary, label);
        }
        assert_eq!(arcs.find(0.3, 0.05).map(|known| known.label), Some(1));
        assert!(arcs.find(0.3, 0.2).is_none(), "the error reaches beyond the arc");
        assert!(arcs.find(0.5, 0.0).is_none() && arcs.find(0.1, 0.0).is_none());
        assert!(arcs.find(0.7, 0.0).is_none() && arcs.find(f64::NAN, 0.0).is_none());
    }
}
