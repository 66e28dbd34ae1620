//! Intervals, and sets of disjoint intervals.

use crate::error::Error;

/// A closed interval [left, right].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Left end.
    pub left: f64,
    /// Right end.
    pub right: f64,
}

impl Interval {
    /// [left, right].
    ///
    /// # Errors
    /// [`Error::BadInterval`] unless both are finite and left ≤ right.
    pub fn new(left: f64, right: f64) -> Result<Self, Error> {
        if left <= right && left.is_finite() && right.is_finite() {
            Ok(Interval { left, right })
        } else {
            Err(Error::BadInterval { left, right })
        }
    }

    /// right − left.
    pub fn length(&self) -> f64 {
        self.right - self.left
    }

    /// Whether x lies in the closed interval.
    #[inline]
    pub fn contains(&self, x: f64) -> bool {
        self.left <= x && x <= self.right
    }

    /// The common part; `None` if it is empty or a single point.
    pub fn intersection(&self, other: &Interval) -> Option<Interval> {
        let (left, right) = (self.left.max(other.left), self.right.min(other.right));
        (left < right).then_some(Interval { left, right })
    }
}

/// A set of disjoint closed intervals in increasing order.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct IntervalSet {
    /// Disjoint, in increasing order: look-ups bisect them.
    parts: Vec<Interval>,
}

impl IntervalSet {
    /// The union of `intervals`; parts that touch or overlap are joined.
    pub fn union(mut intervals: Vec<Interval>) -> Self {
        intervals.sort_by(|a, b| a.left.total_cmp(&b.left));
        let mut parts: Vec<Interval> = Vec::with_capacity(intervals.len());
        for next in intervals {
            match parts.last_mut() {
                Some(last) if next.left <= last.right => last.right = last.right.max(next.right),
                _ => parts.push(next),
            }
        }
        IntervalSet { parts }
    }

    /// The intervals, from left to right.
    pub fn intervals(&self) -> &[Interval] {
        &self.parts
    }

    /// The Lebesgue measure: the total length.
    pub fn measure(&self) -> f64 {
        self.parts.iter().map(Interval::length).sum()
    }

    /// Whether x lies in the set.
    pub fn contains(&self, x: f64) -> bool {
        let at = self.parts.partition_point(|part| part.right < x);
        self.parts.get(at).is_some_and(|part| part.contains(x))
    }

    /// This set without the inside of `other`, as closed intervals: ends of `other` remain.
    pub fn minus(&self, other: &IntervalSet) -> IntervalSet {
        let mut rest = Vec::new();
        for part in &self.parts {
            let mut left = part.left;
            let first = other.parts.partition_point(|cut| cut.right <= part.left);
            for cut in other.parts[first..].iter().take_while(|cut| cut.left < part.right) {
                if cut.left > left {
                    rest.push(Interval { left, right: cut.left });
                }
                left = cut.right;
            }
            if left < part.right {
                rest.push(Interval { left, right: part.right });
            }
        }
        IntervalSet { parts: rest }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn sets() -> impl Strategy<Value = IntervalSet> {
        proptest::collection::vec((-10..10i32, 1..5i32), 0..8).prop_map(|parts| {
            let interval = |(left, length): (i32, i32)| Interval {
                left: f64::from(left),
                right: f64::from(left + length),
            };
            IntervalSet::union(parts.into_iter().map(interval).collect())
        })
    }

    proptest! {
        #[test]
        fn union_and_difference_contain_the_points_of_their_definition(a in sets(), b in sets(), k in -40..60i32) {
            let x = f64::from(k) / 4.0 + 0.1; // never an end
            let both = IntervalSet::union([a.intervals(), b.intervals()].concat());
            prop_assert_eq!(both.contains(x), a.contains(x) || b.contains(x));
            prop_assert_eq!(a.minus(&b).contains(x), a.contains(x) && !b.contains(x));
        }

        #[test]
        fn the_measures_of_disjoint_sets_add_up(a in sets(), b in sets()) {
            let both = IntervalSet::union([a.intervals(), b.intervals()].concat());
            let apart = a.minus(&b).measure() + b.measure();
            prop_assert!((both.measure() - apart).abs() < 1e-12);
        }
    }
}
