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

/// If a larger part of a gap than this is lost to its curvature, halves are worth it in any case.
const CURVED: f64 = 0.5;

/// An interval of speeds, with F at its ends; `None` if that is open.
#[derive(Debug, Clone, Copy)]
struct Gap {
    speeds: Interval,
    squares: [Option<Enclosure>; 2],
}

/// What is known of a gap.
struct Found {
    /// The least length that each basin has.
    at_least: Vec<f64>,
    /// The length that would stay unknown if all of the image were known.
    lost: f64,
    /// F of the middle speed, if it was found on the way.
    at_middle: Option<Enclosure>,
}

impl Gap {
    fn halves(&self, middle: f64, at_middle: Option<Enclosure>) -> [Gap; 2] {
        let Gap { speeds, squares: [first, last] } = *self;
        [
            Gap { speeds: Interval { right: middle, ..speeds }, squares: [first, at_middle] },
            Gap { speeds: Interval { left: middle, ..speeds }, squares: [at_middle, last] },
        ]
    }

    /// The image of its upper end may lie in the gap.
    fn reaches_itself(&self) -> bool {
        let Interval { left, .. } = self.speeds;
        self.squares[1].is_none_or(|image| image.high > left * left)
    }
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
                let part = self.gap(part);
                self.add(part, self.of_whole_gap(part), goal, MOST_HALVINGS);
                from = end;
            }
        }
    }

    fn gap(&self, speeds: Interval) -> Gap {
        let Interval { left, right } = speeds;
        Gap { speeds, squares: [left, right].map(|speed| self.images.square(speed)) }
    }

    /// Adds a part of a gap, of which `found` is known.
    fn add(&mut self, gap: Gap, found: Found, goal: f64, halvings: usize) {
        let Interval { left, right } = gap.speeds;
        let unknown = |gap: &Gap, found: &Found| gap.speeds.length() - sum(&found.at_least);
        let before = unknown(&gap, &found);
        let middle = left.midpoint(right);
        let divisible = halvings > 0 && left < middle && middle < right;
        let curved = found.lost > CURVED * gap.speeds.length();
        // Next to a fixed point the image reaches into the gap itself, and so does that of the upper half.
        if before > goal && divisible && (curved || !gap.reaches_itself()) {
            let at_middle = found.at_middle.or_else(|| self.images.square(middle));
            let halves = gap.halves(middle, at_middle);
            let of_halves = halves.map(|half| self.of_whole_gap(half));
            let after = unknown(&halves[0], &of_halves[0]) + unknown(&halves[1], &of_halves[1]);
            if curved || after < STALLED * before {
                for (half, found) in halves.into_iter().zip(of_halves) {
                    self.add(half, found, goal, halvings - 1);
                }
                return;
            }
        }
        let known = Known::AtLeast(found.at_least);
        self.segments.push(Segment { interval: gap.speeds, known });
    }

    fn of_whole_gap(&self, gap: Gap) -> Found {
        let mut hops = MOST_HOPS;
        self.of_gap(gap, &mut hops).unwrap_or_else(|| Found {
            at_least: self.nothing(),
            lost: gap.speeds.length(),
            at_middle: None,
        })
    }

    /// What each basin has at least of a gap, from its image; `None` if a decision of the hops is open.
    fn of_gap(&self, gap: Gap, hops: &mut usize) -> Option<Found> {
        let all = Enclosure::new(gap.speeds.left, gap.speeds.right);
        // On one part, and with one number of sudden lift-offs, F is smooth.
        let hop = HopEnclosure::plain(all, Part::of(all)?, self.images.strip())?;
        let steepest = hop.by_speed.magnitude();
        let ends = [gap.squares[0]?, gap.squares[1]?];
        // All values from `low` to `high` are taken.
        let low = ends[0].high.min(ends[1].high);
        let high = ends[0].low.max(ends[1].low);
        if !(low < high && steepest.is_finite()) {
            return None;
        }
        let mut values = self.values_between(low.max(0.0), high, hops);
        if let Some(grounded) = self.labels.iter().position(|&own| own == HopperFate::GROUNDED) {
            let below_zero = distance(low, high.min(0.0));
            values[grounded] = sum(&[values[grounded], below_zero]);
        }
        let length = |value: f64| (Enclosure::from(value) / steepest).low.max(0.0);
        let lost = gap.speeds.length() - length(distance(low, high));
        let at_least = values.into_iter().map(length).collect();
        Some(Found { at_least, lost, at_middle: hop.at_middle })
    }

    /// What each basin has at least of the values of F from `low` ≥ 0 to `high`.
    fn values_between(&self, low: f64, high: f64, hops: &mut usize) -> Vec<f64> {
        let mut sums = vec![Enclosure::ZERO; self.labels.len()];
        let [first, last] = [low, high]
            .map(|value| Enclosure::from(value.max(0.0)).sqrt().unwrap_or(Enclosure::WHOLE));
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
                    sums[basin] = sums[basin]
                        + (Enclosure::from(right).squared() - Enclosure::from(left).squared());
                }
                Known::AtLeast(lengths) => {
                    let inside = Interval { left, right };
                    let own = if inside == *interval {
                        Some(lengths.clone())
                    } else if *hops > 0 {
                        *hops -= 1;
                        self.of_gap(self.gap(inside), hops).map(|found| found.at_least)
                    } else {
                        None
                    };
                    // dF = 2α dα.
                    for (sum, length) in sums.iter_mut().zip(own.into_iter().flatten()) {
                        *sum = *sum + 2.0 * Enclosure::from(left) * length;
                    }
                }
            }
        }
        sums.into_iter().map(|sum| sum.low.max(0.0)).collect()
    }
}
