//! Intervals of speeds with a known fate, and a table in which to find them.

use crate::raster::itinerary::Itinerary;
use basin_of_attraction::Label;
use std::ops::Range;

/// The fate of all speeds of an interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct KnownFate {
    /// The itinerary that all orbits from the interval share.
    pub(crate) itinerary: Itinerary,
    /// The label of their fate.
    pub(crate) label: Label,
}

/// The intervals of known fate of several columns, all with the same speeds. An interval is a trap, or lies between two
/// speeds of a column whose itineraries agree (invariant KNOWN).
pub(crate) struct KnownIntervals {
    speed_index: SpeedIndex,
    /// The number of speeds.
    count: usize,
    /// For every column and every speed, the number of an interval that may contain speeds between this one and the
    /// next. A later interval replaces an earlier one, so that `find` does not find all intervals. A missed interval
    /// costs time and changes no label.
    which: Vec<u32>,
    /// The ends of the intervals, by number.
    ends: Vec<(f64, f64)>,
    /// The fates of the intervals, by number.
    fates: Vec<KnownFate>,
}

/// The number of the empty interval, which is the first.
pub(crate) const NO_INTERVAL: u32 = 0;

/// Guesses which speed of a column is the largest one below a given speed.
///
/// The guess is right if the speeds are equally spaced, as in a raster. Elsewhere it may be wrong; `find` then
/// misses the interval. The speeds have two parts, each with its own spacing.
#[derive(Debug, Clone, Copy)]
struct SpeedIndex {
    /// The first speed of the upper part.
    split: f64,
    /// Factor and constant of the index as a linear function of the speed, on the lower and the upper part.
    lower: (f64, f64),
    upper: (f64, f64),
    /// The largest index.
    last: f64,
}

impl SpeedIndex {
    /// The index for `speeds`. The first `count` speeds are the lower part, which begins at half a spacing.
    fn new(speeds: &[f64], count: usize) -> Self {
        let density = |speeds: &[f64]| match (speeds.first(), speeds.last()) {
            (Some(first), Some(last)) if last > first => (speeds.len() - 1) as f64 / (last - first),
            // Fewer than two different speeds have no spacing: all indices are the same.
            _ => 0.0,
        };
        let (lower, upper) = speeds.split_at(count.min(speeds.len()));
        let split = upper.first().copied().unwrap_or(f64::INFINITY);
        let (below, above) = (density(lower), density(upper));
        let last = speeds.len().saturating_sub(1) as f64;
        // The lower part is (k + ½) times its spacing, k = 0, 1, …
        SpeedIndex {
            split,
            lower: (below, -0.5),
            upper: (above, count as f64 - above * split),
            last,
        }
    }

    /// Always a valid index; meaningless for NaN.
    #[inline]
    fn below(&self, alpha: f64) -> usize {
        let (factor, constant) = if alpha < self.split { self.lower } else { self.upper };
        // The conversion maps negative numbers to 0.
        (alpha * factor + constant).min(self.last) as u32 as usize
    }
}

impl KnownIntervals {
    /// No intervals yet, for `columns` columns of `speeds`, of which the first `lower` are the lower part.
    pub(crate) fn new(columns: usize, speeds: &[f64], lower: usize) -> Self {
        let unused = KnownFate { itinerary: Itinerary::START, label: Label::UNDECIDED };
        KnownIntervals {
            speed_index: SpeedIndex::new(speeds, lower),
            count: speeds.len(),
            which: vec![NO_INTERVAL; columns * speeds.len()],
            // The empty interval contains no number, so that `find` needs no branch for it.
            ends: vec![(f64::INFINITY, f64::NEG_INFINITY)],
            fates: vec![unused],
        }
    }

    /// The number of an interval of `column` that contains `alpha`, or [`NO_INTERVAL`]. The look-up may miss an
    /// interval, but never returns a wrong one.
    #[inline]
    pub(crate) fn find(&self, column: usize, alpha: f64) -> u32 {
        let slot = column * self.count + self.speed_index.below(alpha);
        let which = self.which.get(slot).copied().unwrap_or(NO_INTERVAL);
        let (left, right) = self.ends.get(which as usize).copied().unwrap_or_default();
        if (alpha >= left) & (alpha <= right) { which } else { NO_INTERVAL }
    }

    /// The fate and the ends of an interval.
    #[inline]
    pub(crate) fn get(&self, which: u32) -> (KnownFate, (f64, f64)) {
        (self.fates[which as usize], self.ends[which as usize])
    }

    /// Adds an interval. `find` finds it from the first speed of `range` up to the speed after the last one.
    pub(crate) fn add(
        &mut self,
        column: usize,
        range: Range<usize>,
        fate: KnownFate,
        ends: (f64, f64),
    ) {
        let base = column * self.count;
        self.which[base + range.start..base + range.end].fill(self.fates.len() as u32);
        self.ends.push(ends);
        self.fates.push(fate);
    }

    /// Adds an interval whose ends need not be speeds of the column.
    pub(crate) fn add_between(
        &mut self,
        column: usize,
        speeds: &[f64],
        fate: KnownFate,
        ends: (f64, f64),
    ) {
        // From the last speed below the interval to the last speed in the interval. An interval above all speeds gets
        // no entry.
        let first = speeds.partition_point(|&speed| speed < ends.0).saturating_sub(1);
        let end = speeds.partition_point(|&speed| speed <= ends.1);
        self.add(column, first.min(end)..end, fate, ends);
    }
}
