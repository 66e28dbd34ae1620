//! Monotone branches of a scalar map.

use crate::{Error, Image, Interval, ScalarMap};

/// An interval on which the map has values and is monotone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Where.
    pub domain: Interval,
    /// Value at the left end.
    pub at_left: f64,
    /// Value at the right end.
    pub at_right: f64,
}

impl Branch {
    /// Whether the map increases on the branch.
    pub fn increases(&self) -> bool {
        self.at_left <= self.at_right
    }

    /// The points of the branch that the map takes into `target`, if they are more than one.
    ///
    /// Both ends are found to one ulp, by bisection on the order of values: a jump of a monotone
    /// branch does no harm.
    pub fn preimage(&self, map: &impl ScalarMap, target: &Interval) -> Option<Interval> {
        let lowest = self.at_left.min(self.at_right);
        let highest = self.at_left.max(self.at_right);
        if target.right < lowest || target.left > highest {
            return None;
        }
        // First and last point whose value lies in the target, going with the branch upwards.
        let enter = |value: f64| value >= target.left;
        let leave = |value: f64| value > target.right;
        let (left, right) = if self.increases() {
            (self.first(map, enter)?, self.last_before(map, leave)?)
        } else {
            // Against the branch: values fall from left to right.
            (
                self.first(map, |value| value <= target.right)?,
                self.last_before(map, |value| value < target.left)?,
            )
        };
        (left < right).then_some(Interval { left, right })
    }

    /// The first point of the branch at which `condition` holds, given that it holds from there on.
    fn first(&self, map: &impl ScalarMap, condition: impl Fn(f64) -> bool) -> Option<f64> {
        if condition(self.at_left) {
            return Some(self.domain.left);
        }
        if !condition(self.at_right) {
            return None;
        }
        Some(self.switch(map, condition).1)
    }

    /// The last point before `condition` begins to hold.
    fn last_before(&self, map: &impl ScalarMap, condition: impl Fn(f64) -> bool) -> Option<f64> {
        if condition(self.at_left) {
            return None;
        }
        if !condition(self.at_right) {
            return Some(self.domain.right);
        }
        Some(self.switch(map, condition).0)
    }

    /// Neighbouring `f64` between which `condition` begins to hold.
    fn switch(&self, map: &impl ScalarMap, condition: impl Fn(f64) -> bool) -> (f64, f64) {
        bisect(self.domain.left, self.domain.right, |x| match map.image(x) {
            Image::Point(value) => condition(value),
            // Inside a branch the map has values; rounding at its very ends counts as the end.
            Image::Stops | Image::Undecided => condition(self.at_right),
        })
    }
}

/// Neighbours left < right with `holds(left)` false and `holds(right)` true, given that it is so
/// for the ends.
fn bisect(mut left: f64, mut right: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
    loop {
        let middle = left + 0.5 * (right - left);
        if middle <= left || middle >= right {
            return (left, right);
        }
        if holds(middle) {
            right = middle;
        } else {
            left = middle;
        }
    }
}

/// The monotone branches of `map` on `window`, as far as `samples` equally spaced points show them.
///
/// Turning points are refined by golden-section search, edges at which the map loses its value to
/// one ulp. Turns and gaps that fall between two samples are not seen: split the window at the
/// places where theory knows them.
///
/// # Errors
/// [`Error::TooFewSamples`] for fewer than three.
pub fn monotone_branches(
    map: &impl ScalarMap,
    window: Interval,
    samples: usize,
) -> Result<Vec<Branch>, Error> {
    if samples < 3 {
        return Err(Error::TooFewSamples { samples });
    }
    let value = |x: f64| match map.image(x) {
        Image::Point(value) => Some(value),
        Image::Stops | Image::Undecided => None,
    };
    let at = |k: usize| window.left + window.length() * (k as f64 / (samples - 1) as f64);
    let mut cuts = vec![(at(0), value(at(0)))];
    for k in 1..samples {
        let (before, here) = (value(at(k - 1)), value(at(k)));
        match (before, here) {
            (Some(_), None) => {
                let (edge, _) = bisect(at(k - 1), at(k), |x| value(x).is_none());
                cuts.extend([(edge, value(edge)), (at(k), None)]);
            }
            (None, Some(_)) => {
                let (_, edge) = bisect(at(k - 1), at(k), |x| value(x).is_some());
                cuts.extend([(edge, None), (edge, value(edge))]);
            }
            (Some(a), Some(b)) if k + 1 < samples => {
                if let Some(c) = value(at(k + 1)).filter(|c| (b - a) * (c - b) < 0.0) {
                    let up = if b > c { 1.0 } else { -1.0 };
                    let turn = highest(|x| value(x).map(|v| up * v), at(k - 1), at(k + 1));
                    cuts.push((turn, value(turn)));
                }
            }
            _ => {}
        }
    }
    cuts.push((at(samples - 1), value(at(samples - 1))));
    Ok(cuts.windows(2).filter_map(branch_between).collect())
}

fn branch_between(ends: &[(f64, Option<f64>)]) -> Option<Branch> {
    let [(left, Some(at_left)), (right, Some(at_right))] = *ends else { return None };
    let domain = Interval { left, right };
    (left < right).then_some(Branch { domain, at_left, at_right })
}

/// Golden-section search for a maximum.
fn highest(height: impl Fn(f64) -> Option<f64>, mut left: f64, mut right: f64) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    let height = |x: f64| height(x).unwrap_or(f64::NEG_INFINITY);
    for _ in 0..100 {
        let (a, b) = (right - GOLDEN * (right - left), left + GOLDEN * (right - left));
        if height(a) > height(b) { right = b } else { left = a }
    }
    0.5 * (left + right)
}
