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
        // First and last point whose value lies in the target; against the branch, values fall from
        // left to right.
        let Interval { left: low, right: high } = *target;
        let (left, right) = if self.increases() {
            (self.first(map, low, |off| off >= 0.0)?, self.last_before(map, high, |off| off > 0.0)?)
        } else {
            (self.first(map, high, |off| off <= 0.0)?, self.last_before(map, low, |off| off < 0.0)?)
        };
        (left < right).then_some(Interval { left, right })
    }

    /// The first point of the branch at which `holds` is true of value − `aim`, given that it is true
    /// from there on.
    fn first(&self, map: &impl ScalarMap, aim: f64, holds: impl Fn(f64) -> bool) -> Option<f64> {
        if holds(self.at_left - aim) {
            return Some(self.domain.left);
        }
        if !holds(self.at_right - aim) {
            return None;
        }
        Some(self.switch(map, aim, holds).1)
    }

    /// The last point before `holds` becomes true.
    fn last_before(
        &self,
        map: &impl ScalarMap,
        aim: f64,
        holds: impl Fn(f64) -> bool,
    ) -> Option<f64> {
        if holds(self.at_left - aim) {
            return None;
        }
        if !holds(self.at_right - aim) {
            return Some(self.domain.right);
        }
        Some(self.switch(map, aim, holds).0)
    }

    /// Neighbouring `f64` between which `holds` becomes true of value − `aim`.
    ///
    /// Regula falsi (with Illinois' halving) to a few ulps, then doubling steps to the other side, and
    /// bisection: some 15 values where bisection alone takes 50, and never over 130.
    fn switch(&self, map: &impl ScalarMap, aim: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
        let off = |x: f64| match map.image(x) {
            Image::Point(value) => value - aim,
            // Inside a branch the map has values; rounding at its very ends counts as the end.
            Image::Stops | Image::Undecided => self.at_right - aim,
        };
        let (mut left, mut right) = (self.domain.left, self.domain.right);
        let (mut at_left, mut at_right) = (self.at_left - aim, self.at_right - aim);
        let (mut last, mut side) = (f64::NAN, None);
        for _ in 0..24 {
            let guess = left - at_left * ((right - left) / (at_right - at_left));
            if !(guess > left && guess < right) {
                break;
            }
            let value = off(guess);
            let beyond = holds(value);
            // An end that stays twice is given half its value, so that both ends move.
            let again = side.replace(beyond) == Some(beyond);
            let half = if again { 0.5 } else { 1.0 };
            if beyond {
                (right, at_right, at_left) = (guess, value, half * at_left);
            } else {
                (left, at_left, at_right) = (guess, value, half * at_right);
            }
            let ulp = f64::EPSILON * guess.abs();
            let done = (guess - last).abs() <= 4.0 * ulp;
            last = guess;
            if done {
                break;
            }
        }
        // From the end that has come close, step out to the other side.
        let mut step = f64::EPSILON * last.abs();
        while step > 0.0 && step < 0.5 * (right - left) {
            if last == right {
                let probe = right - step;
                if holds(off(probe)) {
                    (right, last) = (probe, probe);
                } else {
                    left = probe;
                }
            } else {
                let probe = left + step;
                if holds(off(probe)) {
                    right = probe;
                } else {
                    (left, last) = (probe, probe);
                }
            }
            step *= 2.0;
        }
        bisect(left, right, |x| holds(off(x)))
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
/// Turning points are refined by golden-section search; edges at which the map loses its value, and
/// jumps that stand out from the steps beside them, to one ulp. Turns and gaps that fall between two samples are not seen: split the window at the
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
    let values: Vec<Option<f64>> = (0..samples).map(|k| value(at(k))).collect();
    let step = |k: usize| Some(values.get(k + 1).copied()?? - values.get(k).copied()??);
    let mut cuts = vec![(at(0), values[0])];
    // The last step that went up or down, and where it began: equal samples do not hide a turn.
    let mut last: Option<(usize, f64)> = None;
    for k in 0..samples - 1 {
        match (values[k], values[k + 1]) {
            (Some(_), None) => {
                let (edge, _) = bisect(at(k), at(k + 1), |x| value(x).is_none());
                cuts.extend([(edge, value(edge)), (at(k + 1), None)]);
                last = None;
            }
            (None, Some(_)) => {
                let (_, edge) = bisect(at(k), at(k + 1), |x| value(x).is_some());
                cuts.extend([(edge, None), (edge, value(edge))]);
                last = None;
            }
            (Some(a), Some(b)) => {
                let beside = [k.checked_sub(1).and_then(step), step(k + 1)];
                let usual = beside.into_iter().flatten().map(f64::abs).fold(0.0, f64::max);
                if (b - a).abs() > 4.0 * usual
                    && let Some((left, right)) = jump(&value, at(k), at(k + 1))
                {
                    cuts.extend([(left, value(left)), (left, None), (right, value(right))]);
                    last = None;
                    continue;
                }
                if let Some((from, before)) = last.filter(|(_, before)| before * (b - a) < 0.0) {
                    let up = before.signum();
                    let turn = highest(|x| value(x).map(|v| up * v), at(from), at(k + 1));
                    cuts.push((turn, value(turn)));
                }
                if b != a {
                    last = Some((k, b - a));
                }
            }
            (None, None) => {}
        }
    }
    cuts.push((at(samples - 1), values[samples - 1]));
    Ok(cuts.windows(2).filter_map(branch_between).collect())
}

/// Neighbouring `f64` between which the map jumps, if halving towards the larger difference leaves
/// most of it.
fn jump(value: &impl Fn(f64) -> Option<f64>, left: f64, right: f64) -> Option<(f64, f64)> {
    let (mut left, mut right) = (left, right);
    let whole = (value(right)? - value(left)?).abs();
    loop {
        let middle = left + 0.5 * (right - left);
        if middle <= left || middle >= right {
            break;
        }
        let here = value(middle)?;
        if (here - value(left)?).abs() > (value(right)? - here).abs() {
            right = middle;
        } else {
            left = middle;
        }
    }
    ((value(right)? - value(left)?).abs() > 0.25 * whole).then_some((left, right))
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

#[cfg(test)]
mod tests {
    use super::*;

    fn branches(
        map: impl Fn(f64) -> Option<f64>,
        left: f64,
        right: f64,
        samples: usize,
    ) -> Vec<Branch> {
        monotone_branches(&map, Interval { left, right }, samples).unwrap()
    }

    #[test]
    fn a_turn_between_equal_samples_is_found() {
        for samples in [4, 8, 9] {
            let found = branches(|x| Some(x * x), -3.0, 3.0, samples);
            assert_eq!(found.len(), 2, "{samples}: {found:?}");
            assert!(!found[0].increases() && found[1].increases());
            assert!(found[0].domain.right.abs() < 1e-7);
        }
    }

    #[test]
    fn branches_end_at_jumps() {
        let found = branches(|x| Some((3.0 * x).fract()), 0.01, 0.99, 101);
        assert_eq!(found.len(), 3, "{found:?}");
        for (branch, k) in found.iter().zip(1..) {
            assert!(branch.increases());
            assert!(k == 3 || (branch.domain.right - f64::from(k) / 3.0).abs() < 1e-15);
            assert!(k == 3 || branch.at_right > 0.999_999);
        }
    }

    #[test]
    fn branches_end_where_the_map_does() {
        let found = branches(|x| (x.abs() > 0.5).then_some(x), -1.0, 1.0, 50);
        assert_eq!(found.len(), 2);
        assert_eq!(
            (found[0].domain.right, found[1].domain.left),
            (-0.5f64.next_up(), 0.5f64.next_up())
        );
    }
}
