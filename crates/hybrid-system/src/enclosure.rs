//! Guards along a flow by bounds that the model gives: the first zero, with certainty.
//!
//! With enclosures G₀, G₁, G₂ of g, g′ and g″ on an interval with middle m and half length r:
//!
//! ```text
//!   0 ∉ G₀,  or  0 ∉ g(m) ± r |G₁|      no zero on the interval
//!   0 ∉ G₁,  or  0 ∉ g′(m) ± r |G₂|     monotone: a zero if and only if its sign changes
//!   else                                the interval is halved
//! ```

use crate::certain_crossing::closest;
use crate::{Direction, Error, FirstCrossing, bracketed_root};

/// An interval that holds a number, or all values of a function, for certain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Enclosure {
    /// No value is below.
    pub low: f64,
    /// No value is above.
    pub high: f64,
}

impl Enclosure {
    /// [low, high].
    pub const fn new(low: f64, high: f64) -> Self {
        Enclosure { low, high }
    }

    /// A value that may be off by `error`.
    pub const fn around(value: f64, error: f64) -> Self {
        Enclosure { low: value - error, high: value + error }
    }

    /// The sign that all values have, if they have one.
    pub fn sign(&self) -> Option<f64> {
        if self.low > 0.0 {
            Some(1.0)
        } else if self.high < 0.0 {
            Some(-1.0)
        } else {
            None
        }
    }

    fn size(&self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    fn widened(&self, by: f64) -> Self {
        Enclosure { low: self.low - by, high: self.high + by }
    }
}

/// Highest order of a zero at the start.
const ORDERS: u32 = 16;

/// Most intervals looked at.
const INTERVALS: usize = 1_000_000;

/// A guard along a flow: its values, and enclosures by order and interval.
pub(crate) struct Enclosed<V, E> {
    pub(crate) value: V,
    pub(crate) enclosure: E,
}

/// What an interval holds.
enum Found {
    Nothing(f64),
    Monotone,
    Unknown,
}

impl<V, E> Enclosed<V, E>
where
    V: Fn(f64) -> f64,
    E: Fn(u32, (f64, f64)) -> Option<Enclosure>,
{
    /// The first crossing strictly after time zero, up to `horizon`.
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
        let (mut left, mut side) = self.leave(horizon, start_error)?;
        let mut ends = vec![horizon];
        for _ in 0..INTERVALS {
            let Some(&right) = ends.last() else { return Ok(FirstCrossing::Never) };
            if left >= right {
                ends.pop();
                continue;
            }
            match self.look(left, right)? {
                Found::Nothing(sign) if sign != side && direction.admits(side, sign) => {
                    // The zero that rounding hid lies where the intervals meet.
                    return Ok(FirstCrossing::At { time: left, rising: side < 0.0 });
                }
                Found::Nothing(sign) => (left, side) = (right, sign),
                Found::Monotone => {
                    // A zero that rounding hides at the end belongs to the next interval, if there is one.
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
                Found::Unknown => {
                    let middle = left + 0.5 * (right - left);
                    if middle > left && middle < right {
                        ends.push(middle);
                        continue;
                    }
                    let clear =
                        |time| matches!(self.at(0, time), Ok(value) if value.sign().is_some());
                    let ahead = (left, right - left, horizon);
                    let (time, value) = closest(&self.value, clear, side, ahead);
                    return Ok(FirstCrossing::Grazing { time, value });
                }
            }
        }
        Err(Error::NoConvergence { left, right: horizon, iterations: INTERVALS })
    }

    /// How the guard leaves its start: a time up to which it has no further zero, and its side.
    fn leave(&self, horizon: f64, start_error: f64) -> Result<(f64, f64), Error> {
        if let Some(side) = self.at(0, 0.0)?.widened(start_error).sign() {
            return Ok((0.0, side));
        }
        // Lower derivatives that may be zero: as long as they could outweigh the first that is not, the guard must be
        // within its own error at the start.
        let hidden = self.at(0, 0.0)?.size() + start_error;
        let (mut lower, mut factorial) = ([0.0; ORDERS as usize + 1], 1.0);
        for order in 1..=ORDERS {
            let Some(here) = self.enclosed(order, (0.0, 0.0))? else { break };
            factorial *= f64::from(order);
            if here.sign().is_none() {
                lower[order as usize] = here.size() / factorial;
                continue;
            }
            let mut time = horizon;
            while time > 0.0 {
                let Some(bound) = self.enclosed(order, (0.0, time))? else { break };
                if let Some(side) = bound.sign() {
                    let leading = bound.low.abs().min(bound.high.abs()) / factorial;
                    let share = |j: u32| f64::from(order) * lower[j as usize] / leading;
                    let clear = (1..order)
                        .map(|j| pxfm::f_pow(2.0 * share(j), 1.0 / f64::from(order - j)))
                        .fold(0.0, f64::max);
                    let reached: f64 = (1..order)
                        .map(|j| lower[j as usize] * pxfm::f_pow(clear, f64::from(j)))
                        .sum();
                    if clear < time && reached <= hidden {
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

    fn enclosed(&self, order: u32, times: (f64, f64)) -> Result<Option<Enclosure>, Error> {
        match (self.enclosure)(order, times) {
            Some(Enclosure { low, high }) if !(low <= high) => {
                Err(Error::BadEnclosure { order, from: times.0, to: times.1, low, high })
            }
            other => Ok(other),
        }
    }

    /// The guard, or its slope, at one time.
    fn at(&self, order: u32, time: f64) -> Result<Enclosure, Error> {
        let all = Enclosure { low: f64::NEG_INFINITY, high: f64::INFINITY };
        Ok(self.enclosed(order, (time, time))?.unwrap_or(all))
    }

    fn look(&self, left: f64, right: f64) -> Result<Found, Error> {
        if let Some(sign) = self.enclosed(0, (left, right))?.and_then(|values| values.sign()) {
            return Ok(Found::Nothing(sign));
        }
        let middle = left + 0.5 * (right - left);
        // Rounded outwards.
        let radius = (right - middle).max(middle - left) * (1.0 + 4.0 * f64::EPSILON);
        let slopes = self.enclosed(1, (left, right))?;
        if slopes.is_some_and(|slopes| slopes.sign().is_some()) {
            return Ok(Found::Monotone);
        }
        if let Some(slopes) = slopes
            && let Some(sign) = self.at(0, middle)?.widened(slopes.size() * radius).sign()
        {
            return Ok(Found::Nothing(sign));
        }
        if let Some(bends) = self.enclosed(2, (left, right))?
            && self.at(1, middle)?.widened(bends.size() * radius).sign().is_some()
        {
            return Ok(Found::Monotone);
        }
        Ok(Found::Unknown)
    }

    /// The only zero of a monotone stretch that begins on `side`.
    fn root(&self, left: f64, right: f64, side: f64) -> Result<f64, Error> {
        if (self.value)(left) * side <= 0.0 {
            return Ok(left);
        }
        if (self.value)(right) * side >= 0.0 {
            return Ok(right);
        }
        let mut time = bracketed_root(&self.value, left, right)?;
        // A search that goes on from there does not find it again.
        let mut step = 1;
        while time < right && (self.value)(time) * side > 0.0 {
            time = f64::from_bits(time.to_bits() + step).min(right);
            step *= 2;
        }
        Ok(time)
    }
}
