//! Monotone branches of a scalar map.

use crate::error::Error;
use crate::line::scalar_map::{Image, ScalarMap};
use crate::shares::sampling::check_window;
use crate::space::interval::Interval;
use interval_arithmetic::golden_section_minimum;

/// A monotone branch: the map restricted to a lap, an interval on which it has values and is monotone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// The lap.
    pub domain: Interval,
    /// Value of the map at the left end.
    pub at_left: f64,
    /// Value of the map at the right end.
    pub at_right: f64,
}

impl Branch {
    /// Whether the map increases on the branch.
    pub fn increases(&self) -> bool {
        self.at_left <= self.at_right
    }

    /// The preimage of `target` on this branch; `None` if it is empty or a single point.
    ///
    /// Both ends are found to one ulp by the order of values. A jump inside the branch does no harm, as long as the
    /// branch is monotone.
    pub fn preimage(&self, map: &impl ScalarMap, target: &Interval) -> Option<Interval> {
        let lowest = self.at_left.min(self.at_right);
        let highest = self.at_left.max(self.at_right);
        if target.right < lowest || target.left > highest {
            return None;
        }
        // The first and the last point whose value lies in the target. On a decreasing branch the first one
        // belongs to the target's right end.
        let Interval { left: low, right: high } = *target;
        let (left, right) = if self.increases() {
            (
                self.first(map, low, |difference| difference >= 0.0)?,
                self.last_before(map, high, |difference| difference > 0.0)?,
            )
        } else {
            (
                self.first(map, high, |difference| difference <= 0.0)?,
                self.last_before(map, low, |difference| difference < 0.0)?,
            )
        };
        (left < right).then_some(Interval { left, right })
    }

    /// The first and the last point of the branch with this value; `None` if the branch does not reach it.
    pub(crate) fn points_with(&self, map: &impl ScalarMap, value: f64) -> Option<(f64, f64)> {
        let first = |up: bool| {
            self.first(
                map,
                value,
                move |difference| {
                    if up { difference >= 0.0 } else { difference <= 0.0 }
                },
            )
        };
        let last = |up: bool| {
            self.last_before(
                map,
                value,
                move |difference| {
                    if up { difference > 0.0 } else { difference < 0.0 }
                },
            )
        };
        let up = self.increases();
        Some((first(up)?, last(up)?))
    }

    /// The first point of the branch at which `holds` is true of value − `aim`; `None` if it is true nowhere.
    /// `holds` must be true from that point on.
    fn first(&self, map: &impl ScalarMap, aim: f64, holds: impl Fn(f64) -> bool) -> Option<f64> {
        if holds(self.at_left - aim) {
            return Some(self.domain.left);
        }
        if !holds(self.at_right - aim) {
            return None;
        }
        Some(self.switch(map, aim, holds).1)
    }

    /// The last point of the branch before `holds` becomes true; `None` if it is true everywhere.
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

    /// The neighbouring `f64` between which `holds` becomes true of value − `aim`, given that it is false at the
    /// left end of the branch and true at the right end.
    ///
    /// Regula falsi with Illinois' halving brings one end close. Doubling steps from that end then bracket the
    /// switch, and bisection finishes. This takes some 15 values where bisection alone takes 50; at most it takes
    /// 130.
    ///
    /// Invariant of all three: `holds` is false at `left` and true at `right`.
    fn switch(&self, map: &impl ScalarMap, aim: f64, holds: impl Fn(f64) -> bool) -> (f64, f64) {
        /// Most steps of regula falsi. A smooth branch needs fewer. At a jump, or where the branch is very flat, regula
        /// falsi converges slowly; bisection then finds the root.
        const REGULA_FALSI_STEPS: usize = 24;
        /// Regula falsi stops when two guesses are as close as this number of ulps: rounding of the values then
        /// decides its steps.
        const CLOSE_ULPS: f64 = 4.0;
        let difference = |x: f64| match map.image(x) {
            Image::Point(value) => value - aim,
            // The map has values inside its branch. If rounding gives a point without a value, this point is at an end
            // of the lap. The value at the right end preserves the invariant.
            Image::Stops | Image::Undecided => self.at_right - aim,
        };
        let (mut left, mut right) = (self.domain.left, self.domain.right);
        let (mut at_left, mut at_right) = (self.at_left - aim, self.at_right - aim);
        let (mut last, mut side) = (f64::NAN, None);
        for _ in 0..REGULA_FALSI_STEPS {
            let guess = left - at_left * ((right - left) / (at_right - at_left));
            if !(guess > left && guess < right) {
                break;
            }
            let value = difference(guess);
            let beyond = holds(value);
            // Illinois: if an end stays for two steps, its value is halved, so that the next guess falls on its other
            // side. Without this rule one end could stay through all steps.
            let again = side.replace(beyond) == Some(beyond);
            let half = if again { 0.5 } else { 1.0 };
            if beyond {
                (right, at_right, at_left) = (guess, value, half * at_left);
            } else {
                (left, at_left, at_right) = (guess, value, half * at_right);
            }
            let ulp = f64::EPSILON * guess.abs();
            let done = (guess - last).abs() <= CLOSE_ULPS * ulp;
            last = guess;
            if done {
                break;
            }
        }
        // `last` is the end that is close to the switch. Steps from it towards the other end double until the switch is
        // passed. Without a guess `last` is NaN: then no step is taken, and bisection does the whole search.
        let mut step = f64::EPSILON * last.abs();
        while step > 0.0 && step < 0.5 * (right - left) {
            if last == right {
                let probe = right - step;
                if holds(difference(probe)) {
                    (right, last) = (probe, probe);
                } else {
                    left = probe;
                }
            } else {
                let probe = left + step;
                if holds(difference(probe)) {
                    right = probe;
                } else {
                    (left, last) = (probe, probe);
                }
            }
            step *= 2.0;
        }
        bisect(left, right, |x| holds(difference(x)))
    }
}

/// The neighbouring `f64` left < right with `holds(left)` false and `holds(right)` true, given that this is true of
/// the ends.
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

/// A step between samples that exceeds both neighbouring steps by this factor may hide a jump, and is searched. On a
/// smooth branch steps change by less than this factor, except beside a turning point or a steep edge; there the
/// search finds no jump. A larger factor would miss small jumps, a smaller one would search more.
const SUSPECT_STEP: f64 = 4.0;

/// A jump keeps more than this fraction of the step's height when the step is halved to neighbouring `f64`. A
/// continuous map keeps a fraction near 0. A jump inside a step across which the map also changes smoothly keeps the
/// quotient of the two heights: a jump lower than a quarter of its step is taken for a steep part of the branch. A
/// smaller fraction would find lower jumps; it would also cut a branch where rounding is a larger part of a low step.
const JUMP_FRACTION: f64 = 0.25;

/// Most samples of a search for branches: 1.6 gigabytes of values. A count far above this is a mistake, and would
/// end in a lack of memory.
const MOST_SAMPLES: usize = 100_000_000;

/// The monotone branches of `map` on `window`, as far as `samples` equally spaced points show them.
///
/// Turning points are refined by golden-section search, to the square root of an ulp. Points at which the map loses its
/// finite value, and jumps that are larger than the steps beside them, are refined to one ulp. A pair of turning points
/// between two neighbouring samples is missed, and so is a gap there. If theory gives such places, split the window at
/// them.
///
/// # Errors
/// [`Error::TooFewSamples`] for fewer than three samples, [`Error::TooManySamples`] for more than a hundred million,
/// [`Error::BadInterval`] for a window that is reversed, or whose length is not finite.
pub fn monotone_branches(
    map: &impl ScalarMap,
    window: Interval,
    samples: usize,
) -> Result<Vec<Branch>, Error> {
    check_window(window)?;
    if samples < 3 {
        return Err(Error::TooFewSamples { samples });
    }
    if samples > MOST_SAMPLES {
        let remedy = "divide the window, and search each part";
        return Err(Error::TooManySamples { samples, most: MOST_SAMPLES, remedy });
    }
    let value = |x: f64| match map.image(x) {
        Image::Point(value) => Some(value).filter(|value| value.is_finite()),
        Image::Stops | Image::Undecided => None,
    };
    let at = |k: usize| window.left + window.length() * (k as f64 / (samples - 1) as f64);
    let values: Vec<Option<f64>> = (0..samples).map(|k| value(at(k))).collect();
    let step = |k: usize| Some(values.get(k + 1).copied()?? - values.get(k).copied()??);
    // The ends of branches, each with the value there. An end without a value separates two branches.
    let mut cuts = vec![(at(0), values[0])];
    // The last step between samples of different values, and the sample at which it began. A turning point between two
    // equal samples is found because the step before them is stored.
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
                if (b - a).abs() > SUSPECT_STEP * usual
                    && let Some((left, right)) = jump(&value, at(k), at(k + 1))
                {
                    cuts.extend([(left, value(left)), (left, None), (right, value(right))]);
                    last = None;
                    continue;
                }
                // The signs are compared, not the product of the steps: it underflows for steps below 10⁻¹⁶².
                let turns = |before: f64| (before > 0.0 && b < a) || (before < 0.0 && b > a);
                if let Some((from, before)) = last.filter(|(_, before)| turns(*before)) {
                    let up = before.signum();
                    // Points without a value count as the lowest ones of a maximum.
                    let depth = |x| value(x).map_or(f64::INFINITY, |v| -up * v);
                    let extremum = golden_section_minimum(depth, at(from), at(k + 1));
                    cuts.push((extremum, value(extremum)));
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

/// The neighbouring `f64` between which the map jumps; `None` if the map does not jump.
///
/// Bisection keeps the half in which the value changes more. At a jump most of the change remains in the last half.
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
    ((value(right)? - value(left)?).abs() > JUMP_FRACTION * whole).then_some((left, right))
}

/// The branch between two neighbouring cuts; `None` if one has no value, or both are one point.
fn branch_between(ends: &[(f64, Option<f64>)]) -> Option<Branch> {
    let [(left, Some(at_left)), (right, Some(at_right))] = *ends else { return None };
    let domain = Interval { left, right };
    (left < right).then_some(Branch { domain, at_left, at_right })
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
    fn a_value_that_is_not_finite_is_none() {
        for value in [f64::NAN, f64::INFINITY] {
            assert!(branches(|_| Some(value), 0.0, 1.0, 10).is_empty());
            let some = branches(|x| Some(if x < 0.5 { x } else { value }), 0.0, 1.0, 10);
            assert_eq!((some.len(), some[0].domain.right), (1, 0.5_f64.next_down()));
        }
    }

    #[test]
    fn a_count_of_samples_beyond_all_memory_is_an_error() {
        let window = Interval { left: 0.0, right: 1.0 };
        for samples in [MOST_SAMPLES + 1, 1_000_000_000_000, usize::MAX] {
            let error = monotone_branches(&|x: f64| Some(x), window, samples).unwrap_err();
            assert!(matches!(error, Error::TooManySamples { most: MOST_SAMPLES, .. }), "{error}");
        }
    }

    #[test]
    fn an_extremum_between_equal_samples_is_found() {
        for samples in [4, 8, 9] {
            let found = branches(|x| Some(x * x), -3.0, 3.0, samples);
            assert_eq!(found.len(), 2, "{samples}: {found:?}");
            assert!(!found[0].increases() && found[1].increases());
            assert!(found[0].domain.right.abs() < 1e-7);
        }
    }

    /// The product of two steps of this map is 0 in `f64`.
    #[test]
    fn an_extremum_of_a_tiny_map_is_found() {
        for size in [1e-170, 1e-300, f64::MIN_POSITIVE] {
            let found = branches(|x| Some(size * (x * x)), -3.0, 3.0, 8);
            assert_eq!(found.len(), 2, "{size:e}: {found:?}");
            assert!(!found[0].increases() && found[1].increases());
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
