//! The Runge–Kutta schemes: Verner's pairs 9(8) and 8(7), with interpolants of order 8.
//!
//! The only file that uses `differential-equations`, for its tables of coefficients.

use super::chebyshev::{CHEBYSHEV, NODES};
use differential_equations::tableau::ButcherTableau;
use std::sync::LazyLock;

/// Stages of a step with those of its interpolant.
pub(super) const ALL_STAGES: usize = 21;

/// Coefficients, as a step needs them.
pub(super) struct Scheme {
    /// Order of a step.
    pub(super) order: u32,
    /// Stages of a step.
    pub(super) stages: usize,
    /// bᵢ.
    pub(super) weights: Vec<f64>,
    /// bᵢ less those of the lower order.
    pub(super) errors: Vec<f64>,
    /// cᵢ.
    pub(super) times: [f64; ALL_STAGES],
    /// Row i: the aᵢⱼ that are not zero, with their j, by twos; a zero may fill the last.
    pub(super) rows: [Vec<[(usize, f64); 2]>; ALL_STAGES],
    /// By stages: the weights of the interpolant at the Chebyshev nodes of the step.
    pub(super) nodes: [[f64; NODES]; ALL_STAGES],
}

/// For tight tolerances.
static NINE: LazyLock<Scheme> =
    LazyLock::new(|| Scheme::new(9, &ButcherTableau::<f64, 16, ALL_STAGES>::rkv988e()));

/// For others: fewer stages a step.
static EIGHT: LazyLock<Scheme> =
    LazyLock::new(|| Scheme::new(8, &ButcherTableau::<f64, 13, ALL_STAGES>::rkv878e()));

/// The tolerance under which order nine takes less time: measured on a valve whose stability limits the steps.
const TIGHT: f64 = 2e-11;

impl Scheme {
    /// The scheme for a tolerance.
    pub(super) fn within(tolerance: f64) -> &'static Self {
        if tolerance < TIGHT { &NINE } else { &EIGHT }
    }

    fn new<const S: usize>(order: u32, table: &ButcherTableau<f64, S, ALL_STAGES>) -> Self {
        let lower = table.bh.unwrap_or(table.b);
        let inside = table.bi.unwrap_or([[0.0; ALL_STAGES]; ALL_STAGES]);
        let row = |i: usize| {
            let terms: Vec<_> =
                (0..i).map(|j| (j, table.a[i][j])).filter(|&(_, a)| a != 0.0).collect();
            terms.chunks(2).map(|two| [two[0], *two.get(1).unwrap_or(&(0, 0.0))]).collect()
        };
        Scheme {
            order,
            stages: S,
            weights: table.b.to_vec(),
            errors: table.b.iter().zip(&lower).map(|(b, lower)| b - lower).collect(),
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
            weights[node] = s * compensated(c, s);
        }
    }
    all
}

/// Σ cₖ sᵏ as if in twice the digits (Graillat, Langlois, Louvet 2005): coefficients of 10⁵ cancel.
fn compensated(c: &[f64], s: f64) -> f64 {
    let (mut sum, mut lost) = (0.0, 0.0);
    for &c in c.iter().rev() {
        let product: f64 = sum * s;
        let next = product + c;
        let back = next - product;
        let rounded = (product - (next - back)) + (c - back);
        lost = lost * s + (sum.mul_add(s, -product) + rounded);
        sum = next;
    }
    sum + lost
}

/// x^(−1/order), to a few percent: sizes of steps need no more.
pub(super) fn inverse_root(x: f64, order: u32) -> f64 {
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    // The bits of a double are its logarithm, piecewise linear.
    let parts = u64::from(order);
    let x = x.max(f64::MIN_POSITIVE);
    let guess = f64::from_bits(ONE + ONE / parts - x.to_bits() / parts);
    // One of Newton's steps for y⁻ⁿ = x.
    guess + guess * (1.0 - x * guess.powi(order as i32)) / f64::from(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_roots_to_a_few_percent() {
        for (k, order) in (-300..300).flat_map(|k| [(k, 8), (k, 9)]) {
            let x = 1.37f64.powi(k);
            let exact = pxfm::f_pow(x, -1.0 / f64::from(order));
            assert!((inverse_root(x, order) / exact - 1.0).abs() < 0.03, "{x}");
        }
    }

    /// The sums that make a scheme consistent: Σ bᵢ = 1, Σⱼ aᵢⱼ = cᵢ, Σ bᵢ cᵢᵏ = 1/(k+1).
    ///
    /// The table of order eight is printed with fewer digits.
    #[test]
    fn tables() {
        for (scheme, digits) in [(&*NINE, 1e-13), (&*EIGHT, 5e-12)] {
            for (row, time) in scheme.rows.iter().zip(&scheme.times) {
                assert!((row.iter().flatten().map(|(_, a)| a).sum::<f64>() - time).abs() < digits);
            }
            for k in 0..scheme.order {
                let terms = scheme.weights.iter().zip(&scheme.times);
                let sum: f64 = terms.map(|(b, c)| b * c.powi(k as i32)).sum();
                assert!((sum - 1.0 / f64::from(k + 1)).abs() < digits, "{k}: {sum}");
            }
            assert!(scheme.errors.iter().sum::<f64>().abs() < digits);
        }
    }
}
