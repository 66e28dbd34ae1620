//! Known arcs of the circle of fates: the part of it that some orbits have shown.
//!
//! All orbits left of α*_n jump to the same turn of the Fatou coordinate, from which each further hop rises with the phase
//! (docs/theory.md, Theorems 81 and 85). If the orbits of two phases agree from there on, all phases between them have their
//! fate.

use crate::raster::itinerary::Itinerary;
use crate::raster::known_intervals::KnownFate;
use basin_of_attraction::Label;

/// The phases of followed orbits, in increasing order, with what the orbits did after their jump.
#[derive(Debug, Default)]
pub(crate) struct Arcs {
    points: Vec<(f64, KnownFate)>,
}

/// What is known of some phases.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Arc {
    /// All of them have this fate.
    Known(KnownFate),
    /// They reach into the gap between these two, whose orbits do not agree.
    Open(f64, f64),
    /// They reach beyond all points.
    Outside,
}

impl Arcs {
    /// What is known of the phases within `error` of `phase`.
    pub(crate) fn find(&self, phase: f64, error: f64) -> Arc {
        let (least, most) = (phase - error, phase + error);
        // The last point at or below all of them, and the first one at or above them.
        let first = self.points.partition_point(|point| point.0 <= least);
        let last = self.points.partition_point(|point| point.0 < most);
        let Some(around) = first.checked_sub(1).and_then(|first| self.points.get(first..=last))
        else {
            return Arc::Outside;
        };
        let open =
            around.windows(2).find(|pair| !pair[0].1.itinerary.agrees_with(&pair[1].1.itinerary));
        match (open, around) {
            (Some(pair), _) => Arc::Open(pair[0].0, pair[1].0),
            // Without an error a phase may be a point, which has its own fate.
            (None, [(_, known), ..]) => Arc::Known(*known),
            (None, []) => Arc::Outside,
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Adds the orbit of a phase.
    pub(crate) fn add(&mut self, phase: f64, itinerary: Itinerary, label: Label) {
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
        assert_eq!(arcs.find(0.3, 0.0), Arc::Outside);
        let (first, second) = (Itinerary::in_trap(1), Itinerary::in_trap(0));
        for (phase, itinerary, label) in
            [(0.4, first, 1), (0.2, first, 1), (0.6, second, 0), (0.3, first, 1)]
        {
            arcs.add(phase, itinerary, Label::from(label));
        }
        let known = Arc::Known(KnownFate { itinerary: first, label: Label::from(1) });
        assert_eq!(arcs.find(0.3, 0.05), known);
        assert_eq!(arcs.find(0.3, 0.1 - 1e-15), known);
        assert_eq!(arcs.find(0.35, 0.1), Arc::Open(0.4, 0.6));
        assert_eq!(arcs.find(0.5, 0.0), Arc::Open(0.4, 0.6));
        for phase in [0.1, 0.7, f64::NAN] {
            assert_eq!(arcs.find(phase, 0.0), Arc::Outside);
        }
    }
}
