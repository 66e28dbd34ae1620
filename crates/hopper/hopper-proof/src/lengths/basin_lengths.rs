//! A line of speeds in segments, each with what every basin has of it at least.

use crate::certificate::BasinGap;
use crate::hop::proved_images::ProvedImages;
use crate::line::ProvedLine;
use basin_of_attraction::{Interval, Label};
use interval_arithmetic::Enclosure;

/// An interval of speeds, and what the basins have of it.
#[derive(Debug, Clone)]
pub(super) struct Segment {
    pub(super) interval: Interval,
    pub(super) known: Known,
}

/// What the basins have of an interval.
#[derive(Debug, Clone)]
pub(super) enum Known {
    /// All of it belongs to the basin with this number in the list of labels.
    Whole(usize),
    /// The least length that each basin of the list has.
    AtLeast(Vec<f64>),
}

/// Lower bounds of the length that each basin has of any interval of a line.
#[derive(Debug, Clone)]
pub(crate) struct BasinLengths<'a> {
    pub(super) images: &'a ProvedImages,
    pub(super) labels: &'a [Label],
    /// From 0 up, without gaps.
    pub(super) segments: Vec<Segment>,
}

/// The distance from `low` up to `high` at least; 0 if `low` may be above.
pub(super) fn distance(low: f64, high: f64) -> f64 {
    (Enclosure::from(high) - low).low().max(0.0)
}

/// The sum of numbers, at least.
pub(super) fn sum(numbers: &[f64]) -> f64 {
    numbers.iter().fold(Enclosure::ZERO, |sum, &own| sum + own).low().max(0.0)
}

impl<'a> BasinLengths<'a> {
    /// What the basins `labels` have of a line. A gap is divided until no more than `goal` of each part is unknown,
    /// or until that does not help.
    pub(crate) fn new(
        line: &ProvedLine,
        images: &'a ProvedImages,
        labels: &'a [Label],
        goal: f64,
    ) -> Self {
        let mut all = BasinLengths { images, labels, segments: Vec::new() };
        let mut from = 0.0;
        for &(interval, label) in line.intervals() {
            if from < interval.left {
                all.add_gap(Interval { left: from, right: interval.left }, goal);
            }
            let number = labels.iter().position(|&other| other == label);
            let known = number.map_or_else(|| Known::AtLeast(all.nothing()), Known::Whole);
            all.segments.push(Segment { interval, known });
            from = interval.right;
        }
        all
    }

    pub(super) fn nothing(&self) -> Vec<f64> {
        vec![0.0; self.labels.len()]
    }

    /// The segments that end at `low` or above it.
    pub(super) fn segments_from(&self, low: f64) -> &[Segment] {
        &self.segments[self.segments.partition_point(|own| own.interval.right < low)..]
    }

    /// What each basin has at least of the speeds between two.
    pub(crate) fn between(&self, left: f64, right: f64) -> Vec<f64> {
        let mut sums = vec![Enclosure::ZERO; self.labels.len()];
        let mut add = |basin: usize, length: f64| {
            sums[basin] = sums[basin] + length;
        };
        let inside = self.segments_from(left).iter().take_while(|own| own.interval.left < right);
        for Segment { interval, known } in inside {
            match known {
                &Known::Whole(basin) => {
                    add(basin, distance(interval.left.max(left), interval.right.min(right)));
                }
                Known::AtLeast(lengths) if left <= interval.left && interval.right <= right => {
                    lengths.iter().enumerate().for_each(|(basin, &length)| add(basin, length));
                }
                Known::AtLeast(_) => {}
            }
        }
        sums.into_iter().map(|sum| sum.low().max(0.0)).collect()
    }

    /// The gaps of which something is known.
    pub(crate) fn into_gaps(self) -> Vec<BasinGap> {
        let labels = self.labels;
        let gap = |Segment { interval, known }: Segment| match known {
            Known::Whole(_) => None,
            Known::AtLeast(lengths) => {
                let own = labels.iter().copied().zip(lengths);
                let at_least: Vec<(Label, f64)> = own.filter(|&(_, own)| own > 0.0).collect();
                (!at_least.is_empty()).then_some(BasinGap { speeds: interval, at_least })
            }
        };
        self.segments.into_iter().filter_map(gap).collect()
    }
}
