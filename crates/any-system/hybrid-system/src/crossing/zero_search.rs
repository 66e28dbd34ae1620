//! The zeros of a function with bounds, one after the other.
//!
//! The search tests intervals from left to right. An interval is passed if it has no zero, or if the function is
//! monotone on it and its signs at both ends are clear of rounding; else it is halved. Where rounding hides the
//! function, halving does not help: the search passes the hidden interval, and decides behind it.
//!
//! ```text
//!      before     hidden     after
//!    ───────────┬────────┬───────────
//!        +      │   ?    │     −         a crossing: also a zero of third order, or a jump
//!        +      │   ?    │     +         a touch
//!        +      │   ?    │  (horizon)    undecided
//! ```
//!
//! A function may be given in pieces, such as the steps of an integrated flow. [`ZeroSearch`] is what the search
//! knows at the end of a piece.

use super::bounded::{Bounded, Leave};
use super::found::Found;
use super::hidden::{Hidden, closest};
use super::zero_test::ZeroTest;
use crate::error::Error;
use crate::guard::Direction;
use interval_arithmetic::Enclosure;
use interval_arithmetic::root_beyond;

/// Most intervals that wait to be tested. 53 halvings reach the rounding of times in the middle of a stretch. Near time
/// zero doubles are denser, and more halvings are possible: then the farthest of the shorter ones are joined again. A
/// larger number costs stack memory for each stretch; a smaller one would test some intervals twice.
const OPEN_INTERVALS: usize = 64;

/// Behind a hidden interval the value must exceed its rounding error by this factor. Next to a touch the value changes
/// slowly, and its error fluctuates: with a factor of 1 one touch could be found several times. A larger number makes
/// hidden intervals longer, and two touches next to each other become one.
const CLEAR: f64 = 2.0;

/// What a search knows of the zero at its start.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
    /// There was none, or the function has left it.
    OnSide,
    /// It is not known yet how the function leaves it.
    Leaving,
    /// The function has stayed at it up to the time of the search.
    Staying,
    /// The function has had it, and its next change of sign belongs to it.
    Passing,
}

impl Phase {
    fn is_at_start(self) -> bool {
        matches!(self, Phase::Leaving | Phase::Staying)
    }
}

/// A piece of the function: from the time at which the search begins to the one at which it ends.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    pub(super) from: f64,
    pub(super) until: f64,
    /// True if no later stretch follows.
    pub(super) is_last: bool,
}

/// The state of a search for the zeros of a function of time.
///
/// Invariant: all crossings and touches in (start, `time`] have been returned, and the function is on `side` just after
/// `time`, unless `hidden`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ZeroSearch {
    pub(super) direction: Direction,
    pub(super) time: f64,
    /// The side of zero, ±1; `None` as long as the function has not left the zero it started at.
    pub(super) side: Option<f64>,
    /// The last time at which the function was clear of rounding, on `side`.
    pub(super) clear: f64,
    pub(super) phase: Phase,
    /// True as long as the function has not been clear of the error of its start.
    pub(super) unclear: bool,
    /// The value at the start, if it counts as zero. The zeros of g − level are searched as long as g is `unclear`.
    pub(super) level: f64,
    /// The error of `level`.
    pub(super) level_error: f64,
    pub(super) hidden: Option<Hidden>,
    /// The last crossing was found before the function had left its start clearly.
    pub(super) left_hidden: bool,
}

impl ZeroSearch {
    /// The time up to which the search is done.
    pub(crate) fn time(&self) -> f64 {
        self.time
    }

    /// The side of zero just after [`time`](Self::time), ±1; `None` if the function has not left its start, or if
    /// rounding hides it.
    #[cfg(feature = "ode")]
    pub(crate) fn clear_side(&self) -> Option<f64> {
        self.side.filter(|_| !self.phase.is_at_start() && self.hidden.is_none())
    }

    /// The side on which the function is, as far as its start has told, although rounding may hide it now.
    #[cfg(feature = "ode")]
    pub(crate) fn known_side(&self) -> Option<f64> {
        self.side.filter(|_| self.phase == Phase::OnSide && self.level == 0.0)
    }

    /// True if the last crossing was found on the first interval that showed a side after the start at zero: rounding
    /// hid how the function left its start, and that it came back.
    #[cfg(feature = "ode")]
    pub(crate) fn left_hidden(&self) -> bool {
        self.left_hidden
    }

    /// Searches up to `until`. At the horizon of the whole search no later stretch follows: this one `is_last`.
    ///
    /// `budget` is the number of intervals that may still be tested. After a touch a further call goes on behind it.
    pub(crate) fn advance(
        &mut self,
        function: &impl Bounded,
        until: f64,
        is_last: bool,
        budget: &mut usize,
    ) -> Result<Found, Error> {
        if self.time >= until {
            return Ok(Found::Nothing);
        }
        let stretch = Stretch { from: self.time, until, is_last };
        if self.phase.is_at_start()
            && self.hidden.is_none()
            && let Some(found) = self.leave(function, stretch)?
        {
            return Ok(found);
        }
        if let Some(found) = self.test_intervals(function, stretch, budget)? {
            return Ok(found);
        }
        Ok(self.hidden_at_end(function, stretch))
    }

    /// Looks how the function leaves the zero that it started at, and passes the part on which it does.
    fn leave(
        &mut self,
        function: &impl Bounded,
        Stretch { from, until, .. }: Stretch,
    ) -> Result<Option<Found>, Error> {
        match (function.leave(from, until, self.level_error)?, self.side) {
            (Leave::To { time, side }, known) if known.is_none_or(|known| known == side) => {
                let stayed = self.phase == Phase::Staying;
                self.pass(function, time, side)?;
                // It has stayed at its zero, and leaves it to the side of the event.
                if stayed && self.direction.is_beyond(side) {
                    self.left_hidden = true;
                    let (error, rising) = (time - from, side > 0.0);
                    return Ok(Some(Found::Crossing { time, error, hidden: true, rising }));
                }
                Ok(None)
            }
            // The function stays zero. The side is still to be found, on the next stretch.
            (Leave::Stays, _) => {
                (self.time, self.phase) = (until, Phase::Staying);
                Ok(Some(Found::Nothing))
            }
            (Leave::Hidden | Leave::To { .. }, None) => {
                Err(Error::UndecidedSign { order: 0, value: function.value(from) })
            }
            // The caller knows the side better than the bounds do. The start is hidden.
            (Leave::Hidden | Leave::To { .. }, Some(_)) => Ok(None),
        }
    }

    /// Tests the intervals of a stretch from left to right, up to its end or to what is found.
    fn test_intervals(
        &mut self,
        function: &impl Bounded,
        stretch: Stretch,
        budget: &mut usize,
    ) -> Result<Option<Found>, Error> {
        // The right ends of the intervals that wait, the nearest one last; the first `open` entries count.
        let mut ends = [stretch.until; OPEN_INTERVALS];
        let mut open = 1;
        while open > 0 {
            let (left, right) = (self.time, ends[open - 1]);
            if left >= right {
                open -= 1;
                continue;
            }
            if *budget == 0 {
                return Ok(Some(Found::BudgetEnded));
            }
            *budget -= 1;
            let sign = match function.test(left, right, self.level)? {
                ZeroTest::NoZero { sign } => Some(sign),
                ZeroTest::Monotone { slope } => {
                    let sign = (function.at(right)? - self.level).sign();
                    if sign.is_none() {
                        // Rounding hides the sign at the right end. The next interval decides, if one follows.
                        self.time = right;
                        if right >= stretch.until
                            && let Some(found) = self.reaches_horizon(function, stretch, slope)?
                        {
                            return Ok(Some(found));
                        }
                    }
                    sign
                }
                ZeroTest::Undecided => {
                    let middle = left + 0.5 * (right - left);
                    if middle > left && middle < right {
                        if open < OPEN_INTERVALS {
                            open += 1;
                        }
                        ends[open - 1] = middle;
                    } else {
                        // Two neighbouring doubles: halving cannot help.
                        self.hide(left, right);
                    }
                    None
                }
                ZeroTest::Hidden => {
                    self.hide(left, right);
                    None
                }
            };
            let Some(sign) = sign else { continue };
            if self.hidden.is_some() && !is_clear(&(function.at(right)? - self.level)) {
                self.time = right;
                continue;
            }
            if let Some(found) = self.emerge(function, stretch.from, right, sign)? {
                return Ok(Some(found));
            }
        }
        Ok(None)
    }

    /// Passes an interval that rounding hides.
    fn hide(&mut self, left: f64, right: f64) {
        self.hidden.get_or_insert(Hidden { from: left, closest: None });
        self.time = right;
    }

    /// Passes an interval at whose end the function is clear of rounding, with this sign. Returns what lies before.
    fn emerge(
        &mut self,
        function: &impl Bounded,
        from: f64,
        right: f64,
        sign: f64,
    ) -> Result<Option<Found>, Error> {
        let left = self.time;
        let side = self.side.unwrap_or(sign);
        let hidden = self.hidden.take();
        if sign == side {
            // A hidden interval at the start is not a touch: there the function leaves its zero.
            let touch = match hidden.filter(|_| !self.unclear) {
                Some(hidden) => {
                    let (time, value) = closest(function, self.level, &hidden, from, left);
                    let until = self.clear_again(function, &hidden, (left, right), side)?;
                    let error = 0.5 * (until - hidden.from);
                    Some(Found::Touch { time, error, value, until })
                }
                None => None,
            };
            self.pass(function, right, side)?;
            return Ok(touch);
        }
        // Rounding hid how the function leaves its start, and now it is on the other side than its caller expected.
        // If both directions count, no side is beyond the surface, and this is the side to which it left.
        self.left_hidden = self.phase.is_at_start();
        let at_start = self.left_hidden && self.direction == Direction::Either;
        let passes = self.has_passed();
        let found = if self.direction.admits(side, sign) && !at_start && !passes {
            let (time, error) = match &hidden {
                // Where the function is clear again. At an earlier time a new search would start in the same hidden
                // interval, and could find a part of the same crossing.
                Some(hidden) => {
                    let time = self.clear_again(function, hidden, (left, right), sign)?;
                    (time, time - hidden.from)
                }
                None => {
                    // A stretch before this one is not known any more.
                    let after = self.clear.max(from);
                    let time = self.root(function, side, after, left, right)?;
                    (time, function.root_error(time, after, right)?)
                }
            };
            let hidden = hidden.is_some();
            Some(Found::Crossing { time, error, hidden, rising: side < 0.0 })
        } else {
            None
        };
        self.pass(function, right, sign)?;
        Ok(found)
    }

    /// The first of some times from `left` to `right` at which the function is clear of rounding behind a hidden
    /// interval. It is monotone or clear there, and clear at `right`.
    fn clear_again(
        &self,
        function: &impl Bounded,
        hidden: &Hidden,
        (left, right): (f64, f64),
        sign: f64,
    ) -> Result<f64, Error> {
        let (mut time, mut step) = (left, (left - hidden.from).max(f64::EPSILON * left));
        while time < right && (function.at(time)? - self.level).sign() != Some(sign) {
            time = (time + step).min(right);
            step *= 2.0;
        }
        Ok(time)
    }

    /// Whether a change of sign belongs to a zero before the start. The next one does not.
    pub(super) fn has_passed(&mut self) -> bool {
        let passes = self.phase == Phase::Passing;
        if passes {
            self.phase = Phase::OnSide;
        }
        passes
    }

    /// Moves to `time`, where the function is clearly on `side`.
    fn pass(&mut self, function: &impl Bounded, time: f64, side: f64) -> Result<(), Error> {
        (self.time, self.clear, self.side) = (time, time, Some(side));
        if self.phase.is_at_start() {
            self.phase = Phase::OnSide;
        }
        if self.unclear {
            let value = function.at(time)?;
            let is_clear =
                |level: f64| (value - level).widened(self.level_error).sign() == Some(side);
            if is_clear(0.0) && is_clear(self.level) {
                (self.unclear, self.level) = (false, 0.0);
            }
        }
        Ok(())
    }

    /// The first time at which the computed function has left `side`, between `after` and `right`. By the bounds it has
    /// left it at `right`, and it is monotone, hidden or without zero after `left`.
    pub(super) fn root(
        &self,
        function: &impl Bounded,
        side: f64,
        after: f64,
        left: f64,
        right: f64,
    ) -> Result<f64, Error> {
        let value = |time: f64| function.value(time) - self.level;
        let (at_first, at_last) = (value(after), value(right));
        // Within rounding, or after a jump, the computed values may show no change of sign. Then the end is the zero.
        if at_first * side <= 0.0 {
            return Ok(left);
        }
        if at_last * side >= 0.0 {
            return Ok(right);
        }
        Ok(root_beyond(&value, (after, at_first), (right, at_last))?)
    }
}

/// True if all values of the interval exceed [`CLEAR`] times its half width.
fn is_clear(value: &Enclosure) -> bool {
    let error = 0.5 * (value.high() - value.low());
    value.widened((CLEAR - 1.0) * error).sign().is_some()
}
