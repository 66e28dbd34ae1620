//! The Runge–Kutta schemes: J. H. Verner's "efficient" pairs of orders 9(8) and 8(7), with interpolants of order 8.
//!
//! The coefficients are the tables `rkv988e` and `rkv878e` of the crate `differential-equations`, which copies them
//! from Verner's pages. This is the only file that uses that crate, and only for these tables. The tests check the
//! sums that make a scheme consistent.

use super::chebyshev::{CHEBYSHEV, NODES};
use differential_equations::tableau::ButcherTableau;
use std::sync::LazyLock;

/// Stages of a step plus the stages of its interpolant, in both tables.
pub(super) const ALL_STAGES: usize = 21;

/// The coefficients of a scheme, arranged as a step needs them.
pub(super) struct Scheme {
    /// Order of a step, the higher one of the pair.
    pub(super) order: u32,
    /// Stages of a step without the stages of its interpolant.
    pub(super) stages: usize,
    /// bᵢ: a step is x + h Σ bᵢ kᵢ.
    pub(super) weights: Vec<f64>,
    /// bᵢ minus the weights of the lower order: h Σ eᵢ kᵢ estimates the error of a step.
    pub(super) errors: Vec<f64>,
    /// cᵢ: stage i is at time t + cᵢ h.
    pub(super) times: [f64; ALL_STAGES],
    /// Row i: the aᵢⱼ that are not zero, as (j, aᵢⱼ), in pairs. The last pair may be filled with a zero.
    pub(super) rows: [Vec<[(usize, f64); 2]>; ALL_STAGES],
    /// Row i: the weights of stage i in the interpolant at the Chebyshev nodes of the step.
    pub(super) nodes: [[f64; NODES]; ALL_STAGES],
}

/// Orders 9(8), 16 stages: for tight tolerances.
static NINE: LazyLock<Scheme> =
    LazyLock::new(|| Scheme::new(9, &ButcherTableau::<f64, 16, ALL_STAGES>::rkv988e()));

/// Orders 8(7), 13 stages: for all other tolerances.
static EIGHT: LazyLock<Scheme> =
    LazyLock::new(|| Scheme::new(8, &ButcherTableau::<f64, 13, ALL_STAGES>::rkv878e()));

/// The tolerance below which order nine takes less time. Chosen by measurement, on the pressure relief valve of the
/// crate `return-map`, whose steps are limited by stability. It affects speed only: both schemes meet every
/// tolerance.
const TIGHT: f64 = 2e-11;

impl Scheme {
    /// The scheme for a tolerance.
    pub(super) fn within(tolerance: f64) -> &'static Self {
        if tolerance < TIGHT { &NINE } else { &EIGHT }
    }

    fn new<const S: usize>(order: u32, table: &ButcherTableau<f64, S, ALL_STAGES>) -> Self {
        let lower = table.bh.unwrap_or(table.b);
        let inside = table.bi.unwrap_or([[0.0; ALL_STAGES]; ALL_STAGES]);
        // Each step sums a row in two independent halves, the even and the odd terms.
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

/// The weights of the interpolant at the nodes, for each stage: bᵢ(s) = s Σ cₖ sᵏ at s ∈ (0, 1), the place in the step.
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

/// Σ cₖ sᵏ as if in twice the digits: the compensated Horner scheme of Graillat, Langlois and Louvet (2005).
///
/// The coefficients of the interpolants are as large as 10⁵ and cancel; the plain scheme would lose five digits.
fn compensated(c: &[f64], s: f64) -> f64 {
    let (mut sum, mut correction) = (0.0, 0.0);
    for &c in c.iter().rev() {
        let product: f64 = sum * s;
        let next = product + c;
        // The exact errors: of the sum (Knuth's two-sum) and of the product (by a fused multiply-add). These errors are
        // the coefficients of a second polynomial, which is summed at the same time.
        let back = next - product;
        let sum_error = (product - (next - back)) + (c - back);
        let product_error = sum.mul_add(s, -product);
        correction = correction * s + (product_error + sum_error);
        sum = next;
    }
    sum + correction
}

/// x^(−1/order), within 3 %. This accuracy suffices for the size of a step. A power function would take longer than the
/// rest of the step control.
pub(super) fn inverse_root(x: f64, order: u32) -> f64 {
    /// The bits of 1.0.
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    // The bits of a double, read as an integer, are a piecewise linear approximation of its logarithm, with 1.0 as
    // zero: log y = −(log x)/order.
    let parts = u64::from(order);
    // Zero and subnormal numbers do not follow that rule.
    let x = x.max(f64::MIN_POSITIVE);
    let guess = f64::from_bits(ONE + ONE / parts - x.to_bits() / parts);
    // One step of Newton's method for y⁻ⁿ = x.
    guess + guess * (1.0 - x * guess.powi(order as i32)) / f64::from(order)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverse_roots_are_right_within_three_percent() {
        for (k, order) in (-300..300).flat_map(|k| [(k, 8), (k, 9)]) {
            let x = 1.37f64.powi(k);
            let exact = pxfm::f_pow(x, -1.0 / f64::from(order));
            assert!((inverse_root(x, order) / exact - 1.0).abs() < 0.03, "{x}");
        }
    }

    /// The sums that make a scheme consistent: Σ bᵢ = 1, Σⱼ aᵢⱼ = cᵢ, Σ bᵢ cᵢᵏ = 1/(k+1).
    ///
    /// The published table of order eight has fewer digits, and so a larger tolerance.
    #[test]
    fn tables_satisfy_the_order_conditions() {
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
