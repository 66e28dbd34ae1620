//! Time as a sum of many durations, without loss.
//!
//! A clock of period 0.1 that starts at t = 10⁸ adds durations whose last digits lie below the last digit of t. In one
//! double a million of these sums lose 6 % of a period. Two doubles keep what one would lose.

/// A time t = high + low, where `high` is the double nearest to t.
///
/// A sum of n durations is wrong by n·2⁻¹⁰⁴ of the largest time at most, 2⁻¹⁰⁵ for each addition. Times and durations
/// must be below 10³⁰⁰ in size, so that no sum overflows; an infinite time is kept as it is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Parts"))]
pub(crate) struct TimeSum {
    /// The nearest double.
    pub(crate) high: f64,
    /// t − high.
    pub(crate) low: f64,
}

/// What stands in a file.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
struct Parts {
    high: f64,
    low: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Parts> for TimeSum {
    type Error = String;

    fn try_from(Parts { high, low }: Parts) -> Result<Self, String> {
        match high + low == high {
            true => Ok(TimeSum { high, low }),
            false => Err(format!("the time {high} with the rest {low} is damaged")),
        }
    }
}

/// a + b as the nearest double and the exact rest (Knuth's TwoSum).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let b_part = sum - a;
    let a_part = sum - b_part;
    (sum, (a - a_part) + (b - b_part))
}

/// The same for |a| ≥ |b| or a = 0 (Dekker's Fast2Sum).
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    (sum, b - (sum - a))
}

impl TimeSum {
    /// The time `time`.
    pub(crate) const fn new(time: f64) -> Self {
        TimeSum { high: time, low: 0.0 }
    }

    /// The nearest double.
    pub(crate) const fn value(self) -> f64 {
        self.high
    }

    /// The time `duration` later.
    pub(crate) fn plus(self, duration: f64) -> Self {
        let (sum, rest) = two_sum(self.high, duration);
        let (high, low) = fast_two_sum(sum, self.low + rest);
        // The rest of an infinite sum is ∞ − ∞.
        if high.is_finite() { TimeSum { high, low } } else { TimeSum::new(self.high + duration) }
    }

    /// The duration from this time to the time `later`, rounded once or twice.
    pub(crate) fn until(self, later: f64) -> f64 {
        TimeSum::new(later).since(self)
    }

    /// The duration from this time up to a limit; zero if this time, as a double, has reached it. The rest below the
    /// rounding of a double is no time to search in: a state moves by less than its rounding.
    pub(crate) fn up_to(self, limit: f64) -> f64 {
        if self.high >= limit { 0.0 } else { self.until(limit) }
    }

    /// The duration from `earlier` to this time, rounded once or twice.
    pub(crate) fn since(self, earlier: TimeSum) -> f64 {
        let (sum, rest) = two_sum(self.high, -earlier.high);
        let difference = sum + (rest + (self.low - earlier.low));
        if sum.is_finite() { difference } else { self.high - earlier.high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rest that is no rounding of the time is damage, and would move it.
    #[cfg(feature = "serde")]
    #[test]
    fn a_damaged_rest_is_refused() {
        let time = TimeSum::new(0.1).plus(1e9);
        let text = serde_json::to_string(&time).unwrap();
        assert_eq!(serde_json::from_str::<TimeSum>(&text).unwrap(), time);
        let damaged = r#"{"high": 1.0, "low": -1.8e19}"#;
        let error = serde_json::from_str::<TimeSum>(damaged).unwrap_err().to_string();
        assert!(error.contains("damaged"), "{error}");
    }
    use proptest::prelude::*;

    /// 0.1 as a double is 3602879701896397/2⁵⁵, larger than 1/10 by 5.55e-18. A million of them exceed 10⁵ by 5.55e-12.
    #[test]
    fn a_million_ticks_of_a_tenth_from_a_hundred_million() {
        let (mut sum, mut plain) = (TimeSum::new(1e8), 1e8);
        for _ in 0..1_000_000 {
            sum = sum.plus(0.1);
            plain += 0.1;
        }
        // Exact: (10⁷·3602879701896397 − 10⁶·2⁵⁵)/(10·2⁵⁵).
        let exact = (10_000_000 * 3_602_879_701_896_397i128 - 1_000_000 * (1i128 << 55)) as f64
            / (10.0 * (1i128 << 55) as f64);
        let excess = sum.since(TimeSum::new(1e8 + 1e5));
        assert!((excess - exact).abs() < 1e-18, "{excess:e} {exact:e}");
        assert_eq!(sum.value(), 1e8 + 1e5);
        // One double is 6 % of a period behind.
        let lost = plain - (1e8 + 1e5);
        assert!((-0.0061..-0.0059).contains(&lost), "{lost}");
    }

    #[test]
    fn the_duration_up_to_a_limit_keeps_its_digits() {
        // A step of 1e-30 after 1, and 1e-20 after 1e8, are not lost.
        let one = TimeSum::new(1.0).plus(1e-30);
        assert_eq!(one.since(TimeSum::new(1.0)), 1e-30);
        let late = TimeSum::new(1e8).plus(1e-20).plus(3.0);
        assert!((late.since(TimeSum::new(1e8 + 3.0)) - 1e-20).abs() < 1e-33);
        // Rest of a period: 0.1 − (what is over).
        let now = TimeSum::new(1e8).plus(0.1);
        assert_eq!(TimeSum::new(1e8).since(now), -0.1);
    }

    #[test]
    fn infinite_times_stay_infinite() {
        let forever = TimeSum::new(f64::INFINITY);
        assert_eq!(forever.plus(1.0), forever);
        assert_eq!(TimeSum::new(1.0).plus(f64::INFINITY), forever);
        assert_eq!(forever.since(TimeSum::new(1e8)), f64::INFINITY);
        assert_eq!(TimeSum::new(1e8).since(forever), f64::NEG_INFINITY);
    }

    proptest! {
        /// Durations k·2⁻⁵⁰ with whole k are added exactly, as whole numbers of 2⁻⁵⁰.
        #[test]
        fn sums_are_those_of_whole_numbers(start in 0i64..1 << 50, steps in prop::collection::vec(0i64..1 << 52, 1..200)) {
            let unit = pxfm::f_exp2(-50.0);
            let mut sum = TimeSum::new(start as f64);
            let mut whole = i128::from(start) << 50;
            for step in steps {
                sum = sum.plus(step as f64 * unit);
                whole += i128::from(step);
            }
            let found = (sum.high as i128) << 50;
            let high_part = (sum.high - sum.high.trunc()) / unit;
            prop_assert_eq!(found + high_part as i128 + (sum.low / unit) as i128, whole);
        }
    }
}
