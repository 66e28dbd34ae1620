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
use crate::crossing::ZeroTest;

/// The neglected coefficients are assumed to add up to this many times the last two, |c₁₄| + |c₁₅|. The assumption
/// holds for coefficients that decay like ρᵏ with ρ²/(1 − ρ²) ≤ 8, ρ ≤ 0.94. Slower decay makes the last coefficients
/// large, so that the test fails and the interval is halved. With a factor that is too small a zero could be missed.
const NEGLECTED: f64 = 8.0;

/// Relative rounding error of a coefficient: a product and a sum for each of the 16 values.
const COEFFICIENT_ROUNDING: f64 = 32.0 * f64::EPSILON;

/// Σ k² for 1 ≤ k < 16: the slope of a polynomial all of whose coefficients are 1. Therefore it is also the factor from
/// an error of the coefficients to an error of the slope.
const SLOPE_OF_ONES: f64 = 1240.0;

/// Highest order of a zero at the start. Each order divides by τ ≥ 0.0024, and so multiplies the noise by up to 415.
/// After four divisions a noise of 32ε is 2·10⁻⁴ of the values; after a fifth division it would be a tenth of them.
const HIGHEST_ORDER: usize = 4;

/// The first coefficient that counts as rounding where a smooth guard has only low ones. On such short intervals
/// already c₂ is small; with the four lowest left out, a slope and a bend that are just visible do not count.
const FIRST_ROUNDED: usize = 4;

/// The scatter of 16 values, in units of the root of the sum of squares of the coefficients from [`FIRST_ROUNDED`] on.
/// For independent errors that root is √(12/16) of their standard deviation. Three standard deviations, and somewhat
/// more for the root.
const SCATTER: f64 = 4.0;

/// Tests a guard on an interval, by its values at the nodes. `rounding` bounds their errors.
pub(super) fn zero_test(values: &[f64; NODES], rounding: f64) -> ZeroTest {
    let largest = largest(values);
    let noise = COEFFICIENT_ROUNDING * largest + rounding;
    // A true value and its error, both up to `rounding`, add up to twice that.
    if largest <= 2.0 * rounding {
        return ZeroTest::Hidden;
    }
    let c: [f64; NODES] = CHEBYSHEV.coefficients(values);
    let neglected = neglected(&c);
    let others: f64 = c[1..].iter().map(|c| c.abs()).sum();
    if c[0].abs() > others + neglected + noise {
        return ZeroTest::NoZero { sign: c[0].signum() };
    }
    let bends: f64 = (2..NODES).map(|k| (k * k) as f64 * c[k].abs()).sum();
    // k² of the first neglected coefficient.
    let next_square = (NODES * NODES) as f64;
    if c[1].abs() > bends + next_square * neglected + SLOPE_OF_ONES * noise {
        return ZeroTest::Monotone { slope: c[1].signum() };
    }
    ZeroTest::Undecided
}

pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |size: f64, value| size.max(value.abs()))
}

/// An estimate of the neglected coefficients, Σ|cₖ| for k ≥ 16.
fn neglected(c: &[f64]) -> f64 {
    NEGLECTED * c.iter().rev().take(2).map(|c| c.abs()).sum::<f64>()
}

/// The rounding of a guard's own arithmetic, by its values on an interval that is so short that a smooth guard is a
/// straight line there.
pub(super) fn scatter(values: &[f64; NODES]) -> f64 {
    let c: [f64; NODES] = CHEBYSHEV.coefficients(values);
    SCATTER * c[FIRST_ROUNDED..].iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// True if the guard jumps or has a kink among the nodes, on an interval on which a smooth guard is a straight line.
///
/// The distances of the values from the straight lines through their neighbours tell: at a jump or a kink most of
/// their sum belongs to three neighbouring nodes, and the lines before and behind them differ. Rounding moves all
/// values; if it moves only one, the lines are the same.
pub(super) fn is_broken(values: &[f64; NODES]) -> bool {
    let nodes = &CHEBYSHEV.nodes;
    let line = |a: usize, b: usize, at: usize| {
        values[a] + (values[b] - values[a]) * (nodes[at] - nodes[a]) / (nodes[b] - nodes[a])
    };
    let distances: [f64; NODES] = std::array::from_fn(|k| match k {
        0 => 0.0,
        k if k == NODES - 1 => 0.0,
        k => (values[k] - line(k - 1, k + 1, k)).abs(),
    });
    let around = |k: usize| distances[k - 1] + distances[k] + distances[k + 1];
    let Some(middle) = (1..NODES - 1).max_by(|a, b| around(*a).total_cmp(&around(*b))) else {
        return false;
    };
    if 2.0 * around(middle) <= distances.iter().sum() {
        return false;
    }
    // Near an end of the interval one of the lines is not known. Shorter intervals decide.
    if !(3..=NODES - 4).contains(&middle) {
        return true;
    }
    let differs =
        |at: usize| 2.0 * (line(0, middle - 2, at) - values[at]).abs() > distances[middle];
    differs(middle + 2) || differs(NODES - 1)
}

/// True if the polynomial through the values is zero at the left end, within `noise`.
fn starts_at_zero(values: &[f64; NODES], noise: f64) -> bool {
    let c: [f64; NODES] = CHEBYSHEV.coefficients(values);
    // Tₖ(−1) = (−1)ᵏ.
    let start: f64 = c.iter().enumerate().map(|(k, c)| if k % 2 == 0 { *c } else { -c }).sum();
    start.abs() <= neglected(&c) + COEFFICIENT_ROUNDING * largest(values) + noise
}

/// The side to which a guard leaves a zero at the left end of the interval, ±1, if it has no further zero there.
/// `changes` are its values at the nodes minus the value at the left end; `None` if the test does not decide.
///
/// With τ ∈ (0, 1) for the time, the guard leaves zero with the sign of (g(t) − g(0))/τᵏ, if that quotient has no
/// zero on the interval and the quotients for smaller k start at zero.
pub(super) fn side_after_zero(changes: &[f64; NODES], rounding: f64) -> Option<f64> {
    // The nodes as τ, largest first.
    let tau = CHEBYSHEV.nodes.map(|u| 0.5 * (1.0 + u));
    let mut divided = *changes;
    let mut noise = COEFFICIENT_ROUNDING * largest(changes) + rounding;
    for _order in 1..=HIGHEST_ORDER {
        // If the numerator is not zero at the start, the quotient has a pole there, and a polynomial cannot
        // represent it.
        if !starts_at_zero(&divided, noise) {
            return None;
        }
        for (value, tau) in divided.iter_mut().zip(tau) {
            *value /= tau;
        }
        noise /= tau[NODES - 1];
        if let ZeroTest::NoZero { sign } = zero_test(&divided, noise) {
            return Some(sign);
        }
    }
    None
}
