//! One guard along one step of an integrated flow: a source of the search for zeros.

use super::chebyshev::{CHEBYSHEV, NODES};
use super::polynomial_test::{is_broken, largest, scatter, side_after_zero, zero_test};
use super::power_test;
use crate::crossing::{Bounded, Leave, ZeroTest};
use crate::error::Error;
use interval_arithmetic::Enclosure;
use std::cell::{Cell, OnceCell};

/// On intervals shorter than this part of the step, 2⁻³⁰, a smooth guard is a straight line within rounding: its
/// bend is 2⁻⁶⁰ of its size on the step. What else its values show is the rounding of its own arithmetic. On longer
/// intervals a kink or a narrow bump could be taken for rounding. Shorter ones would take more halvings to the same
/// result.
const STRAIGHT: f64 = 1.0 / 1_073_741_824.0;

/// On intervals shorter than this many ulps of time the nodes are rounded, and neighbouring ones may be the same
/// time: what the values show is the rounding of the time. A larger number would hide rounding of guards on short
/// steps.
const NODE_ULPS: f64 = 1024.0;

/// A guard that is not a number somewhere on an interval is searched on shorter ones, down to this part of the step:
/// 2⁻⁴⁰. So a crossing before a region without values is found. A shorter interval would find a crossing closer to that
/// region.
const SHORTEST_WITHOUT_VALUES: f64 = 1.0 / 1_099_511_627_776.0;

/// A guard that started at zero has left it when a value on the interval exceeds its rounding error by this factor.
/// Below it no test shows a side. A larger factor needs a longer interval, which may hold the next crossing
/// already.
const LEFT_ZERO: f64 = 16.0;

/// The distance between two neighbouring nodes in the middle of an interval, relative to its length: sin(π/32). A guard
/// is looked at this often at least.
const NODE_DISTANCE: f64 = 0.098;

/// Rounding may be the reason why a test of an interval fails if the values are below this many times their error:
/// the test of the slope multiplies the error by 1240. Larger values fail for another reason, and the error of the
/// interval alone, which takes some evaluations, is not computed.
const NOISE_MATTERS: f64 = 1e5;

/// Most intervals at a start on the surface: 53 halvings to the rounding of the time, and as many steps back. A
/// guard that shows no side then is hidden.
const MOST_INTERVALS: usize = 128;

/// A guard as a function of time on one step: values on the polynomial of the step, with their rounding.
pub(super) struct GuardOnStep<'p, A, R> {
    along: A,
    rounding: R,
    from: f64,
    to: f64,
    /// The longest interval that is tested.
    longest: f64,
    /// The guard itself as a polynomial in the time since the step began. Its zeros need no values.
    powers: Option<&'p [f64]>,
    /// The result of `rounding` for the whole step, computed at its first use.
    known_rounding: OnceCell<f64>,
    /// The rounding of the guard's own arithmetic, as far as it has been seen on this step.
    own: Cell<f64>,
}

impl<'p, A: Fn(f64) -> f64, R: Fn(f64, f64) -> f64> GuardOnStep<'p, A, R> {
    /// The guard `along` the step [`from`, `to`]. `rounding(left, right)` estimates the error of its values there
    /// by the rounding of the state. The guard is evaluated at least every `check_interval`.
    pub(super) fn new(
        along: A,
        rounding: R,
        (from, to): (f64, f64),
        check_interval: f64,
        powers: Option<&'p [f64]>,
    ) -> Self {
        let longest = check_interval / NODE_DISTANCE;
        let (known_rounding, own) = (OnceCell::new(), Cell::new(0.0));
        GuardOnStep { along, rounding, from, to, longest, powers, known_rounding, own }
    }

    /// An estimate of the error of the values on the step.
    pub(super) fn error(&self) -> f64 {
        self.known_rounding.get_or_init(|| (self.rounding)(self.from, self.to)).max(self.own.get())
    }

    /// The same for an interval. Where the guard is flat, rounding of the state changes it less than elsewhere on
    /// the step.
    fn error_on(&self, left: f64, right: f64) -> f64 {
        (self.rounding)(left, right).max(self.own.get())
    }

    /// The values at the nodes of an interval minus `level`; `None` if the interval is to be halved because one of
    /// them is not a number.
    fn values_at_nodes(
        &self,
        left: f64,
        right: f64,
        level: f64,
    ) -> Result<Option<[f64; NODES]>, Error> {
        let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left));
        let mut values = [0.0; NODES];
        for (value, node) in values.iter_mut().zip(CHEBYSHEV.nodes) {
            // Rounding must not lead outside the step.
            let at = (middle + radius * node).clamp(left, right);
            *value = (self.along)(at) - level;
            if !value.is_finite() {
                let shortest = SHORTEST_WITHOUT_VALUES * (self.to - self.from);
                if right - left > shortest && middle > left && middle < right {
                    return Ok(None);
                }
                return Err(Error::NotFinite { at, value: *value });
            }
        }
        Ok(Some(values))
    }
}

impl<A: Fn(f64) -> f64, R: Fn(f64, f64) -> f64> Bounded for GuardOnStep<'_, A, R> {
    fn value(&self, time: f64) -> f64 {
        (self.along)(time)
    }

    fn at(&self, time: f64) -> Result<Enclosure, Error> {
        let value = (self.along)(time);
        if !value.is_finite() {
            return Err(Error::NotFinite { at: time, value });
        }
        let error = self.error();
        let hidden = value.abs() <= error;
        Ok(Enclosure::around(value, if hidden { self.error_on(time, time) } else { error }))
    }

    fn test(&self, left: f64, right: f64, level: f64) -> Result<ZeroTest, Error> {
        if let Some(powers) = self.powers {
            let since = (left - self.from, right - self.from);
            // Without the rounding of the state first: its estimate takes longer than the test.
            let bounds = power_test::OnInterval::new(powers, since);
            return Ok(match bounds.test(level, 0.0) {
                ZeroTest::Undecided => ZeroTest::Undecided,
                _ => bounds.test(level, self.error()),
            });
        }
        if right - left > self.longest {
            return Ok(ZeroTest::Undecided);
        }
        let Some(values) = self.values_at_nodes(left, right, level)? else {
            return Ok(ZeroTest::Undecided);
        };
        let mut error = self.error();
        let mut found = zero_test(&values, error);
        let undecided = matches!(found, ZeroTest::Undecided | ZeroTest::Hidden);
        if undecided && largest(&values) <= NOISE_MATTERS * error {
            error = self.error_on(left, right);
            found = zero_test(&values, error);
        }
        // The nodes leave out the ends: a jump between the last of them and the end is halved like others.
        if let ZeroTest::NoZero { sign } = found
            && ((self.along)(right) - level) * sign < 0.0
        {
            return Ok(ZeroTest::Undecided);
        }
        let short = right - left < STRAIGHT * (self.to - self.from)
            && right - left > NODE_ULPS * f64::EPSILON * right;
        // A jump or a kink is halved down to the rounding of the time, and says nothing about the values elsewhere.
        if matches!(found, ZeroTest::Undecided) && short && !is_broken(&values) {
            self.own.set(self.own.get().max(scatter(&values)));
            if largest(&values) <= 2.0 * error.max(self.own.get()) {
                return Ok(ZeroTest::Hidden);
            }
        }
        Ok(found)
    }

    /// Tries shorter and shorter intervals from the start on, until one of them shows a side, or rounding hides all of
    /// its values. Behind a hidden interval the first one that shows a side decides.
    fn leave(&self, from: f64, until: f64, error: f64) -> Result<Leave, Error> {
        let start = (self.along)(from);
        let error = error.max(self.error());
        if let Some(powers) = self.powers
            && let since = (from - self.from, until - self.from)
            && let Some((time, side)) = power_test::leave(powers, since, LEFT_ZERO * error)
        {
            return Ok(Leave::To { time: (self.from + time).min(until), side });
        }
        let (mut hidden, mut right) = (from, until.min(from + self.longest));
        for _ in 0..MOST_INTERVALS {
            if let Some(values) = self.values_at_nodes(hidden, right, start)? {
                let shown = if largest(&values) <= LEFT_ZERO * error {
                    if right >= until {
                        return Ok(Leave::Stays);
                    }
                    let length = right - hidden;
                    (hidden, right) = (right, (right + length).min(until));
                    continue;
                } else if hidden == from {
                    side_after_zero(&values, error)
                } else if let ZeroTest::NoZero { sign } = zero_test(&values, error) {
                    Some(sign)
                } else {
                    None
                };
                if let Some(side) = shown {
                    return Ok(Leave::To { time: right, side });
                }
            }
            let middle = hidden + 0.5 * (right - hidden);
            if middle <= hidden || middle >= right {
                break;
            }
            right = middle;
        }
        Ok(Leave::Hidden)
    }

    fn root_error(&self, time: f64, left: f64, right: f64) -> Result<f64, Error> {
        // The guard is monotone on the interval. Its mean rate stands for the rate at the zero.
        let rate = ((self.along)(right) - (self.along)(left)).abs() / (right - left);
        let error = (self.along)(time).abs() + self.error_on(left, right);
        // 0/0 for a guard that is exactly zero: `min` drops NaN.
        Ok((error / rate).min(right - left))
    }
}
