//! A test for zeros of a guard, by the polynomial through its values.
//!
//! On an interval, with u ∈ [−1, 1] for the time, the guard is represented by the polynomial Σ cₖ Tₖ(u) through its
//! values at 16 Chebyshev nodes. |Tₖ| ≤ 1 and |Tₖ′| ≤ k². Let ν bound the neglected coefficients and the rounding. Then
//!
//! ```text
//!   |c₀| > Σ|cₖ| + ν         no zero on the interval
//!   |c₁| > Σ k²|cₖ| + ν′     monotone: a zero if and only if its sign changes      (k ≥ 2)
//! ```
//!
//! This is statement (6) of [mathematics](crate::mathematics); the start at zero is statement (7).

use super::chebyshev::{CHEBYSHEV, NODES};
use crate::error::Error;

/// The neglected coefficients are assumed to add up to this many times the last two, |c₁₄| + |c₁₅|. The assumption
/// holds for coefficients that decay like ρᵏ with ρ²/(1 − ρ²) ≤ 8, ρ ≤ 0.94. Slower decay makes the last coefficients
/// large, so that the test fails and the interval is halved. With a factor that is too small a zero could be missed.
const NEGLECTED: f64 = 8.0;

/// Relative rounding error of a coefficient: a product and a sum for each of the 16 values.
const COEFFICIENT_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Σ k² for 1 ≤ k < 16: the slope of a polynomial all of whose coefficients are 1. Therefore it is also the factor from
/// an error of the coefficients to an error of the slope.
const SLOPE_OF_ONES: f64 = 1240.0;

/// A guard that started at zero has left zero when a value on the interval exceeds its rounding error by this factor.
/// Smaller values have too few digits to show the order of the zero. A larger factor needs a longer interval, which may
/// already contain the next crossing.
pub(super) const LEFT_ZERO: f64 = 1000.0;

/// Highest order of a zero at the start. Each order divides by τ ≥ 0.0024, and so multiplies the noise by up to 415.
/// After four divisions a noise of 32ε is 2·10⁻⁴ of the values; after a fifth division it would be a tenth of them.
const HIGHEST_ORDER: usize = 4;

/// The result of the test.
pub(super) enum PolynomialTest {
    /// The guard has no zero on the interval.
    NoZero {
        /// Its sign there, ±1.
        sign: f64,
    },
    /// The guard is monotone on the interval.
    Monotone {
        /// The sign of its slope, ±1.
        slope: f64,
    },
    /// All values are within rounding of zero: a shorter interval would not decide either.
    WithinRounding,
    /// The polynomial allows no decision: the interval must be halved.
    Undecided,
}

/// Tests a guard on an interval. `rounding` bounds the error of its values.
pub(super) fn test(
    along: impl Fn(f64) -> f64,
    left: f64,
    right: f64,
    rounding: f64,
) -> Result<PolynomialTest, Error> {
    let values = values_at_nodes(along, left, right)?;
    Ok(test_values(&values, rounding))
}

fn test_values(values: &[f64; NODES], rounding: f64) -> PolynomialTest {
    let largest = largest(values);
    let noise = COEFFICIENT_ROUNDING * largest + rounding;
    // A true value and its error, both up to `rounding`, add up to twice that.
    if largest <= 2.0 * rounding {
        return PolynomialTest::WithinRounding;
    }
    let c: [f64; NODES] = CHEBYSHEV.coefficients(values);
    let neglected = neglected(&c);
    let others: f64 = c[1..].iter().map(|c| c.abs()).sum();
    if c[0].abs() > others + neglected + noise {
        return PolynomialTest::NoZero { sign: c[0].signum() };
    }
    let bends: f64 = (2..NODES).map(|k| (k * k) as f64 * c[k].abs()).sum();
    // k² of the first neglected coefficient.
    let next_square = (NODES * NODES) as f64;
    if c[1].abs() > bends + next_square * neglected + SLOPE_OF_ONES * noise {
        return PolynomialTest::Monotone { slope: c[1].signum() };
    }
    PolynomialTest::Undecided
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, value| size.max(value.abs()))
}

/// An estimate of the neglected coefficients, Σ|cₖ| for k ≥ 16.
fn neglected(c: &[f64]) -> f64 {
    NEGLECTED * c.iter().rev().take(2).map(|c| c.abs()).sum::<f64>()
}

/// True if the polynomial through the values is zero at the left end, within `noise`.
fn starts_at_zero(values: &[f64; NODES], noise: f64) -> bool {
    let c: [f64; NODES] = CHEBYSHEV.coefficients(values);
    // Tₖ(−1) = (−1)ᵏ.
    let start: f64 = c.iter().enumerate().map(|(k, c)| if k % 2 == 0 { *c } else { -c }).sum();
    start.abs() <= neglected(&c) + COEFFICIENT_ROUNDING * largest(values) + noise
}

/// Tests how a guard leaves a zero at the left end of the interval.
///
/// With τ ∈ (0, 1) for the time, the guard leaves zero with the sign of (g(t) − g(0))/τᵏ, if that quotient has no
/// zero on the interval and the quotients for smaller k start at zero.
pub(super) fn test_leaving_zero(
    along: impl Fn(f64) -> f64,
    left: f64,
    right: f64,
    rounding: f64,
) -> Result<PolynomialTest, Error> {
    let start = along(left);
    let values = values_at_nodes(along, left, right)?;
    let largest = largest(&values);
    if largest <= LEFT_ZERO * rounding {
        return Ok(PolynomialTest::WithinRounding);
    }
    let plain = test_values(&values, rounding);
    if !matches!(plain, PolynomialTest::Undecided) {
        return Ok(plain);
    }
    // The nodes as τ, largest first.
    let tau = CHEBYSHEV.nodes.map(|u| 0.5 * (1.0 + u));
    let mut divided = values.map(|value| value - start);
    let mut noise = COEFFICIENT_ROUNDING * largest + rounding + start.abs();
    for _order in 1..=HIGHEST_ORDER {
        // If the numerator is not zero at the start, the quotient has a pole there, and a polynomial cannot
        // represent it.
        if !starts_at_zero(&divided, noise) {
            break;
        }
        for (value, tau) in divided.iter_mut().zip(tau) {
            *value /= tau;
        }
        noise /= tau[NODES - 1];
        if let found @ PolynomialTest::NoZero { .. } = test_values(&divided, noise) {
            return Ok(found);
        }
    }
    Ok(PolynomialTest::Undecided)
}

fn values_at_nodes(
    along: impl Fn(f64) -> f64,
    left: f64,
    right: f64,
) -> Result<[f64; NODES], Error> {
    let (middle, radius) = (left + 0.5 * (right - left), 0.5 * (right - left));
    let mut values = [0.0; NODES];
    for (value, node) in values.iter_mut().zip(CHEBYSHEV.nodes) {
        // Rounding must not lead outside the step.
        let at = (middle + radius * node).clamp(left, right);
        *value = along(at);
        if !value.is_finite() {
            return Err(Error::NotFinite { at, value: *value });
        }
    }
    Ok(values)
}
