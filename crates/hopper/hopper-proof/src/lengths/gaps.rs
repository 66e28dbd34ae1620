//! Gaps between the intervals of a line: what the basins have of them, from their images.

use crate::fixed_points::fixed_point;
use crate::hop::hop_enclosure::{HopEnclosure, Reached};
use crate::hop::part::SpeedPart;
use crate::lengths::basin_lengths::{BasinLengths, Known, Segment, distance, sum};
use basin_of_attraction::Interval;
use hopper_basin::HopperFate;
use interval_arithmetic::{Enclosure, PI};
use passive_hopper::index_below;

/// Most hops for a gap. Where an image ends inside of a lower gap, the part of that gap has an image of its own,
/// and so on; nothing is known of what is left after so many hops.
const MOST_HOPS: usize = 32;

/// Most halvings of a gap: to an ulp.
const MOST_HALVINGS: usize = 48;

/// Halves that leave more than this part of what was unknown are not worth it: what is unknown lies below. It
/// affects the time, and what stays unknown.
const STALLED: f64 = 0.8;

/// If a larger part of a gap than this is lost to its curvature, halves are worth it in any case.
const CURVED: f64 = 0.5;

/// An interval of speeds, with where the hops from its ends lead; `None` if that is open.
#[derive(Debug, Clone, Copy)]
struct Gap {
    speeds: Interval,
    ends: [Option<Reached>; 2],
}

/// Values of F that a gap takes for certain.
struct Values {
    /// Their roots.
    speeds: Interval,
    /// The length of those below 0.
    below_zero: f64,
}

impl Values {
    /// Their length.
    fn length(&self) -> f64 {
        sum(&[between_squares(self.speeds).low(), self.below_zero])
    }
}

/// The length from the square of the left end to that of the right one.
fn between_squares(Interval { left, right }: Interval) -> Enclosure {
    (Enclosure::from(right) - left) * (Enclosure::from(right) + left)
}

/// What is known of a gap.
struct GapLengths {
    /// The least length that each basin has.
    at_least: Vec<f64>,
    /// The length that would stay unknown if all of the image were known.
    lost: f64,
    /// Where the hop from the middle speed leads, if it was found on the way.
    at_middle: Option<Reached>,
}

impl Gap {
    fn halves(&self, middle: f64, at_middle: Option<Reached>) -> [Gap; 2] {
        let Gap { speeds, ends: [first, last] } = *self;
        [
            Gap { speeds: Interval { right: middle, ..speeds }, ends: [first, at_middle] },
            Gap { speeds: Interval { left: middle, ..speeds }, ends: [at_middle, last] },
        ]
    }

    /// The image of its upper end may lie in the gap.
    fn reaches_itself(&self) -> bool {
        let Interval { left, .. } = self.speeds;
        self.ends[1].is_none_or(|end| end.square.high() > left * left)
    }

    /// Values between those at the ends; `None` if these are open.
    fn values(&self) -> Option<Values> {
        let ends = [self.ends[0]?, self.ends[1]?];
        let speeds = [ends[0].speed(self.speeds.left)?, ends[1].speed(self.speeds.right)?];
        // All values from `left` to `right`, and from `low` to 0, are taken.
        let left = speeds[0].high().min(speeds[1].high());
        let right = speeds[0].low().max(speeds[1].low()).max(left);
        let low = ends[0].square.high().min(ends[1].square.high());
        let high = ends[0].square.low().max(ends[1].square.low());
        let below_zero = distance(low, high.min(0.0));
        (left < right || below_zero > 0.0)
            .then_some(Values { speeds: Interval { left, right }, below_zero })
    }
}

impl BasinLengths<'_> {
    /// Adds a gap, divided at a multiple of π and at a fixed point, where the formulas of a hop change.
    pub(super) fn add_gap(&mut self, gap: Interval, goal: f64) {
        let joint = PI * (gap.right / std::f64::consts::PI).floor();
        let star = fixed_point(index_below(gap.left).map_or(0, |n| n + 1));
        let mut ends = [joint.low(), joint.high(), star.low(), star.high(), gap.right];
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
        Gap { speeds, ends: [left, right].map(|speed| self.images.reached(speed)) }
    }

    /// Adds a part of a gap, of which `found` is known.
    fn add(&mut self, gap: Gap, found: GapLengths, goal: f64, halvings: usize) {
        let Interval { left, right } = gap.speeds;
        let unknown = |gap: &Gap, found: &GapLengths| gap.speeds.length() - sum(&found.at_least);
        let before = unknown(&gap, &found);
        let middle = left.midpoint(right);
        let divisible = halvings > 0 && left < middle && middle < right;
        let curved = found.lost > CURVED * gap.speeds.length();
        // Next to a fixed point the image reaches into the gap itself, and so does that of the upper half.
        if before > goal && divisible && (curved || !gap.reaches_itself()) {
            let at_middle = found.at_middle.or_else(|| self.images.reached(middle));
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

    fn of_whole_gap(&self, gap: Gap) -> GapLengths {
        let mut hops = MOST_HOPS;
        self.of_gap(gap, &mut hops).unwrap_or_else(|| GapLengths {
            at_least: self.nothing(),
            lost: gap.speeds.length(),
            at_middle: None,
        })
    }

    /// What each basin has at least of a gap, from its image; `None` if a decision of the hops is open.
    fn of_gap(&self, gap: Gap, hops: &mut usize) -> Option<GapLengths> {
        let all = Enclosure::new(gap.speeds.left, gap.speeds.right);
        // On one part, and with one number of sudden lift-offs, F is smooth.
        let hop = HopEnclosure::plain(all, SpeedPart::of(all)?, self.images.strip())?;
        let steepest = hop.by_speed.magnitude();
        let values = gap.values().filter(|_| steepest.is_finite())?;
        let mut own = self.values_between(values.speeds, hops);
        if let Some(grounded) = self.labels.iter().position(|&own| own == HopperFate::GROUNDED) {
            own[grounded] = sum(&[own[grounded], values.below_zero]);
        }
        let length = |value: f64| (Enclosure::from(value) / steepest).low().max(0.0);
        let lost = gap.speeds.length() - length(values.length());
        let at_least = own.into_iter().map(length).collect();
        Some(GapLengths { at_least, lost, at_middle: hop.at_middle })
    }

    /// What each basin has at least of the values of F between the squares of two speeds.
    fn values_between(&self, speeds: Interval, hops: &mut usize) -> Vec<f64> {
        let mut sums = vec![Enclosure::ZERO; self.labels.len()];
        for Segment { interval, known } in self.segments_from(speeds.left) {
            if interval.left >= speeds.right {
                break;
            }
            let left = interval.left.max(speeds.left);
            let right = interval.right.min(speeds.right);
            if left >= right {
                continue;
            }
            let inside = Interval { left, right };
            match known {
                &Known::Whole(basin) => {
                    sums[basin] = sums[basin] + between_squares(inside);
                }
                Known::AtLeast(lengths) => {
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
        sums.into_iter().map(|sum| sum.low().max(0.0)).collect()
    }
}
