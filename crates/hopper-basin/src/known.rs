//! Intervals of known fate at one mass ratio, and where to look for them.

use crate::Fates;
use crate::ladder::Ladder;
use std::ops::Range;

/// An interval all of whose orbits visit the same arcs and enter the same trap, or are grounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Known {
    /// The label of their fate.
    pub(crate) label: u16,
    /// The trap, or the ground.
    pub(crate) end: u32,
    /// The arcs on the way there, as an [`Itinerary`](crate::itinerary::Itinerary) has them.
    pub(crate) arcs: u64,
    /// The ends of the interval.
    pub(crate) between: (f64, f64),
}

impl Known {
    /// What holds nothing.
    pub(crate) const NOTHING: Known =
        Known { label: 0, end: 0, arcs: 1, between: (f64::INFINITY, f64::NEG_INFINITY) };

    #[inline]
    fn holds(&self, alpha: f64) -> bool {
        (alpha >= self.between.0) & (alpha <= self.between.1)
    }
}

/// Traps, and intervals between neighbouring speeds of a column.
pub(crate) struct Intervals {
    ladder: Ladder,
    /// Which interval of `known` begins below the next speed and ends above this one, for every speed.
    which: Vec<u32>,
    known: Vec<Known>,
}

/// Which speed of a column is just below another: a guess for equal spacing, on two parts.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Spacing {
    /// Where the second part begins, and the number of speeds before.
    split: (f64, usize),
    densities: (f64, f64),
}

impl Spacing {
    /// Of `speeds`, the first `count` of which are the first part.
    pub(crate) fn of(speeds: &[f64], count: usize) -> Self {
        let part = |speeds: &[f64]| match (speeds.first(), speeds.last()) {
            (Some(first), Some(last)) if last > first => (speeds.len() - 1) as f64 / (last - first),
            _ => 0.0,
        };
        let (lower, upper) = speeds.split_at(count.min(speeds.len()));
        let split = upper.first().copied().unwrap_or(f64::INFINITY);
        Spacing { split: (split, lower.len()), densities: (part(lower), part(upper)) }
    }

    #[inline]
    fn below(&self, alpha: f64) -> usize {
        let (split, count) = self.split;
        if alpha < split {
            // The first part begins at half a spacing from zero.
            (alpha * self.densities.0 - 0.5) as usize
        } else {
            count + ((alpha - split) * self.densities.1) as usize
        }
    }
}

impl Intervals {
    /// The traps of `ladder`, in a column with these speeds.
    pub(crate) fn new(ladder: Ladder, speeds: &[f64]) -> Self {
        let mut known = vec![Known::NOTHING];
        let mut which = vec![0; speeds.len()];
        for trap in ladder.traps() {
            let (left, right) = trap.between;
            let first = speeds.partition_point(|&speed| speed < left).saturating_sub(1);
            let end = speeds.partition_point(|&speed| speed <= right);
            which[first.min(end)..end].fill(known.len() as u32);
            known.push(trap);
        }
        Intervals { ladder, which, known }
    }

    /// The interval that holds `alpha` > 0. All that lies in a trap is found.
    #[inline]
    pub(crate) fn at(&self, alpha: f64, spacing: &Spacing, fates: &Fates) -> Option<Known> {
        let which = self.which.get(spacing.below(alpha)).copied().unwrap_or(0);
        match self.known.get(which as usize) {
            Some(known) if known.holds(alpha) => Some(*known),
            _ => self.ladder.trap(alpha, fates),
        }
    }

    /// Adds the interval between the speeds of `range` and the next one after it.
    pub(crate) fn add(&mut self, range: Range<usize>, known: Known) {
        self.which[range].fill(self.known.len() as u32);
        self.known.push(known);
    }
}
