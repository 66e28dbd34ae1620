//! The first zero of a [`QuasiPolynomial`], with certainty.
//!
//! On an interval with middle m and half length r, and |g‴| ≤ C on it,
//!
//! ```text
//!   |g(m)|  > |g′(m)| r + ½|g″(m)| r² + C r³/6 + rounding    no zero on the interval
//!   |g′(m)| > |g″(m)| r + ½ C r² + rounding                  g is monotone: a zero if and only if its sign changes
//!   else                                                     the interval is halved
//! ```
//!
//! These are statements (2) and (3) of [mathematics](crate::mathematics), with |g″| ≤ |g″(m)| + C r. Statements (4)
//! and (5) tell how the function leaves a start at zero.

use super::bounded::{Bounded, Leave};
use super::first_crossing::FirstCrossing;
use super::found::Found;
use super::quasi_layers::{Layers, Size};
use super::quasi_polynomial::QuasiPolynomial;
use super::search_request::MOST_INTERVALS;
use super::zero_search::ZeroSearch;
use super::zero_test::ZeroTest;
use crate::error::Error;
use crate::guard::Direction;
use interval_arithmetic::Enclosure;

/// Relative margin on the half length of an interval. Two differences and a product round by ε/2 each; 4ε is more than
/// these roundings together. A larger margin would only make the tests slightly weaker.
const RADIUS_MARGIN: f64 = 4.0 * f64::EPSILON;

/// An interval is hidden if the function is within rounding of zero at its middle, and changes by no more than this
/// many rounding errors on it. A smaller number needs shorter intervals; a larger one hides zeros that shorter
/// intervals show.
const HIDDEN: f64 = 4.0;

/// Highest order of a zero at the start that is tested. The test cases go to order 8; the limit only bounds the array
/// of lower terms. A zero of higher order is [`Error::UndecidedSign`].
const HIGHEST_ORDER: usize = 16;

/// Derivatives that the tests on an interval use.
const SEARCHED_DERIVATIVES: usize = 3;

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
    /// [`Error::NotFinite`] for coefficients that are not finite, or a function that overflows up to the horizon;
    /// [`Error::DerivativeOverflows`] for coefficients above some 1e200 at high rates;
    /// [`Error::BadLimit`] unless `horizon` is finite and not negative; [`Error::UndecidedSign`] if rounding hides
    /// the side to which the function leaves zero; [`Error::IntervalBudget`] after a million intervals.
    pub fn first_crossing(
        &self,
        direction: Direction,
        horizon: f64,
    ) -> Result<FirstCrossing, Error> {
        self.first_crossing_within(direction, horizon, MOST_INTERVALS)
    }

    /// As [`first_crossing`](Self::first_crossing), with another budget of intervals. Every oscillation up to the
    /// crossing takes several intervals.
    ///
    /// # Errors
    /// As for `first_crossing`; [`Error::IntervalBudget`] after this number of intervals.
    pub fn first_crossing_within(
        &self,
        direction: Direction,
        horizon: f64,
        intervals: usize,
    ) -> Result<FirstCrossing, Error> {
        if !(horizon >= 0.0 && horizon.is_finite()) {
            return Err(Error::BadLimit { what: "the horizon of a search", value: horizon });
        }
        let bounded = BoundedQuasiPolynomial::new(self, horizon)?;
        if bounded.stays_away(horizon) {
            return Ok(FirstCrossing::Never);
        }
        let start = (0.0, bounded.value(0.0));
        let mut search = ZeroSearch::new(direction, start, bounded.at(0.0)?, 0.0, None);
        let mut budget = intervals;
        Ok(match search.advance(&bounded, horizon, true, &mut budget)? {
            Found::Crossing { time, rising, .. } => FirstCrossing::At { time, rising },
            Found::Touch { time, .. } => FirstCrossing::Touch { time, value: self.value(time) },
            Found::Undecided { time, .. } => {
                FirstCrossing::Undecided { time, value: self.value(time) }
            }
            Found::Nothing => FirstCrossing::Never,
            Found::BudgetEnded => {
                return Err(Error::IntervalBudget { time: search.time(), horizon, intervals });
            }
        })
    }

    /// The side to which the function leaves its zero at the start, ±1; `None` if it is zero everywhere. The value
    /// at the start is zero with this `error`.
    pub(crate) fn side_after_zero(&self, horizon: f64, error: f64) -> Result<Option<f64>, Error> {
        // The usual case, order 1, needs no bounds.
        let slope = self.slope_at_start();
        if slope.value.abs() > slope.error {
            return Ok(Some(slope.value.signum()));
        }
        let bounded = BoundedQuasiPolynomial::new(self, horizon)?;
        let error = error.max(bounded.at(0.0)?.magnitude());
        match bounded.leave(0.0, horizon, error)? {
            Leave::To { side, .. } => Ok(Some(side)),
            Leave::Stays => Ok(None),
            Leave::Hidden => Err(Error::UndecidedSign { order: 1, value: slope.value }),
        }
    }
}

/// A quasi-polynomial with its derivatives, as a source of bounds.
///
/// The function that is searched is g without its largest exponential factor: it has the same zeros and signs.
pub(crate) struct BoundedQuasiPolynomial<'a> {
    function: &'a QuasiPolynomial,
    layers: Layers,
    horizon: f64,
}

impl<'a> BoundedQuasiPolynomial<'a> {
    /// For times from 0 to `horizon`.
    pub(crate) fn new(function: &'a QuasiPolynomial, horizon: f64) -> Result<Self, Error> {
        let layers = Layers::new(function, horizon, SEARCHED_DERIVATIVES)?;
        Ok(BoundedQuasiPolynomial { function, layers, horizon })
    }

    /// True if one comparison shows that there is no zero up to `time`.
    pub(crate) fn stays_away(&self, time: f64) -> bool {
        self.layers.stays_away(self.layers.in_units(time))
    }
}

impl Bounded for BoundedQuasiPolynomial<'_> {
    fn value(&self, time: f64) -> f64 {
        let [value] = self.layers.values(0, self.layers.in_units(time));
        value
    }

    fn at(&self, time: f64) -> Result<Enclosure, Error> {
        let time = self.layers.in_units(time);
        let ([value], [size]) = (self.layers.values(0, time), self.layers.sizes(0, time, time));
        if !value.is_finite() {
            return Err(Error::NotFinite { at: time * self.layers.unit(), value });
        }
        Ok(Enclosure::around(value, size.rounding))
    }

    fn test(&self, left: f64, right: f64, level: f64) -> Result<ZeroTest, Error> {
        let (left, right) = (self.layers.in_units(left), self.layers.in_units(right));
        let middle = left + 0.5 * (right - left);
        let radius = (right - middle).max(middle - left) * (1.0 + RADIUS_MARGIN);
        let [value, slope, bend] = self.layers.values(0, middle);
        let value = value - level;
        // Without the bounds on roundings and on g‴ each condition below holds more easily. Most intervals are too
        // long, and fail already here.
        let least_reach = (slope.abs() + 0.5 * bend.abs() * radius) * radius;
        if !(value.abs() > least_reach || slope.abs() > bend.abs() * radius) {
            let [Size { rounding, .. }] = self.layers.sizes(0, left, right);
            if !(value.abs() <= rounding && least_reach <= HIDDEN * rounding) {
                return Ok(ZeroTest::Undecided);
            }
        }
        let [of_value, of_slope, of_bend, third] = self.layers.sizes(0, left, right);
        let bend = bend.abs() + of_bend.rounding;
        let turn = (bend + 0.5 * third.bound * radius) * radius + of_slope.rounding;
        let half_turn = (0.5 * bend + third.bound * radius / 6.0) * radius + of_slope.rounding;
        let reach = (slope.abs() + half_turn) * radius;
        // With bounds that overflow, or with NaN, all comparisons are false, and shorter intervals follow.
        Ok(if value.abs() > reach + of_value.rounding {
            ZeroTest::NoZero { sign: value.signum() }
        } else if slope.abs() > turn {
            ZeroTest::Monotone { slope }
        } else if value.abs() <= of_value.rounding
            && reach <= HIDDEN * of_value.rounding
            && of_value.rounding.is_finite()
        {
            ZeroTest::Hidden
        } else {
            ZeroTest::Undecided
        })
    }

    /// A derivative within its rounding error counts as zero. As long as such derivatives could outweigh the first
    /// derivative that does not count as zero, the function must stay within its own rounding error.
    fn leave(&self, from: f64, until: f64, error: f64) -> Result<Leave, Error> {
        match leave(&self.layers, SEARCHED_DERIVATIVES - 1, (from, until), error) {
            Some(found) => Ok(found),
            // A zero of high order needs more derivatives.
            None => {
                let layers = Layers::new(self.function, self.horizon, HIGHEST_ORDER + 1)?;
                Ok(leave(&layers, HIGHEST_ORDER, (from, until), error).unwrap_or(Leave::Hidden))
            }
        }
    }

    /// With s ≤ |g′(time)| and e = 2|g(time)|/s: if g′ changes by no more than s/2 within e of `time`, then |g′| ≥
    /// s/2 there, and g reaches zero within e. Else the interval is the bound.
    fn root_error(&self, time: f64, left: f64, right: f64) -> Result<f64, Error> {
        let here = self.at(time)?.magnitude();
        let time = self.layers.in_units(time);
        let [slope, bend] = self.layers.values(1, time);
        let [of_slope] = self.layers.sizes(1, time, time);
        let slowest = slope.abs() - of_slope.rounding;
        let error = 2.0 * here / slowest;
        let [of_bend, third] = self.layers.sizes(2, (time - error).max(0.0), time + error);
        let turn = (bend.abs() + of_bend.rounding + third.bound * error) * error;
        // The condition is false for NaN.
        if slowest > 0.0 && turn <= 0.5 * slowest {
            Ok((error * self.layers.unit()).min(right - left))
        } else {
            Ok(right - left)
        }
    }
}

/// How the function leaves its zero at `from`; `None` if the derivatives up to `highest` do not decide. The list
/// must have one derivative more.
fn leave(layers: &Layers, highest: usize, (from, until): (f64, f64), error: f64) -> Option<Leave> {
    let (from, until) = (layers.in_units(from), layers.in_units(until));
    let mut factorial = 1.0; // k!
    let mut lower = [0.0; HIGHEST_ORDER + 1]; // ≥ |g⁽ʲ⁾|/j! at the start
    let mut start_hidden = 0.0;
    for order in 0..=highest {
        let ([value], [size]) = (layers.values(order, from), layers.sizes(order, from, from));
        let rounding = size.rounding + if order == 0 { error } else { 0.0 };
        if order == 0 {
            start_hidden = rounding;
        }
        let next = |time: f64| -> f64 {
            let [Size { bound, .. }] = layers.sizes(order + 1, from, from + time);
            bound
        };
        if value.abs() <= rounding {
            // If g⁽ᵏ⁺¹⁾ ≡ 0, no derivative is left to decide. If g itself is within rounding up to the end, g counts as
            // zero everywhere.
            let [whole] = layers.sizes(0, from, until);
            if next(until - from) == 0.0 && whole.bound <= start_hidden {
                return Some(Leave::Stays);
            }
            lower[order] = (value.abs() + rounding) / factorial;
            factorial *= (order + 1) as f64;
            continue;
        }
        if !value.is_finite() {
            return Some(Leave::Hidden);
        }
        let side = value.signum();
        // On a stretch of length zero the derivative alone decides.
        if order == 0 || !(until > from) {
            return Some(Leave::To { time: from * layers.unit(), side });
        }
        // (4): with c = g⁽ᵏ⁾/k! and |g⁽ᵏ⁺¹⁾| ≤ M on the next t, |c| ≥ 2 M t/(k+1)! leaves at least ½|c|tᵏ of the
        // leading term. Halving t finds such a time.
        let leading = (value.abs() - rounding) / factorial;
        let mut time = until - from;
        while time > 0.0 && !(leading > 2.0 * next(time) * time / (factorial * (order + 1) as f64))
        {
            time *= 0.5;
        }
        // (5): from `clear` on, each of the lower terms (fewer than k) is at most |c|tᵏ/(2k): together they are
        // less than ½|c|tᵏ.
        let ratio = 2.0 * order as f64 / leading;
        let clear = (1..order)
            .map(|j| pxfm::f_pow(ratio * lower[j], 1.0 / (order - j) as f64))
            .fold(0.0, f64::max);
        // Before `clear`, |g| is at most this sum; 2|c|tᵏ bounds the leading term with its remainder.
        let reached: f64 = (1..=order)
            .map(|j| if j < order { lower[j] } else { 2.0 * leading })
            .enumerate()
            .map(|(j, term)| term * pxfm::f_pow(clear, (j + 1) as f64))
            .sum();
        // The conditions are false for NaN.
        return Some(if clear < time && reached <= start_hidden {
            Leave::To { time: (from + time) * layers.unit(), side }
        } else {
            Leave::Hidden
        });
    }
    None
}
