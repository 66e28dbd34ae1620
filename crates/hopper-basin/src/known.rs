//! Intervals of known fate, and where to look for them.

use crate::itinerary::Itinerary;
use std::ops::Range;

/// The fate of an interval all of whose orbits visit the same arcs and enter the same trap, or are grounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Known {
    /// What the orbits have in common.
    pub(crate) itinerary: Itinerary,
    /// The label of their fate.
    pub(crate) label: u16,
}

/// Intervals of known fate of several columns with the same speeds: between neighbouring speeds, and traps.
pub(crate) struct Intervals {
    spacing: Spacing,
    /// Number of speeds.
    count: usize,
    /// For every column and speed an interval that may hold what is between this speed and the next.
    which: Vec<u32>,
    between: Vec<(f64, f64)>,
    known: Vec<Known>,
}

/// The interval that holds nothing.
pub(crate) const NOWHERE: u32 = 0;

/// Which speed of a column is just below another: a guess for equal spacing, on two parts.
#[derive(Debug, Clone, Copy)]
struct Spacing {
    /// Where the second part begins.
    split: f64,
    /// Index at a speed: factor and constant, on both parts.
    lower: (f64, f64),
    upper: (f64, f64),
    last: f64,
}

impl Spacing {
    /// Of `speeds`, the first `count` of which are the first part, from half a spacing up.
    fn of(speeds: &[f64], count: usize) -> Self {
        let density = |speeds: &[f64]| match (speeds.first(), speeds.last()) {
            (Some(first), Some(last)) if last > first => (speeds.len() - 1) as f64 / (last - first),
            _ => 0.0,
        };
        let (lower, upper) = speeds.split_at(count.min(speeds.len()));
        let split = upper.first().copied().unwrap_or(f64::INFINITY);
        let (below, above) = (density(lower), density(upper));
        let last = speeds.len().saturating_sub(1) as f64;
        Spacing { split, lower: (below, -0.5), upper: (above, count as f64 - above * split), last }
    }

    /// An index, whatever `alpha` is; no guess at all for no number.
    #[inline]
    fn below(&self, alpha: f64) -> usize {
        let (factor, constant) = if alpha < self.split { self.lower } else { self.upper };
        (alpha * factor + constant).min(self.last) as u32 as usize
    }
}

impl Intervals {
    /// None yet, for `columns` columns of `speeds`, the first `lower` of which are spaced in another way.
    pub(crate) fn new(columns: usize, speeds: &[f64], lower: usize) -> Self {
        let nothing = Known { itinerary: Itinerary::START, label: 0 };
        Intervals {
            spacing: Spacing::of(speeds, lower),
            count: speeds.len(),
            which: vec![NOWHERE; columns * speeds.len()],
            between: vec![(f64::INFINITY, f64::NEG_INFINITY)],
            known: vec![nothing],
        }
    }

    /// The interval of a column that holds `alpha`; of those it can not see all.
    #[inline]
    pub(crate) fn at(&self, column: usize, alpha: f64) -> u32 {
        let slot = column * self.count + self.spacing.below(alpha);
        let which = self.which.get(slot).copied().unwrap_or(NOWHERE);
        let (left, right) = self.between.get(which as usize).copied().unwrap_or_default();
        if (alpha >= left) & (alpha <= right) { which } else { NOWHERE }
    }

    /// An interval and its ends.
    #[inline]
    pub(crate) fn get(&self, which: u32) -> (Known, (f64, f64)) {
        (self.known[which as usize], self.between[which as usize])
    }

    /// Adds an interval, to be looked for between the speeds of `range` and the next one after it.
    pub(crate) fn add(
        &mut self,
        column: usize,
        range: Range<usize>,
        known: Known,
        between: (f64, f64),
    ) {
        let base = column * self.count;
        self.which[base + range.start..base + range.end].fill(self.known.len() as u32);
        self.between.push(between);
        self.known.push(known);
    }

    /// Adds an interval, to be looked for among `speeds` wherever it is.
    pub(crate) fn add_anywhere(
        &mut self,
        column: usize,
        speeds: &[f64],
        known: Known,
        between: (f64, f64),
    ) {
        let first = speeds.partition_point(|&speed| speed < between.0).saturating_sub(1);
        let end = speeds.partition_point(|&speed| speed <= between.1);
        self.add(column, first.min(end)..end, known, between);
    }
}
