//! Known arcs of the circle of fates: the part of it that some orbits have shown.
//!
//! All orbits left of α*_n jump to the same turn of the Fatou coordinate, from which each further hop rises with
//! the offset (docs/theory.md, Theorems 81 and 85). If the orbits of two offsets agree from there on, all offsets
//! between them have their fate.

use crate::raster::known_intervals::KnownFate;

/// A point of an orbit left of a fixed point.
#[derive(Debug, Clone, Copy)]
struct Point {
    /// All offsets at which it may be.
    offsets: (f64, f64),
    /// What the orbit does from there on.
    known: KnownFate,
}

/// Points of followed orbits, in increasing order of their offsets.
#[derive(Debug, Clone, Default)]
pub(crate) struct Arcs {
    points: Vec<Point>,
}

/// What is known of some offsets.
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
    /// What is known of the offsets within `error` of `offset`.
    pub(crate) fn find(&self, offset: f64, error: f64) -> Arc {
        let around = self.around(offset, error);
        let agree = |pair: &[Point]| pair[0].known.itinerary.agrees_with(&pair[1].known.itinerary);
        match (around.windows(2).find(|pair| !agree(pair)), around) {
            (Some(pair), _) => Arc::Open(pair[0].offsets.1, pair[1].offsets.0),
            // Without an error an offset may be a point, which has its own fate.
            (None, [point, ..]) => Arc::Known(point.known),
            (None, []) => Arc::Outside,
        }
    }

    /// The points from the last one that is at or below all offsets within `error` of `offset` to the first one at
    /// or above them; none if there is no such pair.
    fn around(&self, offset: f64, error: f64) -> &[Point] {
        let (least, most) = (offset - error, offset + error);
        // As points may overlap, those next to the place found by one end are tried. Few points lie within an error.
        let mut first = self.points.partition_point(|point| point.offsets.1 <= least);
        while first > 0 && !(self.points[first - 1].offsets.1 <= least) {
            first -= 1;
        }
        let mut last = first;
        while last < self.points.len() && !(self.points[last].offsets.0 >= most) {
            last += 1;
        }
        let around = first.checked_sub(1).and_then(|first| self.points.get(first..=last));
        around.unwrap_or_default()
    }

    /// Adds the two points of `other` around the offsets within `error` of `offset`, if it has them and the points
    /// here are farther away.
    pub(crate) fn add_around(&mut self, other: &Arcs, offset: f64, error: f64) {
        let outer = |points: &[Point]| Some((*points.first()?, *points.last()?));
        let Some((left, right)) = outer(other.around(offset, error)) else { return };
        let here = outer(self.around(offset, error));
        if here.is_none_or(|(first, _)| first.offsets.1 < left.offsets.1) {
            self.insert(left);
        }
        if here.is_none_or(|(_, last)| last.offsets.0 > right.offsets.0) {
            self.insert(right);
        }
    }

    /// The fate of the offsets within `error` of `offset`, if it is known.
    pub(crate) fn known(&self, offset: f64, error: f64) -> Option<KnownFate> {
        match self.find(offset, error) {
            Arc::Known(known) => Some(known),
            Arc::Open(..) | Arc::Outside => None,
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Adds a point of an orbit that is within `error` of `offset`.
    pub(crate) fn add(&mut self, (offset, error): (f64, f64), known: KnownFate) {
        self.insert(Point { offsets: (offset - error, offset + error), known });
    }

    fn insert(&mut self, point: Point) {
        let at = self.points.partition_point(|other| other.offsets.0 < point.offsets.0);
        self.points.insert(at, point);
    }

    /// The arcs that these points show. Points that agree with both of their neighbours are left out: the same is
    /// known without them.
    pub(crate) fn from_points(points: Vec<((f64, f64), KnownFate)>) -> Self {
        let point =
            |((offset, error), known)| Point { offsets: (offset - error, offset + error), known };
        let mut all: Vec<Point> = points.into_iter().map(point).collect();
        all.sort_by(|a, b| a.offsets.0.total_cmp(&b.offsets.0));
        let mut kept: Vec<Point> = Vec::new();
        for (at, point) in all.iter().enumerate() {
            let next = all.get(at + 1);
            let same = |other: Option<&Point>| {
                other.is_some_and(|other| other.known.itinerary.agrees_with(&point.known.itinerary))
            };
            if !(same(kept.last()) && same(next)) {
                kept.push(*point);
            }
        }
        Arcs { points: kept }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fates::hopper_fate::HopperFate;
    use crate::raster::itinerary::Itinerary;

    fn known(n: u32) -> KnownFate {
        KnownFate {
            itinerary: Itinerary::in_trap(n),
            label: HopperFate::label_of_fixed_point(n.into()),
        }
    }

    #[test]
    fn only_offsets_between_agreeing_orbits_are_known() {
        let mut arcs = Arcs::default();
        assert_eq!(arcs.find(0.3, 0.0), Arc::Outside);
        let points = [(0.4, 1), (0.2, 1), (0.6, 0), (0.3, 1)].map(|(x, n)| ((x, 0.0), known(n)));
        for (at, known) in points {
            arcs.add(at, known);
        }
        for (arcs, count) in [(arcs, 4), (Arcs::from_points(points.to_vec()), 3)] {
            assert_eq!(arcs.find(0.3, 0.05), Arc::Known(known(1)));
            assert_eq!(arcs.find(0.3, 0.1 - 1e-15), Arc::Known(known(1)));
            assert_eq!(arcs.find(0.35, 0.1), Arc::Open(0.4, 0.6));
            assert_eq!(arcs.find(0.5, 0.0), Arc::Open(0.4, 0.6));
            for offset in [0.1, 0.7, f64::NAN] {
                assert_eq!(arcs.find(offset, 0.0), Arc::Outside);
            }
            assert_eq!(arcs.points.len(), count);
        }
    }

    #[test]
    fn offsets_within_the_error_of_a_point_are_open() {
        let mut arcs = Arcs::default();
        for (offset, error, n) in [(0.2, 0.01, 1), (0.4, 0.05, 1), (0.43, 0.001, 1), (0.6, 0.1, 0)]
        {
            arcs.add((offset, error), known(n));
        }
        assert_eq!(arcs.find(0.3, 0.08), Arc::Known(known(1)));
        assert_eq!(arcs.find(0.20, 0.0), Arc::Outside);
        assert_eq!(arcs.find(0.4, 0.0), Arc::Known(known(1)));
        // Right of 0.431 and left of 0.45 the orbit of 0.4 may be on either side.
        assert_eq!(arcs.find(0.44, 0.0), Arc::Open(0.431, 0.5));
        assert_eq!(arcs.find(0.55, 0.0), Arc::Outside);
    }
}
