//! The time and the state of a crossing without the rounding of the interpolant, and two errors of the time: by
//! rounding, and by the error of the flow.

use super::step::Step;
use super::stepping::Stepping;
use super::tolerances::Tolerances;
use crate::crossing::{change_by_components, clear_distance, rounding_of_state};
use crate::error::Error;
use crate::state::StateVector;
use interval_arithmetic::root_beyond;

/// The largest distances by which a crossing is moved when it is polished, in units of the step. The smallest distance
/// that shows a change of sign is used. The error of an interpolant moves a guard of ordinary slope by the
/// tolerance, or by its rounding; a guard that is crossed slowly needs more. If the last value shows no change of
/// sign, the crossing of the interpolant is kept.
const POLISHING_REACHES: [f64; 6] = [1e-14, 1e-12, 1e-10, 1e-8, 1e-6, 1e-4];

/// Most corrections of one crossing. Each of them makes the last move smaller by the relative error of the
/// interpolant: two are enough at tolerances up to 10⁻⁵. Each costs the stages of a step.
const CORRECTIONS: u32 = 3;

/// The rate of a polynomial of degree nine on a step is at most this many times its size, over the length of the
/// step: 2·9², by Markov's inequality.
const BEND: f64 = 162.0;

/// The rate of a guard at a crossing is taken over this part of the step on both sides. Over a shorter part rounding
/// would show, over a longer one the bend of the guard.
const RATE_REACH: f64 = 1e-4;

/// A guard that differs from zero by this part of its error counts as clear of it: one quarter is left for the bend of
/// the guard between the crossing and that place.
const CLEAR: f64 = 0.75;

/// A guard jumps at its zero if it changes there, between two neighbouring doubles, this many times more than by
/// its rate. A smaller number would take the rounding of a guard for a jump, which costs some evaluations; a larger
/// one would give a jump an error of up to this many ulps too much.
const JUMP: f64 = 1e3;

/// Values of a guard on each side of its zero that must agree before they tell its direction: signs of pure rounding
/// do so once in 2¹⁵. A larger number would cost evaluations of a guard that jumps, for each event.
const AGREEING: u32 = 8;

/// The first distance at which signs are compared is the time in which the state moves by so many of its roundings.
/// At a shorter one several values would be those of one and the same rounded state.
const STATE_ULPS: f64 = 16.0;

/// How accurate a flow is: its tolerances, and what they act on.
#[derive(Clone, Copy)]
pub(super) struct Accuracy<'a, V> {
    pub(super) tolerances: Tolerances,
    /// The number of steps from the start.
    pub(super) steps: usize,
    /// The largest absolute value of each component at their ends: a component may be zero at the event.
    pub(super) sizes: &'a V,
}

impl<V: StateVector> Accuracy<'_, V> {
    /// An estimate of the error of a guard by the error of the flow: the change of the guard if each component
    /// changes by its tolerance on every step. Growth or decay of these errors along the flow is not known here.
    pub(super) fn guard_error(&self, state: &V, guard: impl Fn(&V) -> f64) -> f64 {
        let unit = |axis: usize| self.tolerances.of(axis, self.sizes.components()[axis]);
        change_by_components(state, |axis| self.steps as f64 * unit(axis), &guard)
    }
}

/// A step whose interpolant is corrected next to a crossing.
pub(super) struct CorrectedStep<'a, V> {
    step: &'a Step<V>,
    /// What is added to the interpolant.
    correction: Option<V>,
}

impl<'a, V: StateVector> CorrectedStep<'a, V> {
    /// The step as it is.
    pub(super) fn uncorrected(step: &'a Step<V>) -> Self {
        CorrectedStep { step, correction: None }
    }

    /// The step, moved so that it ends at this state: its polynomial may end beside it.
    pub(super) fn ending_at(step: &'a Step<V>, state: &V) -> Self {
        let mut correction = state.clone();
        correction.add_scaled(-1.0, &step.state(step.to));
        CorrectedStep { step, correction: Some(correction) }
    }

    /// The state at a time of the step.
    pub(super) fn state(&self, time: f64) -> V {
        let mut state = self.step.state(time);
        if let Some(correction) = &self.correction {
            state.add_scaled(1.0, correction);
        }
        state
    }

    /// Where the step begins.
    pub(super) fn from(&self) -> f64 {
        self.step.from
    }

    /// The first zero of a guard that is on `side` where the step begins and no longer so at a time with this
    /// value; `None` if the values show no side before.
    pub(super) fn first_zero(
        &self,
        (until, at_until): (f64, f64),
        side: f64,
        along: impl Fn(f64) -> f64,
    ) -> Result<Option<f64>, Error> {
        let Step { from, to, .. } = *self.step;
        let reaches = POLISHING_REACHES.map(|fraction| fraction * (to - from)).into_iter();
        for reach in reaches.chain([to - from]) {
            let left = (until - reach).max(from);
            let at_left = along(left);
            if at_left * side > 0.0 {
                return Ok(Some(root_beyond(&along, (left, at_left), (until, at_until))?));
            }
        }
        Ok(None)
    }

    /// The zero of a guard near `time`, on the shortest distance that shows a change of sign; `None` if none of them
    /// does.
    fn zero_near(
        &self,
        (time, hidden): (f64, f64),
        guard: impl Fn(&V) -> f64,
    ) -> Result<Option<f64>, Error> {
        let Step { from, to, .. } = *self.step;
        let along = |time: f64| guard(&self.state(time));
        let reaches = POLISHING_REACHES.map(|fraction| fraction * (to - from)).into_iter();
        for reach in reaches.chain([hidden]) {
            // A hidden stretch begins at the last double before its zero, which rounding of the difference must not
            // miss.
            let (left, right) = ((time - reach).next_down().max(from), (time + reach).min(to));
            let (before, after) = (along(left), along(right));
            if before.signum() != after.signum() {
                // The first double at which the guard is zero, or has its new sign.
                return Ok(Some(root_beyond(&along, (left, before), (right, after))?));
            }
        }
        Ok(None)
    }

    /// The states beside a zero at `time`, before and behind it.
    pub(super) fn beside(&self, time: f64) -> [V; 2] {
        let Step { from, to, .. } = *self.step;
        let reach = RATE_REACH * (to - from);
        [(time - reach).max(from), (time + reach).min(to)].map(|time| self.state(time))
    }

    /// True if a guard that jumps at its zero does not pass it in the direction that `rising` says.
    ///
    /// A sum of components is rounded, and a guard that jumps where the sum is zero changes its sign several times
    /// within that rounding. The shortest time at which the values on each side agree tells from where the guard comes.
    pub(super) fn is_no_crossing(
        &self,
        time: f64,
        rising: bool,
        guard: impl Fn(&V) -> f64,
    ) -> bool {
        if !self.jumps(time, &guard) || !self.is_no_rounding(time, &guard) {
            return false;
        }
        let Step { from, to, .. } = *self.step;
        let sign = |time: f64| guard(&self.state(time.clamp(from, to))).signum();
        let agreed = |distance: f64| {
            let part = |k: u32| 1.0 - f64::from(k) / f64::from(2 * AGREEING);
            let first = sign(time + distance);
            let agree = (1..AGREEING).all(|k| sign(time + part(k) * distance) == first);
            agree.then_some(first)
        };
        let mut distance = self.moved_by_rounding(time);
        let longest = POLISHING_REACHES[POLISHING_REACHES.len() - 1] * (to - from);
        while distance < longest {
            if let (Some(before), Some(behind)) = (agreed(-distance), agreed(distance)) {
                return before == behind || (behind > 0.0) != rising;
            }
            distance *= 2.0;
        }
        false
    }

    /// The time in which the state moves by some roundings of its largest component.
    fn moved_by_rounding(&self, time: f64) -> f64 {
        let [before, behind] = self.beside(time);
        let length = 2.0 * RATE_REACH * (self.step.to - self.step.from);
        let mut moved = behind;
        moved.add_scaled(-1.0, &before);
        let by_state = STATE_ULPS * f64::EPSILON * before.largest() * length / moved.largest();
        by_state.max(2.0 * f64::EPSILON * time)
    }

    /// The change of a guard from the double before `time`.
    fn change_at(&self, time: f64, guard: impl Fn(&V) -> f64) -> f64 {
        (guard(&self.state(time)) - guard(&self.state(time.next_down()))).abs()
    }

    /// True if the guard changes at `time` by much more than its rounding beside it.
    fn is_no_rounding(&self, time: f64, guard: impl Fn(&V) -> f64) -> bool {
        let jump = self.change_at(time, &guard);
        let size = self.step.rounding_size();
        let beside = self.beside(time);
        beside.iter().all(|state| jump > JUMP * rounding_of_state(state, &size, &guard))
    }

    /// True if the guard jumps at its zero: it changes between two neighbouring doubles much more than by its rate.
    fn jumps(&self, time: f64, guard: impl Fn(&V) -> f64) -> bool {
        let rate = rate(self.step, time, &guard).abs();
        let jump = self.change_at(time, &guard);
        jump > JUMP * rate * (time - time.next_down())
    }

    /// The distance in time at which the guard differs from zero by more than its `error` there, at both sides of
    /// its zero at `time`. It is at most the length of the step: farther away the guard is not looked at. If the
    /// search has seen that rounding hides the guard for the time `hidden` before the crossing, also on earlier
    /// steps, it is no less.
    fn clear_distance(
        &self,
        (time, hidden, first): (f64, f64, f64),
        guard: impl Fn(&V) -> f64,
        error: impl Fn(&V) -> f64,
    ) -> f64 {
        let Step { from, to, .. } = *self.step;
        // Where the step ends, the other side alone decides.
        let clear_at = |moved: f64| {
            let state = self.state(moved.clamp(from, to));
            moved < from || moved > to || guard(&state).abs() > CLEAR * error(&state)
        };
        let clear = |distance: f64| clear_at(time - distance) && clear_at(time + distance);
        // At the start of an arc the time has no ulp to begin with.
        let ulp = f64::EPSILON * if time > 0.0 { time } else { to - from };
        let first = first.max(ulp).max(hidden);
        clear_distance(first, (to - from).max(hidden), clear)
    }

    /// How far the zero of the guard along the computed trajectory may be from `time`: where the guard is clear of its
    /// `rounding`.
    pub(super) fn time_rounding(
        &self,
        (time, hidden): (f64, f64),
        guard: impl Fn(&V) -> f64,
        rounding: impl Fn(&V) -> f64,
    ) -> f64 {
        self.clear_distance((time, hidden, 0.0), guard, rounding)
    }

    /// How far the event of the true trajectory may be from `time`: where the guard is clear of the error of the flow.
    ///
    /// For a guard that is crossed at the rate ġ this is the error over |ġ|. At a touch it is about the root of the
    /// error. At a jump it is the time in which the flow moves by its own error.
    pub(super) fn time_error(
        &self,
        (time, time_rounding): (f64, f64),
        guard: impl Fn(&V) -> f64,
        accuracy: Accuracy<V>,
    ) -> f64 {
        let error = |state: &V| accuracy.guard_error(state, &guard);
        let first = match self.jumps(time, &guard) {
            true => 0.0,
            false => error(&self.state(time)) / rate(self.step, time, &guard).abs(),
        };
        self.clear_distance((time, time_rounding, first.max(time_rounding)), &guard, error)
    }
}

/// A crossing without the error of the interpolant, and the step on which it lies.
///
/// A separate step from the start of the last step to `time` gives the state without that error. The difference
/// between the two states changes little around `time`. Therefore it is added to the interpolant, and the crossing
/// is searched again next to the old one. Where it has moved so far that the difference may have changed, the step is
/// corrected there once more: an execution that ends at the time of its event ends on the surface. The rounding of the
/// interpolant may hide the guard for a time `hidden` around the crossing: the values with the correction show a
/// change of sign there.
pub(super) fn polished<'a, V: StateVector>(
    integration: &mut impl Stepping<V>,
    step: &'a Step<V>,
    (time, hidden): (f64, f64),
    until: f64,
    guard: impl Fn(&V) -> f64,
) -> Result<(f64, CorrectedStep<'a, V>), Error> {
    let uncorrected = CorrectedStep::uncorrected(step);
    let (mut best, mut near) = ((time, uncorrected), time);
    for _ in 0..CORRECTIONS {
        // Here the separate step would have length zero.
        if near <= step.from {
            break;
        }
        let Some(directly) = integration.directly_at(near) else {
            let moved = best.1.zero_near((near, hidden), &guard)?;
            best.0 = moved.map_or(best.0, |moved| moved.min(until));
            break;
        };
        let mut correction = directly?;
        correction.add_scaled(-1.0, &step.state(near));
        let size = correction.largest();
        let corrected = CorrectedStep { step, correction: Some(correction) };
        let Some(moved) = corrected.zero_near((near, hidden), &guard)? else { break };
        // The difference changes by this at most, if it is a polynomial like the interpolant.
        let change = BEND * size * (moved - near).abs() / (step.to - step.from);
        let is_rounding = change <= f64::EPSILON * corrected.state(moved).largest();
        best = (moved.min(until), corrected);
        if is_rounding || moved == near {
            break;
        }
        near = moved;
    }
    Ok(best)
}

/// ġ at a time of the step, by a difference along the interpolant.
pub(super) fn rate<V: StateVector>(step: &Step<V>, time: f64, guard: impl Fn(&V) -> f64) -> f64 {
    let reach = RATE_REACH * (step.to - step.from);
    let (left, right) = ((time - reach).max(step.from), (time + reach).min(step.to));
    (guard(&step.state(right)) - guard(&step.state(left))) / (right - left)
}
