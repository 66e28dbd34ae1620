//! Continuous time as a sum of durations, without loss.

/// A time as the sum of two doubles, high + low with |low| ≤ ½ ulp(high): some 106 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct TimeSum {
    high: f64,
    low: f64,
}

impl TimeSum {
    pub(crate) const fn new(time: f64) -> Self {
        TimeSum { high: time, low: 0.0 }
    }

    /// The time, rounded.
    pub(crate) const fn value(self) -> f64 {
        self.high
    }

    /// This time plus a duration.
    pub(crate) fn plus(self, duration: f64) -> Self {
        let (high, error) = two_sum(self.high, duration);
        let (high, low) = two_sum(high, error + self.low);
        TimeSum { high, low: if high.is_finite() { low } else { 0.0 } }
    }

    /// The duration from this time to another one.
    pub(crate) fn until(self, time: f64) -> f64 {
        let (high, error) = two_sum(time, -self.high);
        if high.is_finite() { high + (error - self.low) } else { high }
    }
}

/// a + b as a rounded sum and its error (Knuth).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let sum = a + b;
    let part = sum - a;
    (sum, (a - (sum - part)) + (b - part))
}
