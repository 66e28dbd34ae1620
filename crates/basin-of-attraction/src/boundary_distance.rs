//! How far states of the line are from the boundary of their basin.

use crate::bounds::Bounds;
use crate::interval::Interval;
use crate::interval_basins::IntervalBasins;
use crate::label::Label;

/// The distances of a state from the boundary of its basin, on both sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryDistance {
    /// Towards smaller numbers. The upper bound is infinite if no other basin is known there.
    pub below: Bounds,
    /// Towards larger numbers. The upper bound is infinite if no other basin is known there.
    pub above: Bounds,
}

impl BoundaryDistance {
    /// The distance to the nearest point of the boundary.
    pub fn nearest(&self) -> Bounds {
        Bounds {
            lower: self.below.lower.min(self.above.lower),
            upper: self.below.upper.min(self.above.upper),
        }
    }
}

/// A stretch of one basin without a gap, and where its boundary may be.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Stretch {
    interval: Interval,
    label: Label,
    /// The end of the last interval of another basin below; −∞ if there is none.
    other_below: f64,
    /// The beginning of the first interval of another basin above; ∞ if there is none.
    other_above: f64,
}

impl Stretch {
    fn distance(&self, x: f64) -> BoundaryDistance {
        BoundaryDistance {
            below: Bounds { lower: x - self.interval.left, upper: x - self.other_below },
            above: Bounds { lower: self.interval.right - x, upper: self.other_above - x },
        }
    }
}

/// How the distances to the boundary are distributed over a basin.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryDistances {
    /// The stretches of the basin, from left to right.
    stretches: Vec<Stretch>,
    /// Their total length.
    length: f64,
}

impl IntervalBasins {
    /// The distances of a state from the boundary of its basin; `None` if the state is undecided or outside the window.
    ///
    /// Lower bounds count every undecided gap as boundary, and the ends of the window too. Upper bounds go to the next interval of
    /// another basin. A gap of at most `resolution` between two intervals of the same basin is no boundary: it comes from
    /// rounding.
    ///
    /// A shock that is smaller than the nearest distance leaves the state in its basin (minimal fatal shock: L. Halekotte,
    /// U. Feudel, Sci. Rep. 10, 11783, 2020).
    pub fn distance_to_boundary(&self, x: f64, resolution: f64) -> Option<BoundaryDistance> {
        let stretches = stretches(self, resolution);
        let at = stretches.partition_point(|stretch| stretch.interval.right < x);
        let own = stretches.get(at).filter(|stretch| stretch.interval.contains(x));
        own.map(|stretch| stretch.distance(x))
    }

    /// The distances of all states of a basin from its boundary, as [`distance_to_boundary`](Self::distance_to_boundary) gives them for one.
    ///
    /// ```
    /// use basin_of_attraction::{Branch, Interval, Label, Refinement, interval_basins_from_known};
    /// let known = [(0.0, 0.4, 1), (0.4, 0.5, 2), (0.5, 1.0, 1)]
    ///     .map(|(left, right, label): (f64, f64, u8)| (Interval { left: left + 1e-15, right }, label.into()));
    /// let window = Interval::new(0.0, 1.0)?;
    /// let map = |x: f64| Some(x);
    /// let basins = interval_basins_from_known(&map, &known, &[], window, Refinement::default())?;
    /// let distances = basins.distances_to_boundary(Label::from(2), 1e-12);
    /// // The basin is [0.4, 0.5]: half of it is within 0.025 of its ends.
    /// assert!(distances.fraction_within(0.025).is_some_and(|part| (part.middle() - 0.5).abs() < 1e-12));
    /// assert!(distances.largest().is_some_and(|(x, size)| (x - 0.45).abs() < 1e-12 && (size.lower - 0.05).abs() < 1e-12));
    /// # Ok::<(), basin_of_attraction::Error>(())
    /// ```
    pub fn distances_to_boundary(&self, label: Label, resolution: f64) -> BoundaryDistances {
        let own = stretches(self, resolution).into_iter().filter(|stretch| stretch.label == label);
        let stretches: Vec<Stretch> = own.collect();
        let length = stretches.iter().map(|stretch| stretch.interval.length()).sum();
        BoundaryDistances { stretches, length }
    }
}

/// The intervals of the basins, joined across gaps of at most `resolution`.
fn stretches(basins: &IntervalBasins, resolution: f64) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    for part in basins.intervals() {
        let (interval, label) = (part.interval, part.label);
        match found.last_mut() {
            Some(last)
                if last.label == label && interval.left - last.interval.right <= resolution =>
            {
                last.interval.right = interval.right;
            }
            last => {
                let other_below = last.map_or(f64::NEG_INFINITY, |last| {
                    if last.label == label { last.other_below } else { last.interval.right }
                });
                found.push(Stretch { interval, label, other_below, other_above: f64::INFINITY });
            }
        }
    }
    let mut next: Option<Stretch> = None;
    for stretch in found.iter_mut().rev() {
        if let Some(next) = next {
            let same = next.label == stretch.label;
            stretch.other_above = if same { next.other_above } else { next.interval.left };
        }
        next = Some(*stretch);
    }
    found
}

impl BoundaryDistances {
    /// The length of the basin that is known.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The fraction of the basin within a distance of its boundary; `None` for a basin without an interval, and for a distance that is
    /// negative or NaN.
    ///
    /// This is the fraction of states that some shock of this size takes out of the basin. The bounds are those of the
    /// distances, for the part of the basin that is known.
    pub fn fraction_within(&self, distance: f64) -> Option<Bounds> {
        if !(distance >= 0.0 && self.length > 0.0) {
            return None;
        }
        // The part of [left, right] within the distance of `below` or of `above`.
        let part = |Interval { left, right }: Interval, below: f64, above: f64| {
            let (first, last) =
                ((below + distance).clamp(left, right), (above - distance).clamp(left, right));
            if first >= last { right - left } else { (first - left) + (right - last) }
        };
        let sum = |ends: fn(&Stretch) -> (f64, f64)| -> f64 {
            let one = |stretch: &Stretch| part(stretch.interval, ends(stretch).0, ends(stretch).1);
            self.stretches.iter().map(one).sum()
        };
        let lower = sum(|stretch| (stretch.other_below, stretch.other_above));
        let upper = sum(|stretch| (stretch.interval.left, stretch.interval.right));
        Some(Bounds {
            lower: (lower / self.length).min(1.0),
            upper: (upper / self.length).min(1.0),
        })
    }

    /// The state with the largest lower bound of the distance, and bounds on the largest distance in the basin; `None` for a basin
    /// without an interval.
    pub fn largest(&self) -> Option<(f64, Bounds)> {
        let lower = |stretch: &Stretch| 0.5 * stretch.interval.length();
        let longest = self.stretches.iter().max_by(|a, b| lower(a).total_cmp(&lower(b)))?;
        // The largest distance in a stretch is taken where both sides are equally far, or at the end that is nearer to this point.
        let upper = |stretch: &Stretch| {
            let middle = 0.5 * stretch.other_below + 0.5 * stretch.other_above;
            let Interval { left, right } = stretch.interval;
            // Without another basin on one side the largest distance is at that end; without any, both are infinite.
            let at = if middle.is_nan() { left } else { middle.clamp(left, right) };
            stretch.distance(at).nearest().upper
        };
        let upper = self.stretches.iter().map(upper).fold(0.0, f64::max);
        let middle = 0.5 * longest.interval.left + 0.5 * longest.interval.right;
        Some((middle, Bounds { lower: lower(longest), upper }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::basin_search::interval_basins_from_known;
    use crate::refinement::Refinement;

    fn basins(parts: &[(f64, f64, u8)]) -> IntervalBasins {
        let known: Vec<_> = parts
            .iter()
            .map(|&(left, right, label)| (Interval { left, right }, Label::from(label)))
            .collect();
        let window = Interval { left: 0.0, right: 10.0 };
        let map = |x: f64| Some(x);
        interval_basins_from_known(&map, &known, &[], window, Refinement::default()).unwrap()
    }

    #[test]
    fn gaps_are_boundary_for_the_lower_bound_and_other_basins_for_the_upper() {
        let found = basins(&[(0.0, 2.0, 1), (2.5, 3.0, 1), (4.0, 6.0, 2), (6.5, 9.0, 1)]);
        let at = |x: f64, resolution: f64| found.distance_to_boundary(x, resolution).unwrap();
        let two = at(5.5, 0.0);
        assert_eq!((two.below.lower, two.below.upper), (1.5, 2.5));
        assert_eq!((two.above.lower, two.above.upper), (0.5, 1.0));
        assert_eq!(two.nearest(), Bounds { lower: 0.5, upper: 1.0 });
        // The first basin: no other one below, and the end of the window is not known to be boundary.
        let one = at(0.5, 0.0);
        assert_eq!(one.below, Bounds { lower: 0.5, upper: f64::INFINITY });
        assert_eq!(one.above, Bounds { lower: 1.5, upper: 3.5 });
        // Across a gap that counts as rounding.
        assert_eq!(at(0.5, 0.5).above.lower, 2.5);
        assert_eq!(at(2.6, 0.0).below, Bounds { lower: 2.6 - 2.5, upper: f64::INFINITY });
        assert_eq!(found.distance_to_boundary(3.5, 0.0), None);
        assert_eq!(found.distance_to_boundary(f64::NAN, 0.0), None);
    }

    /// The fraction within a distance is the share of equally spaced states whose distance is as small.
    #[test]
    fn the_distribution_of_distances_is_that_of_single_states() {
        let found =
            basins(&[(0.0, 2.0, 1), (2.5, 3.0, 1), (4.0, 6.0, 2), (6.5, 9.0, 1), (9.0001, 9.9, 2)]);
        let label = Label::from(1);
        let distances = found.distances_to_boundary(label, 0.0);
        assert!((distances.length() - 5.0).abs() < 1e-15);
        let states: Vec<f64> = (0..10_000).map(|k| (f64::from(k) + 0.5) * 1e-3).collect();
        let own: Vec<Bounds> = states
            .iter()
            .filter(|&&x| found.label(x) == Some(label))
            .map(|&x| found.distance_to_boundary(x, 0.0).unwrap().nearest())
            .collect();
        for distance in [0.0, 0.1, 0.3, 0.77, 1.0, 2.0] {
            let share = |condition: &dyn Fn(&Bounds) -> bool| {
                own.iter().filter(|bounds| condition(bounds)).count() as f64 / own.len() as f64
            };
            let part = distances.fraction_within(distance).unwrap();
            assert!((part.upper - share(&|d| d.lower <= distance)).abs() < 1e-3, "{distance}");
            assert!((part.lower - share(&|d| d.upper <= distance)).abs() < 1e-3, "{distance}");
        }
        let (safest, largest) = distances.largest().unwrap();
        let most = |end: fn(&Bounds) -> f64| own.iter().map(end).fold(0.0, f64::max);
        assert!((safest - 7.75).abs() < 1e-12);
        assert!((largest.lower - most(|d| d.lower)).abs() < 1e-3);
        assert!((largest.upper - most(|d| d.upper)).abs() < 1e-3);
        assert_eq!(distances.fraction_within(f64::NAN), None);
        assert!(found.distances_to_boundary(Label::from(7), 0.0).largest().is_none());
    }
}
