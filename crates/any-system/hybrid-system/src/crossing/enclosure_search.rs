//! A guard with bounds that the model gives.
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

use super::bounded::{Bounded, Leave};
use super::zero_test::ZeroTest;
use crate::error::Error;
use interval_arithmetic::Enclosure;

/// Highest order of a zero at the start that is tested. A model gives only a few derivatives; the limit only bounds the
/// array of lower terms. A zero of higher order is [`Error::UndecidedSign`].
const HIGHEST_ORDER: u32 = 16;

/// Relative margin on the half length of an interval. Two differences and a product round by ε/2 each; 4ε is more than
/// these roundings together. A larger margin would only make the tests slightly weaker.
const RADIUS_MARGIN: f64 = 4.0 * f64::EPSILON;

/// An interval is hidden if the enclosure at its middle holds zero, and the guard stays within this many half
/// widths of that enclosure. A smaller number would halve intervals on which the enclosure of one point is not
/// narrower; a larger one would hide zeros that shorter intervals show.
const HIDDEN: f64 = 4.0;

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
    /// The side to which the guard leaves its zero at the start, ±1. The value at the start is zero with this `error`.
    pub(crate) fn side_after_zero(&self, horizon: f64, error: f64) -> Result<f64, Error> {
        match self.leave(0.0, horizon, error)? {
            Leave::To { side, .. } => Ok(side),
            Leave::Stays | Leave::Hidden => {
                Err(Error::UndecidedSign { order: 0, value: (self.value)(0.0) })
            }
        }
    }

    /// The model's enclosure, if there is one; an error unless it is an interval.
    fn enclosed(&self, order: u32, times: (f64, f64)) -> Result<Option<Enclosure>, Error> {
        match (self.enclosure)(order, times) {
            // The condition is also true for NaN.
            Some(found) if !(found.low() <= found.high()) => {
                let (low, high) = (found.low(), found.high());
                Err(Error::BadEnclosure { order, from: times.0, to: times.1, low, high })
            }
            other => Ok(other),
        }
    }

    /// Bounds on the guard, or a derivative, at one time; (−∞, ∞) if the model gives none.
    fn around(&self, order: u32, time: f64) -> Result<Enclosure, Error> {
        let all = Enclosure::WHOLE;
        Ok(self.enclosed(order, (time, time))?.unwrap_or(all))
    }
}

impl<V, E> Bounded for EnclosedGuard<V, E>
where
    V: Fn(f64) -> f64,
    E: Fn(u32, (f64, f64)) -> Option<Enclosure>,
{
    fn value(&self, time: f64) -> f64 {
        (self.value)(time)
    }

    fn at(&self, time: f64) -> Result<Enclosure, Error> {
        self.around(0, time)
    }

    /// The four tests at the head of this file, cheapest first.
    fn test(&self, left: f64, right: f64, level: f64) -> Result<ZeroTest, Error> {
        let values = self.enclosed(0, (left, right))?.map(|values| values - level);
        if let Some(sign) = values.and_then(|values| values.sign()) {
            return Ok(ZeroTest::NoZero { sign });
        }
        let middle = left + 0.5 * (right - left);
        let radius = (right - middle).max(middle - left) * (1.0 + RADIUS_MARGIN);
        let slopes = self.enclosed(1, (left, right))?;
        if let Some(slope) = slopes.and_then(|slopes| slopes.sign()) {
            return Ok(ZeroTest::Monotone { slope });
        }
        let here = self.around(0, middle)? - level;
        let moved = slopes.map(|slopes| here.widened(slopes.magnitude() * radius));
        if let Some(sign) = moved.and_then(|moved| moved.sign()) {
            return Ok(ZeroTest::NoZero { sign });
        }
        if let Some(bends) = self.enclosed(2, (left, right))?
            && let Some(slope) = self.around(1, middle)?.widened(bends.magnitude() * radius).sign()
        {
            return Ok(ZeroTest::Monotone { slope });
        }
        // The narrower of the two enclosures of the values, against the enclosure at one time.
        let farthest = [values, moved]
            .iter()
            .flatten()
            .map(Enclosure::magnitude)
            .fold(f64::INFINITY, f64::min);
        if here.sign().is_none() && farthest <= HIDDEN * 0.5 * (here.high() - here.low()) {
            return Ok(ZeroTest::Hidden);
        }
        Ok(ZeroTest::Undecided)
    }

    /// Statements (4) and (5) of [mathematics](crate::mathematics): the first derivative whose enclosure at the start
    /// excludes zero decides, unless the lower derivatives, which may be zero, can outweigh it for too long.
    fn leave(&self, from: f64, until: f64, error: f64) -> Result<Leave, Error> {
        let start_hidden = self.around(0, from)?.magnitude() + error;
        // lower[j] ≥ |g⁽ʲ⁾|/j! at the start, for the derivatives that may be zero.
        let (mut lower, mut factorial) = ([0.0; HIGHEST_ORDER as usize + 1], 1.0);
        for order in 1..=HIGHEST_ORDER {
            let Some(here) = self.enclosed(order, (from, from))? else { break };
            factorial *= f64::from(order);
            let Some(side) = here.sign() else {
                lower[order as usize] = here.magnitude() / factorial;
                continue;
            };
            // On a stretch of length zero the derivative alone decides.
            if !(until > from) {
                return Ok(Leave::To { time: from, side });
            }
            let mut length = until - from;
            while from + length > from {
                let Some(bound) = self.enclosed(order, (from, from + length))? else { break };
                if let Some(side) = bound.sign() {
                    // g⁽ᵏ⁾ keeps its sign up to this time: |g| ≥ leading τᵏ − Σ lower[j] τʲ, τ = t − from.
                    let leading = bound.low().abs().min(bound.high().abs()) / factorial;
                    let ratio = |j: u32| f64::from(order) * lower[j as usize] / leading;
                    // From `clear` on, each of the lower terms (fewer than k) is at most leading τᵏ/(2k).
                    let clear = (1..order)
                        .map(|j| pxfm::f_pow(2.0 * ratio(j), 1.0 / f64::from(order - j)))
                        .fold(0.0, f64::max);
                    // Before `clear` the lower terms must not change the guard by more than its error at the start.
                    let reached: f64 = (1..order)
                        .map(|j| lower[j as usize] * pxfm::f_pow(clear, f64::from(j)))
                        .sum();
                    if clear < length && reached <= start_hidden {
                        return Ok(Leave::To { time: from + length, side });
                    }
                    break;
                }
                length *= 0.5;
            }
            break;
        }
        Ok(Leave::Hidden)
    }

    /// With the rate s at `time` and e = 2|g(time)|/s: if |g′| ≥ s/2 within e of `time`, g reaches zero within e.
    /// Else the interval is the bound.
    fn root_error(&self, time: f64, left: f64, right: f64) -> Result<f64, Error> {
        let here = self.around(0, time)?.magnitude();
        let slope = self.around(1, time)?;
        let error = 2.0 * here / slope.low().abs().min(slope.high().abs());
        let times = ((time - error).max(left), (time + error).min(right));
        // The first condition is false for NaN, and for a model that gives no slopes.
        if times.0 <= times.1
            && let Some(slopes) = self.enclosed(1, times)?
            && slopes.sign().is_some()
            && slopes.low().abs().min(slopes.high().abs()) * error >= here
        {
            return Ok(error.min(right - left));
        }
        Ok(right - left)
    }
}
