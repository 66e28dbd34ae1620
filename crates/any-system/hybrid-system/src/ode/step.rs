//! The state along one step of an integration, as a polynomial in time.

use super::chebyshev::{CHEBYSHEV, NODES};
use super::rows::Rows;
use crate::state::StateVector;
use std::cell::OnceCell;

/// The largest number of Chebyshev coefficients of the polynomial: the interpolants have degree eight at most.
const COEFFICIENTS: usize = 9;

/// The state along one step: component by component a polynomial in u ∈ [−1, 1], t = middle + u·radius.
#[derive(Debug, Clone)]
pub(super) struct Step<V> {
    pub(super) from: f64,
    pub(super) to: f64,
    /// Any state of the same dimension.
    like: V,
    degree: usize,
    /// The states at the Chebyshev nodes.
    nodes: Rows<NODES>,
    /// Chebyshev coefficients, computed at their first use. Those above the degree would be rounding errors.
    coefficients: OnceCell<Rows<COEFFICIENTS>>,
}

impl<V: StateVector> Step<V> {
    /// The polynomial of this degree, at most eight, through the states at the nodes. `like` is any state of the same
    /// dimension.
    pub(super) fn new(from: f64, to: f64, degree: usize, like: V, nodes: Rows<NODES>) -> Self {
        Step { from, to, like, degree, nodes, coefficients: OnceCell::new() }
    }

    fn coefficients(&self) -> &[f64] {
        let n = self.like.dimension();
        let computed = self.coefficients.get_or_init(|| {
            let mut rows = Rows::new(n);
            let nodes = self.nodes.all(n);
            let all = rows.all_mut(n);
            for axis in 0..n {
                let values = std::array::from_fn(|j| nodes[j * n + axis]);
                let coefficients: [f64; COEFFICIENTS] = CHEBYSHEV.coefficients(&values);
                for (k, coefficient) in coefficients.iter().take(self.degree + 1).enumerate() {
                    all[k * n + axis] = *coefficient;
                }
            }
            rows
        });
        computed.all(n)
    }

    /// The state at a time of the step, by Clenshaw's recurrence.
    ///
    /// All components take one step of the recurrence after the other: the processor computes them in parallel.
    pub(super) fn state(&self, time: f64) -> V {
        // The formula is symmetric in both ends: u is exactly ∓1 there.
        let u = ((time - self.from) - (self.to - time)) / (self.to - self.from);
        let n = self.like.dimension();
        let coefficients = self.coefficients();
        let (mut next, mut after) = (self.like.zeros_like(), self.like.zeros_like());
        for row in coefficients[n..(self.degree + 1) * n].chunks_exact(n.max(1)).rev() {
            let both = next.components_mut().iter_mut().zip(after.components_mut());
            for ((next, after), coefficient) in both.zip(row) {
                let sum = coefficient + 2.0 * u * *next - *after;
                (*after, *next) = (*next, sum);
            }
        }
        let both = next.components_mut().iter_mut().zip(after.components());
        for ((next, after), coefficient) in both.zip(coefficients) {
            *next = coefficient + *next * u - after;
        }
        next
    }

    /// A bound on the absolute value of each component along the step: Σ|cₖ|, because |Tₖ| ≤ 1.
    pub(super) fn magnitude(&self) -> V {
        let n = self.like.dimension();
        let coefficients = self.coefficients();
        self.like.filled(|axis| {
            (0..=self.degree).fold(0.0, |sum, k| sum + coefficients[k * n + axis].abs())
        })
    }
}
