//! The first zero of a [`QuasiPolynomial`], with certainty.
//!
//! On an interval with middle m and half length r, and |g″| ≤ B on it,
//!
//! ```text
//!   |g(m)|  > |g′(m)| r + ½ B r² + rounding    no zero on the interval
//!   |g′(m)| > B r + rounding                   g is monotone: a zero if and only if its sign changes
//!   else                                       the interval is halved
//! ```
//!
//! These are statements (2) and (3) of [mathematics](crate::mathematics). Statements (4) and (5) tell how the function
//! leaves a start at zero.

use super::bracketed_root::bracketed_root;
use super::closest_approach::closest_approach;
use super::first_crossing::FirstCrossing;
use super::quasi_polynomial::QuasiPolynomial;
use super::step_past_root::step_past_root;
use super::zero_test::ZeroTest;
use crate::error::Error;
use crate::guard::Direction;

/// A value is clear of rounding if it exceeds its rounding error by this factor. The factor is used only to find the
/// end of an interval that rounding hides, for the report of a grazing. A larger number makes the reported interval
/// longer, not the search less certain.
const CLEAR: f64 = 4.0;

/// A monotone interval that ends within rounding of a zero is extended by this multiple of rounding/|g′|. From −rounding to
/// +rounding takes twice rounding/|g′|. Twice that, because the slope at the end may be smaller than at the middle. With
/// a smaller multiple the zero would more often lie at an end of two intervals, and neither test would show it.
const EXTENSION: f64 = 4.0;

/// Highest order of a zero at the start that is tested. The test cases go to order 8; the limit only bounds the array
/// of lower terms. A zero of higher order is [`Error::UndecidedSign`].
const HIGHEST_ORDER: u32 = 16;

/// Most intervals that are tested: a limit for a search that takes too long. Every oscillation up to the horizon takes
/// several intervals, so that a very long horizon reaches the limit. The search then ends with
/// [`Error::NoConvergence`].
const MOST_INTERVALS: usize = 1_000_000;

impl QuasiPolynomial {
    /// The first crossing of zero strictly after time zero, up to `horizon`, in one direction.
    ///
    /// For a start at zero, within rounding, the side to which the function leaves zero is its side. A function that is
    /// zero everywhere never crosses.
    ///
    /// ```
    /// use hybrid_system::{Direction, FirstCrossing, QuasiPolynomial};
    /// // t³ − t⁴ leaves zero upwards, cubically, and comes back at 1.
    /// let g = QuasiPolynomial::polynomial(&[0.0, 0.0, 0.0, 1.0, -1.0]);
    /// let back = FirstCrossing::At { time: 1.0, rising: false };
    /// assert_eq!(g.first_crossing(Direction::Either, 9.0)?, back);
    /// // (t − 1)² touches zero.
    /// let g = QuasiPolynomial::polynomial(&[1.0, -2.0, 1.0]);
    /// assert!(matches!(g.first_crossing(Direction::Either, 9.0)?, FirstCrossing::Grazing { .. }));
    /// # Ok::<(), hybrid_system::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotFinite`] for coefficients that are not finite; [`Error::BadLimit`] unless `horizon` is finite
    /// and not negative; [`Error::UndecidedSign`] if rounding hides the side to which the function leaves zero;
    /// [`Error::NoConvergence`] after a million intervals.
    pub fn first_crossing(
        &self,
        direction: Direction,
        horizon: f64,
    ) -> Result<FirstCrossing, Error> {
        self.first_crossing_from(direction, horizon, 0.0)
    }

    /// As [`first_crossing`](Self::first_crossing), for a function whose value at the start may be wrong by
    /// `start_error`.
    pub(crate) fn first_crossing_from(
        &self,
        direction: Direction,
        horizon: f64,
        start_error: f64,
    ) -> Result<FirstCrossing, Error> {
        self.check()?;
        if !(horizon >= 0.0 && horizon.is_finite()) {
            return Err(Error::BadLimit { what: "the horizon of a search", value: horizon });
        }
        if self.stays_away(horizon) {
            return Ok(FirstCrossing::Never);
        }
        let Some(start) = self.leave_start(horizon, start_error)? else {
            return Ok(FirstCrossing::Never);
        };
        Search::new(self).run(start, direction, horizon)
    }

    /// The side to which the function leaves its zero at the start, ±1; `None` if it is zero everywhere. The value at the
    /// start is zero with this `error`.
    pub(crate) fn side_after_zero(&self, horizon: f64, error: f64) -> Result<Option<f64>, Error> {
        self.check()?;
        let error = error.max(self.value(0.0).abs());
        Ok(self.leave_start(horizon, error)?.map(|(_, side)| side))
    }

    /// A time up to which the function has no zero after its start, and its sign until then; `None` if the function is
    /// zero everywhere.
    ///
    /// A derivative within its rounding error counts as zero. As long as such derivatives could outweigh the first
    /// derivative that does not count as zero, the function must stay within its own rounding error.
    fn leave_start(&self, horizon: f64, start_error: f64) -> Result<Option<(f64, f64)>, Error> {
        let start_hidden = self.rounding(0.0) + start_error;
        let mut derivative = self.clone();
        let mut factorial = 1.0; // k!
        let mut lower = [0.0; HIGHEST_ORDER as usize + 1]; // ≥ |g⁽ʲ⁾(0)|/j!
        for order in 0..=HIGHEST_ORDER {
            let value = derivative.value(0.0);
            let next = derivative.derivative();
            let rounding = derivative.rounding(0.0) + if order == 0 { start_error } else { 0.0 };
            if value.abs() <= rounding {
                // If g⁽ᵏ⁺¹⁾ ≡ 0, no derivative is left to decide. If g itself is within rounding up to the horizon, g
                // counts as zero everywhere.
                if next.bound(horizon) == 0.0 && self.bound(horizon) <= start_hidden {
                    return Ok(None);
                }
                lower[order as usize] = (value.abs() + rounding) / factorial;
                derivative = next;
                factorial *= f64::from(order + 1);
                continue;
            }
            if order == 0 {
                return Ok(Some((0.0, value.signum())));
            }
            // (4): with c = g⁽ᵏ⁾(0)/k! and |g⁽ᵏ⁺¹⁾| ≤ M on [0, t], |c| ≥ 2 M t/(k+1)! leaves at least ½|c|tᵏ of the
            // leading term. Halving t from the horizon finds such a time.
            let leading = value.abs() / factorial;
            let mut time = horizon;
            while time > 0.0
                && !(leading > 2.0 * next.bound(time) * time / (factorial * f64::from(order + 1)))
            {
                time *= 0.5;
            }
            // (5): from `clear` on, each of the lower terms (fewer than k) is at most |c|tᵏ/(2k): together they are
            // less than ½|c|tᵏ.
            let ratio = 2.0 * f64::from(order) / leading;
            let clear = (1..order as usize)
                .map(|j| pxfm::f_pow(ratio * lower[j], 1.0 / (f64::from(order) - j as f64)))
                .fold(0.0, f64::max);
            // Before `clear`, |g| is at most this sum; 2|c|tᵏ bounds the leading term with its remainder.
            let reached: f64 = (1..=order as usize)
                .map(|j| if j < order as usize { lower[j] } else { 2.0 * leading })
                .enumerate()
                .map(|(j, term)| term * pxfm::f_pow(clear, (j + 1) as f64))
                .sum();
            // `time` is 0 only for a horizon of zero, where no time is searched.
            if clear >= time && time > 0.0 || reached > start_hidden {
                return Err(Error::UndecidedSign { order, value });
            }
            return Ok(Some((time, value.signum())));
        }
        Err(Error::UndecidedSign { order: HIGHEST_ORDER, value: 0.0 })
    }
}

/// A quasi-polynomial with its first two derivatives.
struct Search<'a> {
    function: &'a QuasiPolynomial,
    slope: QuasiPolynomial,
    bend: QuasiPolynomial,
}

impl<'a> Search<'a> {
    fn new(function: &'a QuasiPolynomial) -> Self {
        let slope = function.derivative();
        let bend = slope.derivative();
        Search { function, slope, bend }
    }

    /// The tests at the head of this file. `slope` in the result is g′(m).
    fn test(&self, left: f64, right: f64) -> ZeroTest {
        let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left));
        // All bounds hold for times of size up to `right`, and so on the whole interval.
        let bend = self.bend.bound(right);
        let (value, slope) = (self.function.value(middle), self.slope.value(middle));
        let slope_rounding = self.slope.rounding(right);
        let reach = (slope.abs() + slope_rounding) * radius + 0.5 * bend * radius * radius;
        if value.abs() > reach + self.function.rounding(right) {
            ZeroTest::NoZero { sign: value.signum() }
        } else if slope.abs() > bend * radius + slope_rounding {
            ZeroTest::Monotone { slope }
        } else {
            ZeroTest::Undecided
        }
    }

    /// Tests intervals from left to right.
    ///
    /// Invariant: there is no crossing in (0, left], and the function has `sign` just after `left`. The rest is divided
    /// into intervals; `ends` holds their right ends, the nearest one last.
    fn run(
        &self,
        (start, mut sign): (f64, f64),
        direction: Direction,
        horizon: f64,
    ) -> Result<FirstCrossing, Error> {
        let mut left = start;
        let mut ends = vec![horizon];
        for _ in 0..MOST_INTERVALS {
            let Some(&right) = ends.last() else { return Ok(FirstCrossing::Never) };
            if left >= right {
                ends.pop();
                continue;
            }
            match self.test(left, right) {
                ZeroTest::NoZero { sign: now } if now != sign && direction.admits(sign, now) => {
                    // Rounding hid the zero from both tests. The zero lies where the two intervals meet.
                    return Ok(FirstCrossing::At { time: left, rising: sign < 0.0 });
                }
                ZeroTest::NoZero { sign: now } => (left, sign) = (right, now),
                ZeroTest::Monotone { slope } => {
                    let end = self.extended(right, slope, horizon);
                    let value = self.function.value(end);
                    // A value within rounding does not prove a change of side: the next interval decides. The last
                    // interval has no next one.
                    let clear = value.abs() > self.function.rounding(end) || right >= horizon;
                    if slope * sign < 0.0 && value * sign < 0.0 && clear {
                        if direction.admits(sign, -sign) {
                            let time = self.root(left, end, sign)?;
                            // `end` may lie beyond the horizon.
                            return Ok(if time <= horizon {
                                FirstCrossing::At { time, rising: sign < 0.0 }
                            } else {
                                FirstCrossing::Never
                            });
                        }
                        sign = -sign;
                        left = end;
                    } else {
                        left = right;
                    }
                }
                ZeroTest::Undecided => {
                    let middle = left + 0.5 * (right - left);
                    let width = right - left;
                    // The change of g by its bend, ½Br² = Bw²/8, is far below rounding: a shorter interval has the same
                    // rounding and cannot pass either test. This happens next to a touch.
                    let hidden =
                        self.bend.bound(right) * width * width < self.function.rounding(right);
                    if !(hidden || middle <= left || middle >= right) {
                        ends.push(middle);
                        continue;
                    }
                    let value = |time: f64| self.function.value(time);
                    let clear =
                        |time: f64| value(time).abs() > CLEAR * self.function.rounding(time);
                    let (time, value) =
                        closest_approach(value, clear, sign, (left, width, horizon));
                    return Ok(FirstCrossing::Grazing { time, value });
                }
            }
        }
        Err(Error::NoConvergence { left, right: horizon, iterations: MOST_INTERVALS })
    }

    /// The end of a monotone interval, moved right if the function is within rounding of zero there, so that a zero at
    /// the end of an interval belongs to this interval.
    fn extended(&self, right: f64, slope: f64, horizon: f64) -> f64 {
        let rounding = self.function.rounding(right);
        if self.function.value(right).abs() > rounding {
            return right;
        }
        let end = right + EXTENSION * rounding / slope.abs();
        match self.test(right, end) {
            // The end may lie beyond the horizon. The caller drops a crossing there.
            ZeroTest::Monotone { .. } | ZeroTest::Undecided => end.max(right.min(horizon)),
            ZeroTest::NoZero { .. } => right,
        }
    }

    /// The only zero of a monotone stretch that begins on the side of `sign`.
    fn root(&self, left: f64, right: f64, sign: f64) -> Result<f64, Error> {
        let value = |time: f64| self.function.value(time);
        // Within rounding the left end may have the other sign already: then it is the zero.
        if value(left) * sign <= 0.0 {
            return Ok(left);
        }
        let root = bracketed_root(value, left, right)?;
        Ok(step_past_root(root, right, |time| !(value(time) * sign > 0.0)))
    }
}
