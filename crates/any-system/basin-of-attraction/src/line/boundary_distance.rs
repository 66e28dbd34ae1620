//! How far states of the line are from the boundary of their basin.

use crate::line::interval_basins::IntervalBasins;
use crate::space::interval::Interval;
use crate::space::label::Label;
use crate::statistics::bounds::Bounds;

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
    /// Lower bounds count every undecided gap as boundary, and the ends of the window too. Upper bounds go to the
    /// next interval of another basin. A gap of at most `resolution` between two intervals of the same basin is no
    /// boundary: it comes from rounding.
    ///
    /// A shock that is smaller than the nearest distance leaves the state in its basin (minimal fatal shock: L.
    /// Halekotte, U. Feudel, Sci. Rep. 10, 11783, 2020).
    pub fn distance_to_boundary(&self, x: f64, resolution: f64) -> Option<BoundaryDistance> {
        let stretches = stretches(self, resolution);
        let at = stretches.partition_point(|stretch| stretch.interval.right < x);
        let own = stretches.get(at).filter(|stretch| stretch.interval.contains(x));
        own.map(|stretch| stretch.distance(x))
    }

    /// The distances of all states of a basin from its boundary, as
    /// [`distance_to_boundary`](Self::distance_to_boundary) gives them for one.
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

    /// The fraction of the basin within a distance of its boundary; `None` for a basin without an interval, and for
    /// a distance that is negative or NaN.
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

    /// The state with the largest lower bound of the distance, and bounds on the largest distance in the basin;
    /// `None` for a basin without an interval.
    pub fn largest(&self) -> Option<(f64, Bounds)> {
        let lower = |stretch: &Stretch| 0.5 * stretch.interval.length();
        let longest = self.stretches.iter().max_by(|a, b| lower(a).total_cmp(&lower(b)))?;
        // The largest distance in a stretch is taken where both sides are equally far, or at the end that is nearer
        // to this point.
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
