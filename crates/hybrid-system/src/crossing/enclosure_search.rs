//! The first zero of a guard by bounds that the model gives.
//!
//! With enclosures G₀, G₁, G₂ of g, g′ and g″ on an interval with middle m and half length r:
//!
//! ```text
//!   0 ∉ G₀,  or  0 ∉ g(m) ± r |G₁|      no zero on the interval
//!   0 ∉ G₁,  or  0 ∉ g′(m) ± r |G₂|     monotone: a zero if and only if its sign changes
//!   else                                the interval is halved
//! ```
//!
//! These are statements (2) and (3) of [mathematics](crate::mathematics), with the model's bounds.

use super::bracketed_root::bracketed_root;
use super::closest_approach::closest_approach;
use super::enclosure::Enclosure;
use super::first_crossing::FirstCrossing;
use super::step_past_root::step_past_root;
use super::zero_test::ZeroTest;
use crate::error::Error;
use crate::guard::Direction;

/// Highest order of a zero at the start that is tested. A model gives only a few derivatives; the limit only bounds the
/// array of lower terms. A zero of higher order is [`Error::UndecidedSign`].
const HIGHEST_ORDER: u32 = 16;

/// Most intervals that are tested: a limit for a search that would not end. Enclosures that are too wide for any
/// decision reach it. The search then ends with [`Error::NoConvergence`].
const MOST_INTERVALS: usize = 1_000_000;

/// Relative margin on the half length of an interval. Two differences and a product round by ε/2 each; 4ε is more than
/// these roundings together. A larger margin would only make the tests slightly weaker.
const RADIUS_MARGIN: f64 = 4.0 * f64::EPSILON;

/// A guard along a flow: its values, and its enclosures by order and interval.
pub(crate) struct EnclosedGuard<V, E> {
    pub(crate) value: V,
    pub(crate) enclosure: E,
}

impl<V, E> EnclosedGuard<V, E>
where
    V: Fn(f64) -> f64,
    E: Fn(u32, (f64, f64)) -> Option<Enclosure>,
{
    /// The first crossing strictly after time zero, up to `horizon`. The value at the start may be wrong by
    /// `start_error`.
    pub(crate) fn first_crossing(
        &self,
        direction: Direction,
        horizon: f64,
        start_error: f64,
    ) -> Result<FirstCrossing, Error> {
        if !(horizon >= 0.0 && horizon.is_finite()) {
            return Err(Error::BadLimit { what: "the horizon of a search", value: horizon });
        }
        if horizon == 0.0 {
            return Ok(FirstCrossing::Never);
        }
        // Invariant: no crossing in (0, left], and the guard is on `side` just after `left`. The rest is divided into
        // intervals; `ends` holds their right ends, the nearest one last.
        let (mut left, mut side) = self.leave_start(horizon, start_error)?;
        let mut ends = vec![horizon];
        for _ in 0..MOST_INTERVALS {
            let Some(&right) = ends.last() else { return Ok(FirstCrossing::Never) };
            if left >= right {
                ends.pop();
                continue;
            }
            match self.test(left, right)? {
                ZeroTest::NoZero { sign } if sign != side && direction.admits(side, sign) => {
                    // Rounding hid the zero from both tests. The zero lies where the two intervals meet.
                    return Ok(FirstCrossing::At { time: left, rising: side < 0.0 });
                }
                ZeroTest::NoZero { sign } => (left, side) = (right, sign),
                ZeroTest::Monotone { .. } => {
                    // If rounding hides the sign at the right end, the next interval decides. The last interval has no
                    // next one: there the computed value decides.
                    let after = match self.at(0, right)?.sign() {
                        Some(sign) => sign,
                        None if right < horizon => side,
                        None => (self.value)(right),
                    };
                    if after * side < 0.0 || after == 0.0 {
                        if direction.admits(side, -side) {
                            let time = self.root(left, right, side)?;
                            return Ok(FirstCrossing::At { time, rising: side < 0.0 });
                        }
                        side = -side;
                    }
                    left = right;
                }
                ZeroTest::Undecided => {
                    let middle = left + 0.5 * (right - left);
                    if middle > left && middle < right {
                        ends.push(middle);
                        continue;
                    }
                    // Two neighbouring doubles: halving cannot help.
                    let clear =
                        |time| matches!(self.at(0, time), Ok(value) if value.sign().is_some());
                    let ahead = (left, right - left, horizon);
                    let (time, value) = closest_approach(&self.value, clear, side, ahead);
                    return Ok(FirstCrossing::Grazing { time, value });
                }
            }
        }
        Err(Error::NoConvergence { left, right: horizon, iterations: MOST_INTERVALS })
    }

    /// The side to which the guard leaves its zero at the start, ±1. The value at the start is zero with this `error`.
    pub(crate) fn side_after_zero(&self, horizon: f64, error: f64) -> Result<f64, Error> {
        let error = error.max(self.at(0, 0.0)?.magnitude());
        Ok(self.leave_start(horizon, error)?.1)
    }

    /// A time up to which the guard has no zero after its start, and the sign of the guard until then.
    ///
    /// Statements (4) and (5) of [mathematics](crate::mathematics): the first derivative whose enclosure at the start
    /// excludes zero decides, unless the lower derivatives, which may be zero, can outweigh it for too long.
    fn leave_start(&self, horizon: f64, start_error: f64) -> Result<(f64, f64), Error> {
        if let Some(side) = self.at(0, 0.0)?.widened(start_error).sign() {
            return Ok((0.0, side));
        }
        let start_hidden = self.at(0, 0.0)?.magnitude() + start_error;
        // lower[j] ≥ |g⁽ʲ⁾(0)|/j! for the derivatives that may be zero.
        let (mut lower, mut factorial) = ([0.0; HIGHEST_ORDER as usize + 1], 1.0);
        for order in 1..=HIGHEST_ORDER {
            let Some(here) = self.enclosed(order, (0.0, 0.0))? else { break };
            factorial *= f64::from(order);
            if here.sign().is_none() {
                lower[order as usize] = here.magnitude() / factorial;
                continue;
            }
            let mut time = horizon;
            while time > 0.0 {
                let Some(bound) = self.enclosed(order, (0.0, time))? else { break };
                if let Some(side) = bound.sign() {
                    // g⁽ᵏ⁾ keeps its sign on [0, time]: |g| ≥ leading tᵏ − Σ lower[j] tʲ.
                    let leading = bound.low.abs().min(bound.high.abs()) / factorial;
                    let ratio = |j: u32| f64::from(order) * lower[j as usize] / leading;
                    // From `clear` on, each of the lower terms (fewer than k) is at most leading tᵏ/(2k).
                    let clear = (1..order)
                        .map(|j| pxfm::f_pow(2.0 * ratio(j), 1.0 / f64::from(order - j)))
                        .fold(0.0, f64::max);
                    // Before `clear` the lower terms must not change the guard by more than its error at the start.
                    let reached: f64 = (1..order)
                        .map(|j| lower[j as usize] * pxfm::f_pow(clear, f64::from(j)))
                        .sum();
                    if clear < time && reached <= start_hidden {
                        return Ok((time, side));
                    }
                    break;
                }
                time *= 0.5;
            }
            break;
        }
        Err(Error::UndecidedSign { order: 0, value: (self.value)(0.0) })
    }

    /// The model's enclosure, if there is one; an error unless it is an interval.
    fn enclosed(&self, order: u32, times: (f64, f64)) -> Result<Option<Enclosure>, Error> {
        match (self.enclosure)(order, times) {
            // The condition is also true for NaN.
            Some(Enclosure { low, high }) if !(low <= high) => {
                Err(Error::BadEnclosure { order, from: times.0, to: times.1, low, high })
            }
            other => Ok(other),
        }
    }

    /// Bounds on the guard, or a derivative, at one time; (−∞, ∞) if the model gives none.
    fn at(&self, order: u32, time: f64) -> Result<Enclosure, Error> {
        let all = Enclosure { low: f64::NEG_INFINITY, high: f64::INFINITY };
        Ok(self.enclosed(order, (time, time))?.unwrap_or(all))
    }

    /// The four tests at the head of this file, cheapest first.
    fn test(&self, left: f64, right: f64) -> Result<ZeroTest, Error> {
        if let Some(sign) = self.enclosed(0, (left, right))?.and_then(|values| values.sign()) {
            return Ok(ZeroTest::NoZero { sign });
        }
        let middle = left + 0.5 * (right - left);
        let radius = (right - middle).max(middle - left) * (1.0 + RADIUS_MARGIN);
        let slopes = self.enclosed(1, (left, right))?;
        if let Some(slope) = slopes.and_then(|slopes| slopes.sign()) {
            return Ok(ZeroTest::Monotone { slope });
        }
        if let Some(slopes) = slopes
            && let Some(sign) = self.at(0, middle)?.widened(slopes.magnitude() * radius).sign()
        {
            return Ok(ZeroTest::NoZero { sign });
        }
        if let Some(bends) = self.enclosed(2, (left, right))?
            && let Some(slope) = self.at(1, middle)?.widened(bends.magnitude() * radius).sign()
        {
            return Ok(ZeroTest::Monotone { slope });
        }
        Ok(ZeroTest::Undecided)
    }

    /// The only zero on a monotone interval that begins on `side`.
    fn root(&self, left: f64, right: f64, side: f64) -> Result<f64, Error> {
        // By the enclosures the interval has a zero. Within rounding the computed values may show no sign change at one
        // of the ends. Then that end is the zero.
        if (self.value)(left) * side <= 0.0 {
            return Ok(left);
        }
        if (self.value)(right) * side >= 0.0 {
            return Ok(right);
        }
        let root = bracketed_root(&self.value, left, right)?;
        Ok(step_past_root(root, right, |time| !((self.value)(time) * side > 0.0)))
    }
}
