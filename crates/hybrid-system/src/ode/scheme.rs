//! The Runge–Kutta scheme: Verner's 9(8) pair with its interpolant of order 8.
//!
//! The only file that uses `differential-equations`, for its table of coefficients.

use super::chebyshev::{CHEBYSHEV, NODES};
use differential_equations::tableau::ButcherTableau;
use std::sync::LazyLock;

/// Stages of a step.
pub(super) const STAGES: usize = 16;

/// Stages with those of the interpolant.
pub(super) const ALL_STAGES: usize = 21;

/// Order of a step.
pub(super) const ORDER: u32 = 9;

/// Coefficients, as a step needs them.
pub(super) struct Scheme {
    /// bᵢ.
    pub(super) weights: [f64; STAGES],
    /// bᵢ less those of order 8.
    pub(super) errors: [f64; STAGES],
    /// cᵢ.
    pub(super) times: [f64; ALL_STAGES],
    /// Row i: the aᵢⱼ that are not zero, with their j, by twos; a zero may fill the last.
    pub(super) rows: [Vec<[(usize, f64); 2]>; ALL_STAGES],
    /// By stages: the weights of the interpolant at the Chebyshev nodes of the step.
    pub(super) nodes: [[f64; NODES]; ALL_STAGES],
}

/// At tolerances from 1e-9 down a pair of lower order takes more time: measured on a pendulum and on a valve
/// where stability limits the steps.
pub(super) static SCHEME: LazyLock<Scheme> = LazyLock::new(Scheme::new);

impl Scheme {
    fn new() -> Self {
        let table: ButcherTableau<f64, STAGES, ALL_STAGES> = ButcherTableau::rkv988e();
        let lower = table.bh.unwrap_or(table.b);
        let inside = table.bi.unwrap_or([[0.0; ALL_STAGES]; ALL_STAGES]);
        let row = |i: usize| {
            let terms: Vec<_> =
                (0..i).map(|j| (j, table.a[i][j])).filter(|&(_, a)| a != 0.0).collect();
            terms.chunks(2).map(|two| [two[0], *two.get(1).unwrap_or(&(0, 0.0))]).collect()
        };
        Scheme {
            weights: table.b,
            errors: std::array::from_fn(|i| table.b[i] - lower[i]),
            times: table.c,
            rows: std::array::from_fn(row),
            nodes: at_nodes(&inside),
        }
    }
}

/// The weights of the interpolant at the nodes, by stages.
fn at_nodes(inside: &[[f64; ALL_STAGES]; ALL_STAGES]) -> [[f64; NODES]; ALL_STAGES] {
    let mut all = [[0.0; NODES]; ALL_STAGES];
    for (node, u) in CHEBYSHEV.nodes.iter().enumerate() {
        let s = 0.5 * (1.0 + u);
        for (weights, c) in all.iter_mut().zip(inside) {
            weights[node] = s * c.iter().rev().fold(0.0, |sum, c| sum * s + c);
        }
        // Coefficients of 10⁵ leave 10⁻¹¹; that a constant field is followed exactly is restored.
        let sum: f64 = all.iter().map(|weights| weights[node]).sum();
        all[0][node] += s - sum;
    }
    all
}

/// x^(−1/9), to a few percent: sizes of steps need no more.
pub(super) fn inverse_root(x: f64) -> f64 {
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    // The bits of a double are its logarithm, piecewise linear.
    let order = u64::from(ORDER);
    let x = x.max(f64::MIN_POSITIVE);
    let guess = f64::from_bits(ONE + ONE / order - x.to_bits() / order);
    // One of Newton's steps for y⁻ⁿ = x.
    guess + guess * (1.0 - x * guess.powi(ORDER as i32)) / f64::from(ORDER)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_roots_to_a_few_percent() {
        for k in -300..300 {
            let x = 1.37f64.powi(k);
            let exact = pxfm::f_pow(x, -1.0 / f64::from(ORDER));
            assert!((inverse_root(x) / exact - 1.0).abs() < 0.03, "{x}");
        }
    }

    /// The sums that make a scheme consistent: Σ bᵢ = 1, Σⱼ aᵢⱼ = cᵢ, Σ bᵢ cᵢᵏ = 1/(k+1).
    #[test]
    fn table() {
        for (row, time) in SCHEME.rows.iter().zip(&SCHEME.times) {
            assert!((row.iter().flatten().map(|(_, a)| a).sum::<f64>() - time).abs() < 1e-12);
        }
        for k in 0..ORDER {
            let terms = SCHEME.weights.iter().zip(&SCHEME.times);
            let sum: f64 = terms.map(|(b, c)| b * c.powi(k as i32)).sum();
            assert!((sum - 1.0 / f64::from(k + 1)).abs() < 1e-12, "{k}: {sum}");
        }
        assert!(SCHEME.errors.iter().sum::<f64>().abs() < 1e-12);
    }
}
