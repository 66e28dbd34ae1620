//! A test for zeros of a guard that is a polynomial in the time since a step began.
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

/// Tests a guard minus `level` on an interval of the step, given by its ends since the step began. `noise` bounds the
/// rounding of its values.
pub(super) fn zero_test(
    coefficients: &[f64],
    (left, right): (f64, f64),
    level: f64,
    noise: f64,
) -> ZeroTest {
    let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left).abs());
    let farthest = left.abs().max(right.abs());
    let noise = noise + ROUNDING * sums(coefficients, 0, farthest).0;
    let moved = around(coefficients, middle);
    let (others, _) = sums(&moved, 1, radius);
    let here = moved[0] - level;
    if here.abs() > others + noise {
        return ZeroTest::NoZero { sign: here.signum() };
    }
    if here.abs() + others <= 2.0 * noise {
        return ZeroTest::Hidden;
    }
    let (_, bends) = sums(&moved, 2, radius);
    let slope = moved.get(1).copied().unwrap_or(0.0);
    if slope.abs() * radius > bends + noise {
        return ZeroTest::Monotone { slope: slope.signum() };
    }
    ZeroTest::Undecided
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
    match zero_test(coefficients, (0.0, length), 0.0, 0.0) {
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
