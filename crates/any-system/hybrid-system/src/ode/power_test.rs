//! A test for zeros of a guard that is a polynomial in the time since a step began: (6a) of the [mathematics](crate::mathematics).
//!
//! Around the middle m of an interval of half length r the guard is Σ dₖ (t − m)ᵏ. With ν for the rounding:
//!
//! ```text
//!   |d₀| > Σ |dₖ| rᵏ + ν          no zero on the interval                              (k ≥ 1)
//!   |d₁| > Σ k|dₖ| rᵏ⁻¹ + ν/r     monotone: a zero if and only if its sign changes     (k ≥ 2)
//! ```
//!
//! These are bounds, not samples: no zero of the polynomial is missed.

use crate::crossing::ZeroTest;
use smallvec::SmallVec;

/// Coefficients of a polynomial: Taylor orders are below 24.
type Powers = SmallVec<[f64; 24]>;

/// The rounding of a test, of the size of the guard on the step: each coefficient is a sum of `order` terms at most, and
/// there are as many of them. A larger number only halves intervals once more.
const ROUNDING: f64 = 1024.0 * f64::EPSILON;

/// The polynomial around another point, by repeated division.
fn around(coefficients: &[f64], point: f64) -> Powers {
    let mut moved = Powers::from_slice(coefficients);
    for first in 0..moved.len() {
        for k in (first..moved.len() - 1).rev() {
            moved[k] += point * moved[k + 1];
        }
    }
    moved
}

/// Σ |cₖ| rᵏ from the order `first` on, and Σ k|cₖ| rᵏ.
fn sums(coefficients: &[f64], first: usize, radius: f64) -> (f64, f64) {
    let (mut power, mut values, mut slopes) = (1.0, 0.0, 0.0);
    for (k, coefficient) in coefficients.iter().enumerate() {
        if k >= first {
            values += coefficient.abs() * power;
            slopes += k as f64 * coefficient.abs() * power;
        }
        power *= radius;
    }
    (values, slopes)
}

/// Bounds on a guard on an interval.
pub(super) struct OnInterval {
    /// d₀, and d₁ r.
    middle: f64,
    slope: f64,
    /// Σ |dₖ| rᵏ for k ≥ 1, and Σ k|dₖ| rᵏ for k ≥ 2.
    others: f64,
    bends: f64,
    rounding: f64,
}

impl OnInterval {
    /// The bounds on an interval of the step, given by its ends since the step began.
    pub(super) fn new(coefficients: &[f64], (left, right): (f64, f64)) -> Self {
        let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left).abs());
        let farthest = left.abs().max(right.abs());
        let moved = around(coefficients, middle);
        let slope = moved.get(1).copied().unwrap_or(0.0) * radius;
        let (bending, bends) = sums(&moved, 2, radius);
        let rounding = ROUNDING * sums(coefficients, 0, farthest).0;
        OnInterval { middle: moved[0], slope, others: slope.abs() + bending, bends, rounding }
    }

    /// What they show about zeros of the guard minus `level`. `noise` bounds the rounding of its values.
    pub(super) fn test(&self, level: f64, noise: f64) -> ZeroTest {
        let (here, noise) = (self.middle - level, noise + self.rounding);
        if here.abs() > self.others + noise {
            return ZeroTest::NoZero { sign: here.signum() };
        }
        if here.abs() + self.others <= 2.0 * noise {
            return ZeroTest::Hidden;
        }
        if self.slope.abs() > self.bends + noise {
            return ZeroTest::Monotone { slope: self.slope.signum() };
        }
        ZeroTest::Undecided
    }
}

/// The time, and the side to which a guard leaves its zero at a time since the step began: up to there its change is that
/// of its slope, and more than `least`. `None` if the bounds do not show it, as at a zero of higher order.
pub(super) fn leave(
    coefficients: &[f64],
    (from, until): (f64, f64),
    least: f64,
) -> Option<(f64, f64)> {
    let moved = around(coefficients, from);
    let slope = *moved.get(1)?;
    let noise = least + ROUNDING * sums(coefficients, 0, from.abs().max(until.abs())).0;
    let mut length = until - from;
    // |d₁| h > Σ |dₖ| hᵏ, k ≥ 2, while the left side is above the noise: halving shrinks the right side faster.
    while slope.abs() * length > noise {
        let (bends, _) = sums(&moved, 2, length);
        if slope.abs() * length > bends + noise {
            return Some((from + length, slope.signum()));
        }
        length *= 0.5;
    }
    None
}

/// True if the guard has this side on the whole step, whose length is given.
pub(super) fn stays(coefficients: &[f64], side: f64, length: f64) -> bool {
    let here = coefficients[0] * side;
    let (others, _) = sums(coefficients, 1, length.abs());
    // The usual case needs no other point.
    if here > (1.0 + ROUNDING) * others {
        return true;
    }
    let is_clear = |value: f64| value * side > ROUNDING * (here.abs() + others);
    match OnInterval::new(coefficients, (0.0, length)).test(0.0, 0.0) {
        ZeroTest::NoZero { sign } => sign == side,
        ZeroTest::Monotone { .. } => {
            is_clear(coefficients[0]) && is_clear(equations::horner(coefficients, length))
        }
        ZeroTest::Hidden | ZeroTest::Undecided => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// (t − 1)(t − 2) = 2 − 3t + t², and a dip that does not reach zero.
    #[test]
    fn zeros_of_a_polynomial_are_seen() {
        let both = [2.0, -3.0, 1.0];
        let zero_test = |coefficients: &[f64], times, level, noise| {
            OnInterval::new(coefficients, times).test(level, noise)
        };
        assert_eq!(zero_test(&both, (0.0, 0.5), 0.0, 0.0), ZeroTest::NoZero { sign: 1.0 });
        assert_eq!(zero_test(&both, (0.9, 1.3), 0.0, 0.0), ZeroTest::Monotone { slope: -1.0 });
        assert_eq!(zero_test(&both, (0.0, 3.0), 0.0, 0.0), ZeroTest::Undecided);
        assert_eq!(zero_test(&both, (1.9, 2.3), -0.25, 0.0), ZeroTest::NoZero { sign: 1.0 });
        assert_eq!(zero_test(&both, (1.0, 1.0 + 1e-14), 0.0, 1e-13), ZeroTest::Hidden);
        assert!(stays(&both, 1.0, 0.6) && !stays(&both, 1.0, 1.1) && !stays(&both, -1.0, 0.5));
        // 1 above its lowest point, at 10.
        assert!(!stays(&[101.0, -20.0, 1.0], 1.0, 20.0));
        assert!(stays(&[101.0, -20.0, 1.0], 1.0, 4.0));
    }
}
