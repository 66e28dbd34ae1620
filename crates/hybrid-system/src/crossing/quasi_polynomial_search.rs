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

use super::bounded::{Bounded, Leave};
use super::enclosure::Enclosure;
use super::first_crossing::FirstCrossing;
use super::quasi_polynomial::QuasiPolynomial;
use super::zero_search::{ZeroSearch, first_crossing};
use super::zero_test::ZeroTest;
use crate::error::Error;
use crate::guard::Direction;

/// An interval is hidden if the function is within rounding of zero at its middle, and changes by no more than this many
/// rounding errors on it. A smaller number needs shorter intervals; a larger one hides zeros that shorter intervals
/// show.
const HIDDEN: f64 = 4.0;

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
    /// assert!(matches!(g.first_crossing(Direction::Either, 9.0)?, FirstCrossing::Touch { .. }));
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
        let bounded = Search::new(self);
        let (value, rounding) = (self.value(0.0), self.rounding(0.0));
        let at = Enclosure::around(value, rounding);
        let mut search = ZeroSearch::new(direction, (0.0, value), at, start_error, None);
        first_crossing(&bounded, &mut search, horizon, MOST_INTERVALS)
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
}

impl Bounded for Search<'_> {
    fn value(&self, time: f64) -> f64 {
        self.function.value(time)
    }

    fn at(&self, time: f64) -> Result<Enclosure, Error> {
        Ok(Enclosure::around(self.function.value(time), self.function.rounding(time)))
    }

    fn test(&self, left: f64, right: f64, level: f64) -> Result<ZeroTest, Error> {
        let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left));
        // All bounds hold for times of size up to `right`, and so on the whole interval.
        let bend = self.bend.bound(right);
        let (value, slope) = (self.function.value(middle) - level, self.slope.value(middle));
        let (rounding, slope_rounding) =
            (self.function.rounding(right), self.slope.rounding(right));
        let reach = (slope.abs() + slope_rounding) * radius + 0.5 * bend * radius * radius;
        Ok(if value.abs() > reach + rounding {
            ZeroTest::NoZero { sign: value.signum() }
        } else if slope.abs() > bend * radius + slope_rounding {
            ZeroTest::Monotone { slope }
        } else if value.abs() <= rounding && reach <= HIDDEN * rounding {
            ZeroTest::Hidden
        } else {
            ZeroTest::Undecided
        })
    }

    fn leave(&self, from: f64, until: f64, error: f64) -> Result<Leave, Error> {
        let function = self.function;
        let horizon = until;
        let start_hidden = function.rounding(from) + error;
        let mut derivative = function.clone();
        let mut factorial = 1.0; // k!
        let mut lower = [0.0; HIGHEST_ORDER as usize + 1]; // ≥ |g⁽ʲ⁾(0)|/j!
        for order in 0..=HIGHEST_ORDER {
            let value = derivative.value(from);
            let next = derivative.derivative();
            let rounding = derivative.rounding(from) + if order == 0 { error } else { 0.0 };
            if value.abs() <= rounding {
                // If g⁽ᵏ⁺¹⁾ ≡ 0, no derivative is left to decide. If g itself is within rounding up to the horizon, g
                // counts as zero everywhere.
                if next.bound(horizon) == 0.0 && function.bound(horizon) <= start_hidden {
                    return Ok(Leave::Stays);
                }
                lower[order as usize] = (value.abs() + rounding) / factorial;
                derivative = next;
                factorial *= f64::from(order + 1);
                continue;
            }
            if order == 0 {
                return Ok(Leave::To { time: from, side: value.signum() });
            }
            // (4): with c = g⁽ᵏ⁾(0)/k! and |g⁽ᵏ⁺¹⁾| ≤ M on [0, t], |c| ≥ 2 M t/(k+1)! leaves at least ½|c|tᵏ of the
            // leading term. Halving t from the horizon finds such a time.
            let leading = value.abs() / factorial;
            let mut time = horizon - from;
            while time > 0.0
                && !(leading
                    > 2.0 * next.bound(from + time) * time / (factorial * f64::from(order + 1)))
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
                return Ok(Leave::Hidden);
            }
            return Ok(Leave::To { time: from + time, side: value.signum() });
        }
        Ok(Leave::Hidden)
    }

    fn root_error(&self, time: f64, left: f64, right: f64) -> Result<f64, Error> {
        let here = self.at(time)?.magnitude();
        let slope = self.slope.value(time).abs() - self.slope.rounding(right);
        let mut error = right - left;
        for _ in 0..2 {
            let slowest = slope - self.bend.bound(right) * error;
            if slowest > 0.0 {
                error = error.min(here / slowest);
            }
        }
        Ok(error)
    }
}
