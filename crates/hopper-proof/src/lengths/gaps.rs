//! Gaps between the intervals of a line: what the basins have of them, from their images.

use crate::fixed_points::fixed_point;
use crate::hop::hop_enclosure::{HopEnclosure, Part};
use crate::lengths::basin_lengths::{BasinLengths, Known, Segment, distance, sum};
use basin_of_attraction::Interval;
use hopper_basin::HopperFate;
use interval_arithmetic::{Enclosure, PI};
use passive_hopper::index_below;

/// Most hops for a gap. Where an image ends inside of a lower gap, the part of that gap has an image of its own, and so on; nothing is known of what
/// is left after so many hops.
const MOST_HOPS: usize = 32;

/// Most halvings of a gap: to an ulp.
const MOST_HALVINGS: usize = 48;

/// Halves that leave more than this part of what was unknown are not worth it: what is unknown lies below. It affects the time, and what stays
/// unknown.
const STALLED: f64 = 0.8;

fn point(value: f64) -> Enclosure {
    Enclosure::new(value, value)
}

impl BasinLengths<'_> {
    /// Adds a gap, divided at a multiple of π and at a fixed point, where the formulas of a hop change.
    pub(super) fn add_gap(&mut self, gap: Interval, goal: f64) {
        let joint = PI * (gap.right / std::f64::consts::PI).floor();
        let star = fixed_point(index_below(gap.left).map_or(0, |n| n + 1));
        let mut ends = [joint.low, joint.high, star.low, star.high, gap.right];
        ends.sort_by(f64::total_cmp);
        let mut from = gap.left;
        for end in ends {
            if from < end && end <= gap.right {
                let part = Interval { left: from, right: end };
                self.add(part, self.of_whole_gap(part), goal, MOST_HALVINGS);
                from = end;
            }
        }
    }

    /// Adds a part of a gap, of which the lengths `found` are known.
    fn add(&mut self, gap: Interval, found: Option<Vec<f64>>, goal: f64, halvings: usize) {
        let unknown = |gap: Interval, found: &Option<Vec<f64>>| {
            gap.length() - found.as_ref().map_or(0.0, |lengths| sum(lengths))
        };
        let before = unknown(gap, &found);
        let middle = gap.left.midpoint(gap.right);
        let divisible = halvings > 0 && gap.left < middle && middle < gap.right;
        // Next to a fixed point the image reaches into the gap itself, and so does that of the upper half.
        if before > goal && divisible && !(found.is_some() && self.reaches_itself(gap)) {
            let halves = [Interval { right: middle, ..gap }, Interval { left: middle, ..gap }];
            let of_halves = halves.map(|half| self.of_whole_gap(half));
            let after = unknown(halves[0], &of_halves[0]) + unknown(halves[1], &of_halves[1]);
            if found.is_none() || after < STALLED * before {
                for (half, found) in halves.into_iter().zip(of_halves) {
                    self.add(half, found, goal, halvings - 1);
                }
                return;
            }
        }
        let known = Known::AtLeast(found.unwrap_or_else(|| self.nothing()));
        self.segments.push(Segment { interval: gap, known });
    }

    fn reaches_itself(&self, gap: Interval) -> bool {
        self.images.square(gap.right).is_none_or(|image| image.high > gap.left * gap.left)
    }

    fn of_whole_gap(&self, gap: Interval) -> Option<Vec<f64>> {
        let mut hops = MOST_HOPS;
        self.of_gap(gap, &mut hops)
    }

    /// What each basin has at least of a gap, from its image; `None` if a decision of the hops is open.
    fn of_gap(&self, gap: Interval, hops: &mut usize) -> Option<Vec<f64>> {
        let all = Enclosure::new(gap.left, gap.right);
        // On one part, and with one number of sudden lift-offs, F is smooth.
        let hop = HopEnclosure::plain(all, Part::of(all)?, self.images.strip())?;
        let steepest = hop.by_speed.magnitude();
        let ends = [self.images.square(gap.left)?, self.images.square(gap.right)?];
        // All values from `low` to `high` are taken.
        let low = ends[0].high.min(ends[1].high);
        let high = ends[0].low.max(ends[1].low);
        if !(low < high && steepest.is_finite()) {
            return Some(self.nothing());
        }
        let mut values = self.values_between(low.max(0.0), high, hops);
        if let Some(grounded) = self.labels.iter().position(|&own| own == HopperFate::GROUNDED) {
            let below_zero = point(distance(low, high.min(0.0)));
            values[grounded] = (point(values[grounded]) + below_zero).low;
        }
        let length = |value: f64| (point(value) / point(steepest)).low.max(0.0);
        Some(values.into_iter().map(length).collect())
    }

    /// What each basin has at least of the values of F from `low` ≥ 0 to `high`.
    fn values_between(&self, low: f64, high: f64, hops: &mut usize) -> Vec<f64> {
        let mut sums = vec![Enclosure::ZERO; self.labels.len()];
        let [first, last] =
            [low, high].map(|value| point(value.max(0.0)).sqrt().unwrap_or(Enclosure::WHOLE));
        for Segment { interval, known } in self.segments_from(first.low) {
            if interval.left >= last.high {
                break;
            }
            // The speeds of the segment whose squares are between the two for certain.
            let left = if interval.left < first.high { first.high } else { interval.left };
            let right = if interval.right > last.low { last.low } else { interval.right };
            if !(left < right) {
                continue;
            }
            match known {
                &Known::Whole(basin) => {
                    sums[basin] = sums[basin] + (point(right).squared() - point(left).squared());
                }
                Known::AtLeast(lengths) => {
                    let inside = Interval { left, right };
                    let own = if inside == *interval {
                        Some(lengths.clone())
                    } else if *hops > 0 {
                        *hops -= 1;
                        self.of_gap(inside, hops)
                    } else {
                        None
                    };
                    // dF = 2α dα.
                    for (sum, length) in sums.iter_mut().zip(own.into_iter().flatten()) {
                        *sum = *sum + 2.0 * point(left) * point(length);
                    }
                }
            }
        }
        sums.into_iter().map(|sum| sum.low.max(0.0)).collect()
    }
}
