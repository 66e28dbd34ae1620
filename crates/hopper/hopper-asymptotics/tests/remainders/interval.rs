//! Intervals of real numbers, rounded outwards.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// All numbers from `low` to `high`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Interval {
    pub(crate) low: f64,
    pub(crate) high: f64,
}

/// The interval that holds every number between the two, which have at most half an ulp of rounding error.
fn outward(low: f64, high: f64) -> Interval {
    Interval { low: low.next_down(), high: high.next_up() }
}

impl Interval {
    /// From `low` to `high`, which are exact.
    pub(crate) fn new(low: f64, high: f64) -> Self {
        assert!(low <= high, "{low} {high}");
        Interval { low, high }
    }

    /// The quotient of two numbers that are exact.
    pub(crate) fn ratio(numerator: f64, denominator: f64) -> Self {
        Interval::from(numerator) / Interval::from(denominator)
    }

    /// The largest absolute value.
    pub(crate) fn size(self) -> f64 {
        self.low.abs().max(self.high.abs())
    }

    /// self² without the dependence of a product on its two factors.
    pub(crate) fn squared(self) -> Self {
        let (a, b) = (self.low * self.low, self.high * self.high);
        if self.low <= 0.0 && self.high >= 0.0 {
            Interval { low: 0.0, high: a.max(b).next_up() }
        } else {
            outward(a.min(b), a.max(b))
        }
    }

    /// ∛self; pxfm rounds the cube root correctly.
    pub(crate) fn cube_root(self) -> Self {
        outward(pxfm::f_cbrt(self.low), pxfm::f_cbrt(self.high))
    }

    /// The numbers from `low` to `high` in `parts` parts.
    pub(crate) fn split(low: f64, high: f64, parts: u32) -> Vec<Self> {
        let at = |k: u32| {
            if k == parts { high } else { low + (high - low) * f64::from(k) / f64::from(parts) }
        };
        (0..parts).map(|k| Interval::new(at(k), at(k + 1))).collect()
    }

    /// The smallest interval that contains both.
    pub(crate) fn hull(self, other: Interval) -> Self {
        Interval { low: self.low.min(other.low), high: self.high.max(other.high) }
    }

    pub(crate) fn contains_zero(self) -> bool {
        self.low <= 0.0 && self.high >= 0.0
    }
}

impl From<f64> for Interval {
    fn from(value: f64) -> Self {
        Interval { low: value, high: value }
    }
}

impl Neg for Interval {
    type Output = Interval;
    fn neg(self) -> Interval {
        Interval { low: -self.high, high: -self.low }
    }
}

impl Add for Interval {
    type Output = Interval;
    fn add(self, other: Interval) -> Interval {
        outward(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Interval;
    fn sub(self, other: Interval) -> Interval {
        self + -other
    }
}

impl Mul for Interval {
    type Output = Interval;
    fn mul(self, other: Interval) -> Interval {
        // The product with zero is exact. Without this line each product of a zero coefficient would grow.
        if self.size() == 0.0 || other.size() == 0.0 {
            return Interval::from(0.0);
        }
        let ends = [
            self.low * other.low,
            self.low * other.high,
            self.high * other.low,
            self.high * other.high,
        ];
        let low = ends.iter().copied().fold(f64::INFINITY, f64::min);
        let high = ends.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        outward(low, high)
    }
}

impl Mul<f64> for Interval {
    type Output = Interval;
    fn mul(self, factor: f64) -> Interval {
        self * Interval::from(factor)
    }
}

impl Div for Interval {
    type Output = Interval;
    fn div(self, other: Interval) -> Interval {
        assert!(!other.contains_zero(), "division by {other:?}");
        self * outward(1.0 / other.high, 1.0 / other.low)
    }
}
