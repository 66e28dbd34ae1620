//! One guard that is followed along an integrated flow, from step to step, to its first crossing.

use super::polynomial_test::{LEFT_ZERO, PolynomialTest, test, test_leaving_zero};
use super::step::Step;
use crate::crossing::{bracketed_root, guard_rounding, step_to_sign};
use crate::error::Error;
use crate::guard::Direction;
use crate::state::State;

/// Depth of halving of one step, and so the length of the list of open intervals, which is on the stack. 53 halvings
/// reach the rounding of times in the middle of a step. Near time zero doubles are denser, and more halvings would be
/// possible. An interval at this depth is treated as hidden by rounding.
const MOST_HALVINGS: usize = 64;

/// Most intervals of one step that are tested: a limit for a search that would not end. The search then ends with
/// [`Error::NoConvergence`].
const MOST_INTERVALS: usize = 100_000;

/// Rounding error of an interpolant, in units of that of the largest state on its step. The value is an estimate, not
/// derived: with the factors of `guard_rounding` it is 6·10⁻¹⁴ of the state. Measured on the problem of `schemes`, steps of
/// 1/16 and 1/32: the pair 9(8) is wrong by 2·10⁻¹⁶, the pair 8(7) by 10⁻¹³. So rounding can exceed the estimate with the
/// pair 8(7). That pair is used at tolerances from 2·10⁻¹¹ on, where the flow itself is known less well. If the value is
/// too small, rounding is taken for a crossing; if it is too large, grazings are reported too early.
const INTERPOLANT_ROUNDING: f64 = 64.0;

/// A shorter first step is tried if the rounding of the guard on the step exceeds the rounding at the start by this
/// factor, four times the factor of every step. Below this factor a shorter step could not show more.
const COARSE: f64 = 4.0 * INTERPOLANT_ROUNDING;

/// Length of the shorter first step, relative to the one that was too long. The rounding of the interpolant shrinks
/// with it, by two digits at a time. A shorter step would often be shorter than necessary, and cost more steps after
/// it. A longer one would need more tries, each of which starts the integration again.
const SHORTER: f64 = 0.01;

/// The state is moved along its rate by this distance, relative to its size, to compute the rate of a guard at the
/// start. The distance is about √ε, as for finite differences: the rounding of the difference is 1e-8 of it, and so is
/// the effect of the guard's second derivative.
const DIFFERENCE_REACH: f64 = 1e-8;

/// A guard has a rate at the start if its change over both sides exceeds this multiple of its bend. Where the bend
/// is as large as the change, the guard may fall on one side and rise on the other, and the difference has no
/// meaning.
const STRAIGHT: f64 = 1.0;

/// A step is skipped if the guard's smallest distance from zero is more than one half of its variation.
const AWAY: f64 = 2.0;

/// A guard, followed from step to step.
pub(super) struct FollowedGuard {
    direction: Direction,
    /// The side of the surface, ±1; `None` as long as the guard has not left the zero it started at.
    side: Option<f64>,
    /// The sign of the guard's rate at the start; `None` if rounding hides it.
    rate: Option<f64>,
    /// The guard's value at the start.
    start: f64,
    /// Rounding error of that value.
    start_rounding: f64,
}

/// The result of the search on one step.
pub(super) enum StepOutcome {
    /// A crossing.
    Crossing {
        /// Time of the crossing.
        time: f64,
    },
    /// The guard comes so close to zero that rounding hides whether it crosses.
    Grazing {
        /// Time of the grazing.
        time: f64,
        /// Value of the guard there.
        value: f64,
    },
    /// Rounding hides how the guard leaves its start. Either the guard starts too close to zero for a step of this
    /// length, or it left zero to one side and is found on the other.
    HiddenByRounding {
        /// End of the hidden time.
        until: f64,
    },
    /// No crossing.
    NoCrossing,
}

impl FollowedGuard {
    /// Starts at `start`, with the rate of the state there. The guard counts as zero there if its value is within the
    /// rounding of the state.
    pub(super) fn new<const N: usize>(
        direction: Direction,
        start: &State<N>,
        rate: &State<N>,
        guard: impl Fn(&State<N>) -> f64,
    ) -> Result<Self, Error> {
        let value = guard(start);
        if !value.is_finite() {
            return Err(Error::NotFinite { at: 0.0, value });
        }
        let rounding = guard_rounding(start, start, &guard);
        let side = (value.abs() > rounding).then(|| value.signum());
        // A central difference. The second difference tests whether it is meaningful.
        let reach = DIFFERENCE_REACH * (1.0 + start.amax()) / rate.amax();
        let (ahead, behind) = (guard(&(start + rate * reach)), guard(&(start - rate * reach)));
        let (change, bend) = (ahead - behind, ahead + behind - 2.0 * value);
        let straight = change.abs() > rounding && change.abs() > STRAIGHT * bend.abs();
        let rate = straight.then(|| change.signum());
        Ok(FollowedGuard { direction, side, rate, start: value, start_rounding: rounding })
    }

    /// True if the guard stays on its side along a step, as far as these values show: the smallest distance from
    /// zero is more than half of the difference between the largest and the smallest.
    ///
    /// This test is no bound. A dip to zero and back is visible in the values if it takes an eighth of the step.
    pub(super) fn stays_away(&self, values: impl Iterator<Item = f64>) -> bool {
        let Some(side) = self.side else { return false };
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0);
        for value in values {
            let distance = side * value;
            // The condition is also true for NaN, which the polynomial's test then returns as an error.
            if !(distance > 0.0) {
                return false;
            }
            nearest = if distance < nearest { distance } else { nearest };
            farthest = if distance > farthest { distance } else { farthest };
        }
        AWAY * nearest > farthest - nearest
    }

    /// The first crossing on a step, no later than `until`.
    pub(super) fn crossing<const N: usize>(
        &mut self,
        step: &Step<N>,
        until: f64,
        guard: impl Fn(&State<N>) -> f64,
    ) -> Result<StepOutcome, Error> {
        let along = |time: f64| guard(&step.state(time));
        let size = step.magnitude() * INTERPOLANT_ROUNDING;
        let rounding_near = |time: f64| guard_rounding(&step.state(time), &size, &guard);
        let hidden = || Ok(StepOutcome::HiddenByRounding { until: SHORTER * step.to });
        // True for a first step on which the rounding of the interpolant hides more than the rounding of the state.
        let coarse = step.from == 0.0 && rounding_near(step.from) > COARSE * self.start_rounding;
        let may_cross = self.side.is_some_and(|side| self.direction.admits(side, -side));
        if coarse && may_cross && self.start.abs() <= LEFT_ZERO * rounding_near(step.from) {
            return hidden();
        }
        // Invariant: no crossing in (step.from, left], and the guard is on `side` just after `left`. The rest is
        // divided into intervals; the first `open` entries of `ends` are their right ends, the nearest one last.
        let mut left = step.from;
        let mut ends = [until; MOST_HALVINGS];
        let mut open = 1;
        for _ in 0..MOST_INTERVALS {
            if open == 0 {
                return Ok(StepOutcome::NoCrossing);
            }
            let right = ends[open - 1];
            if left >= right {
                open -= 1;
                continue;
            }
            let rounding = rounding_near(left).max(rounding_near(right));
            let answer = match self.side {
                None => test_leaving_zero(along, left, right, rounding)?,
                Some(_) => test(along, left, right, rounding)?,
            };
            let side_after = match answer {
                PolynomialTest::NoZero { sign } => Some(sign),
                PolynomialTest::Monotone { slope } => self.side_after(along(right), slope),
                // The guard has not left its start yet: the next interval decides.
                PolynomialTest::WithinRounding if self.side.is_none() => None,
                PolynomialTest::WithinRounding | PolynomialTest::Undecided => {
                    let middle = left + 0.5 * (right - left);
                    let narrow = middle <= left || middle >= right || open == MOST_HALVINGS;
                    if !narrow && !matches!(answer, PolynomialTest::WithinRounding) {
                        ends[open] = middle;
                        open += 1;
                        continue;
                    }
                    if coarse {
                        return hidden();
                    }
                    return Ok(StepOutcome::Grazing { time: middle, value: along(middle) });
                }
            };
            if let (Some(before), Some(after)) = (self.side, side_after)
                && self.direction.admits(before, after)
            {
                let time = root(along, left, right, before)?;
                return Ok(StepOutcome::Crossing { time });
            }
            // The guard left a start at zero to the side of its rate. Then it came back and passed through zero within
            // rounding: this interval contains a crossing that no test has shown.
            if let (None, Some(after), Some(rate)) = (self.side, side_after, self.rate)
                && rate != after
                && self.direction.leads_to(after)
            {
                return Ok(StepOutcome::HiddenByRounding { until: right });
            }
            self.side = side_after.or(self.side);
            left = right;
        }
        Err(Error::NoConvergence { left, right: step.to, iterations: MOST_INTERVALS })
    }

    /// The side after an interval on which the guard is monotone, with its `value` at the end.
    fn side_after(&self, value: f64, slope: f64) -> Option<f64> {
        match self.side {
            None => Some(slope),
            Some(side) if slope * side < 0.0 && value * side < 0.0 => Some(-side),
            same => same,
        }
    }
}

/// The zero in an interval that the guard enters on the side `before` and leaves on the other.
fn root(along: impl Fn(f64) -> f64, left: f64, right: f64, before: f64) -> Result<f64, Error> {
    // By the test the sign changes in the interval. Within rounding the computed values may show no change at one of
    // the ends. Then that end is the zero.
    if along(left) * before <= 0.0 {
        return Ok(left);
    }
    let at_right = along(right);
    if at_right * before >= 0.0 {
        return Ok(right);
    }
    let root = bracketed_root(&along, left, right)?;
    Ok(step_to_sign(along, root, right, at_right))
}
