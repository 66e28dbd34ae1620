//! Times of clock guards: periodic and preset.

use crate::error::Error;

/// The times first + k·period, k = 0, 1, 2, …
///
/// A model with a clock guard returns [`next_after`](Self::next_after) from
/// [`next_time`](crate::HybridSystem::next_time). Each time is computed from k, not from the time before it, so
/// that the clock does not drift.
///
/// ```
/// use hybrid_system::PeriodicTimes;
/// let clock = PeriodicTimes::new(1e8, 0.1)?;
/// assert_eq!(clock.next_after(0.0), Some(1e8));
/// assert_eq!(clock.next_after(1e8), Some(1e8 + 0.1));
/// // The millionth tick, to the last digit.
/// assert_eq!(clock.next_after(1e8 + 1e5 - 0.05), Some(1e8 + 1e5));
/// # Ok::<(), hybrid_system::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodicTimes {
    first: f64,
    period: f64,
}

/// Numbers of ticks below this are doubles with room for the search of k. From 2⁵² periods on, neighbouring doubles are
/// a period apart or more.
const MOST_TICKS: f64 = (1u64 << 52) as f64;

/// How far k, estimated by a division, may be from the right one. The quotient has three roundings, each at most
/// 2⁻⁵³ of k < 2⁵²; the sum is below 2. A larger number would only cost evaluations.
const NEIGHBOURS: i32 = 3;

impl PeriodicTimes {
    /// The times `first`, `first` + `period`, `first` + 2 `period` and so on.
    ///
    /// # Errors
    /// [`Error::BadLimit`] for a first time that is not finite, and for a period that is not positive and finite.
    pub fn new(first: f64, period: f64) -> Result<Self, Error> {
        if !first.is_finite() {
            return Err(Error::BadLimit { what: "the first time of a clock", value: first });
        }
        if !(period > 0.0 && period.is_finite()) {
            return Err(Error::BadLimit { what: "the period of a clock", value: period });
        }
        Ok(PeriodicTimes { first, period })
    }

    /// The first of the times, each rounded to the nearest double, that is later than `after`. It is infinite if the
    /// next one exceeds the largest double.
    ///
    /// If neighbouring doubles at `after` are farther apart than the period, no double separates the ticks. The result
    /// is then `after` itself, and an execution returns it as an error, because a clock must lead to a later time.
    /// `None` if `after` is NaN.
    pub fn next_after(&self, after: f64) -> Option<f64> {
        if after.is_nan() {
            return None;
        }
        if after < self.first {
            return Some(self.first);
        }
        let ticks = ((after - self.first) / self.period).floor();
        if !(ticks < MOST_TICKS) {
            return Some(after);
        }
        (-NEIGHBOURS..=NEIGHBOURS)
            .map(|offset| self.time((ticks + f64::from(offset)).max(0.0)))
            .find(|&time| time > after)
            // Here all ticks near `after` round to `after`.
            .or(Some(after))
    }

    /// first + k·period for a whole number k ≤ 2⁵² + 3, with the product exact and the sum rounded at the end.
    fn time(&self, k: f64) -> f64 {
        // k = a + b with b < 2²⁶ and a of 26 bits, period = c + d with parts of 26 and 27 bits: each product of two
        // parts has at most 53 bits, and is exact.
        let a = (k / SPLIT).floor() * SPLIT;
        let b = k - a;
        let c = f64::from_bits(self.period.to_bits() & UPPER_BITS);
        let d = self.period - c;
        // Largest first; the two in the middle are of similar size.
        let mut parts = [a * c, b * c, a * d, b * d];
        let mut sum = self.first;
        let mut rest = 0.0;
        for part in &mut parts {
            let next = sum + *part;
            let part_in_next = next - sum;
            rest += (sum - (next - part_in_next)) + (*part - part_in_next);
            sum = next;
        }
        // An overflow: ∞ − ∞ in `rest`.
        if sum.is_finite() { sum + rest } else { sum }
    }
}

/// 2²⁶, which splits a whole number of 52 bits into two of 26 bits.
const SPLIT: f64 = (1u64 << 26) as f64;

/// Keeps sign, exponent and the upper 25 bits after the point of a double: 26 bits, and 27 remain.
const UPPER_BITS: u64 = !((1 << 27) - 1);

/// Times from a list.
///
/// ```
/// use hybrid_system::PresetTimes;
/// let times = PresetTimes::new([0.5, 2.0, 3.5])?;
/// assert_eq!(times.next_after(0.5), Some(2.0));
/// assert_eq!(times.next_after(3.5), None);
/// assert!(PresetTimes::new([2.0, 0.5]).is_err());
/// # Ok::<(), hybrid_system::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct PresetTimes {
    times: Vec<f64>,
}

impl PresetTimes {
    /// All of them.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// The given times, which must be finite and rise strictly.
    ///
    /// # Errors
    /// [`Error::BadClock`] with the first time that is not finite, or not later than the one before it.
    pub fn new(times: impl Into<Vec<f64>>) -> Result<Self, Error> {
        let times = times.into();
        let mut before = f64::NEG_INFINITY;
        for (index, &time) in times.iter().enumerate() {
            if !(time > before && time.is_finite()) {
                return Err(Error::BadClock { index, time, before });
            }
            before = time;
        }
        Ok(PresetTimes { times })
    }

    /// The first of the times later than `after`; `None` if there is none, or if `after` is NaN.
    pub fn next_after(&self, after: f64) -> Option<f64> {
        if after.is_nan() {
            return None;
        }
        self.times.get(self.times.partition_point(|&time| time <= after)).copied()
    }
}

/// The times of a clock.
#[derive(Debug, Clone, PartialEq)]
#[cfg(feature = "ode")]
pub(crate) enum ClockTimes {
    Periodic(PeriodicTimes),
    Preset(PresetTimes),
}

#[cfg(feature = "ode")]
impl ClockTimes {
    /// The first of the times later than `after`.
    pub(crate) fn next_after(&self, after: f64) -> Option<f64> {
        match self {
            ClockTimes::Periodic(times) => times.next_after(after),
            ClockTimes::Preset(times) => times.next_after(after),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Ticks of 0.1: k·3602879701896397/2⁵⁵, rounded to nearest, by whole numbers.
    #[test]
    fn a_tick_is_the_nearest_double_of_its_exact_time() {
        let clock = PeriodicTimes::new(0.0, 0.1).unwrap();
        for k in [1u64, 3, 10, 12_345_678_901, (1 << 50) + 12_345, (1 << 51) + 1] {
            let exact = u128::from(k) * 3_602_879_701_896_397;
            // The conversion from u128 rounds to nearest.
            let nearest = exact as f64 / (1u64 << 55) as f64;
            assert_eq!(clock.time(k as f64), nearest, "{k}");
        }
    }

    #[test]
    fn a_clock_walks_through_every_tick_once() {
        let clock = PeriodicTimes::new(1e8, 0.1).unwrap();
        let mut time = 0.0;
        for k in 0..100_000u32 {
            time = clock.next_after(time).unwrap();
            assert_eq!(time, clock.time(f64::from(k)));
        }
    }

    #[test]
    fn ticks_that_no_double_separates_do_not_advance() {
        let clock = PeriodicTimes::new(0.0, 0.1).unwrap();
        // Neighbouring doubles at 1e17 are 16 apart, at 2e15 a quarter.
        assert_eq!(clock.next_after(1e17), Some(1e17));
        assert_eq!(clock.next_after(2e15), Some(2e15));
        assert_eq!(clock.next_after(f64::INFINITY), Some(f64::INFINITY));
        assert_eq!(clock.next_after(f64::NAN), None);
        let shifted = PeriodicTimes::new(1e17, 0.1).unwrap();
        assert_eq!(shifted.next_after(0.0), Some(1e17));
        assert_eq!(shifted.next_after(1e17), Some(1e17));
    }

    #[test]
    fn bad_clocks_are_errors() {
        for (first, period) in
            [(0.0, 0.0), (0.0, -1.0), (0.0, f64::NAN), (f64::NAN, 1.0), (f64::INFINITY, 1.0)]
        {
            assert!(matches!(PeriodicTimes::new(first, period), Err(Error::BadLimit { .. })));
        }
        let bad = PresetTimes::new([1.0, 1.0]).unwrap_err();
        assert_eq!(bad, Error::BadClock { index: 1, time: 1.0, before: 1.0 });
        assert!(PresetTimes::new([1.0, f64::NAN]).is_err());
        assert!(PresetTimes::new([1.0, f64::INFINITY]).is_err());
        assert_eq!(PresetTimes::new([]).unwrap().next_after(f64::NEG_INFINITY), None);
    }

    #[test]
    fn an_overflow_is_infinite() {
        let clock = PeriodicTimes::new(0.0, f64::MAX).unwrap();
        assert_eq!(clock.next_after(0.0), Some(f64::MAX));
        assert_eq!(clock.next_after(f64::MAX), Some(f64::INFINITY));
    }

    proptest! {
        /// The next time is later than `after`, the tick before it is not, and repeated calls meet every tick.
        #[test]
        fn no_tick_is_skipped(first in -1e9..1e9f64, period in 1e-6..1e6f64, k in 0u64..1_000_000_000) {
            let clock = PeriodicTimes::new(first, period).unwrap();
            let k = k as f64;
            let (this, next) = (clock.time(k), clock.time(k + 1.0));
            prop_assume!(this < next);
            prop_assert_eq!(clock.next_after(this), Some(next));
            prop_assert_eq!(clock.next_after(this.next_down()), Some(this));
            prop_assert_eq!(clock.next_after(next.next_down()), Some(next));
        }
    }
}
