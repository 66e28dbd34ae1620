//! The state along one step of an integration, as a polynomial in time.

use super::chebyshev::{CHEBYSHEV, NODES};
use super::rows::Rows;
use crate::state::StateVector;
use std::cell::OnceCell;

/// The largest number of Chebyshev coefficients of the polynomial: the interpolants have degree eight at most.
const COEFFICIENTS: usize = 9;

/// Rounding error of the polynomial, in units of that of the largest change on the step. The value is an estimate,
/// not derived: with the factors of `guard_rounding` it is 6·10⁻¹⁴ of the change. Measured on the problem of
/// `schemes`, steps of 1/16 and 1/32: the pair 9(8) is wrong by 2·10⁻¹⁶. If the value is too small, rounding is
/// taken for a crossing; if it is too large, touches are reported too early.
const CHANGE_ROUNDING: f64 = 64.0;

/// The state along one step: component by component the state where it begins, and a polynomial in u ∈ [−1, 1],
/// t = middle + u·radius, for the change since then. So the rounding of the polynomial is that of the change: on a
/// short step it is smaller than the last digit of the state.
#[derive(Debug, Clone)]
pub(super) struct Step<V> {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The state where the step begins.
    before: V,
    degree: usize,
    /// The changes of the state at the Chebyshev nodes.
    changes: Rows<NODES>,
    /// Chebyshev coefficients, computed at their first use. Those above the degree would be rounding errors.
    coefficients: OnceCell<Rows<COEFFICIENTS>>,
}

impl<V: StateVector> Step<V> {
    /// The polynomial of this degree, at most eight, through the `changes` of the state at the nodes.
    pub(super) fn new(
        (from, to): (f64, f64),
        degree: usize,
        before: V,
        changes: Rows<NODES>,
    ) -> Self {
        Step { from, to, before, degree, changes, coefficients: OnceCell::new() }
    }

    fn coefficients(&self) -> &[f64] {
        let n = self.before.dimension();
        let computed = self.coefficients.get_or_init(|| {
            let mut rows = Rows::new(n);
            let changes = self.changes.all(n);
            let all = rows.all_mut(n);
            for axis in 0..n {
                let values = std::array::from_fn(|j| changes[j * n + axis]);
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
        let n = self.before.dimension();
        let coefficients = self.coefficients();
        let (mut next, mut after) = (self.before.zeros_like(), self.before.zeros_like());
        for row in coefficients[n..(self.degree + 1) * n].chunks_exact(n.max(1)).rev() {
            let both = next.components_mut().iter_mut().zip(after.components_mut());
            for ((next, after), coefficient) in both.zip(row) {
                let sum = coefficient + 2.0 * u * *next - *after;
                (*after, *next) = (*next, sum);
            }
        }
        let both = next.components_mut().iter_mut().zip(after.components());
        for (((next, after), coefficient), before) in
            both.zip(coefficients).zip(self.before.components())
        {
            *next = before + (coefficient + *next * u - after);
        }
        next
    }

    /// Numbers as large as the rounding of each component along the step, in ulps: a bound on its absolute value, and
    /// [`CHANGE_ROUNDING`] times one on that of its change, Σ|cₖ|, because |Tₖ| ≤ 1.
    pub(super) fn rounding_size(&self) -> V {
        let n = self.before.dimension();
        let coefficients = self.coefficients();
        self.before.filled(|axis| {
            let change =
                (0..=self.degree).fold(0.0, |sum, k| sum + coefficients[k * n + axis].abs());
            self.before.components()[axis].abs() + (1.0 + CHANGE_ROUNDING) * change
        })
    }
}
