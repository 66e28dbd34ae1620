//! The state along one step of an integration, as a polynomial in time.

use super::chebyshev::{CHEBYSHEV, NODES};
use super::rows::Rows;
use crate::state::StateVector;
use smallvec::SmallVec;
use std::cell::OnceCell;

/// The largest number of Chebyshev coefficients of the polynomial: the interpolants have degree eight at most.
const COEFFICIENTS: usize = 9;

/// Rounding error of the polynomial, in units of that of the largest change on the step. The value is an estimate,
/// not derived: with the factors of `guard_rounding` it is 6·10⁻¹⁴ of the change. Measured on the problem of
/// `schemes`, steps of 1/16 and 1/32: the pair 9(8) is wrong by 2·10⁻¹⁶. If the value is too small, rounding is
/// taken for a crossing; if it is too large, touches are reported too early.
const CHANGE_ROUNDING: f64 = 64.0;

/// The same for a Taylor polynomial: each coefficient is the field's own, and Horner's rule rounds twice a term.
const TAYLOR_ROUNDING: f64 = 8.0;

/// Coefficients of a Taylor polynomial that are kept on the stack: four components to order 23.
const POWERS_IN_PLACE: usize = 96;

/// The state along one step: component by component the state where it begins, and a polynomial for the change since
/// then. So the rounding of the polynomial is that of the change: on a short step it is smaller than the last digit of the
/// state.
#[derive(Debug, Clone)]
pub(super) struct Step<V> {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The state where the step begins.
    before: V,
    polynomial: Polynomial,
}

/// The change of the state on a step.
#[derive(Debug, Clone)]
// The larger one belongs to the usual integration, and a step is seldom moved.
#[allow(clippy::large_enum_variant)]
enum Polynomial {
    /// In u ∈ [−1, 1], t = middle + u·radius.
    Chebyshev(Interpolant),
    /// In the time since the step began: coefficients of the powers from 1 on, those of all components side by side.
    Powers(SmallVec<[f64; POWERS_IN_PLACE]>),
}

#[derive(Debug, Clone)]
struct Interpolant {
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
        let coefficients = OnceCell::new();
        let polynomial = Polynomial::Chebyshev(Interpolant { degree, changes, coefficients });
        Step { from, to, before, polynomial }
    }

    /// The polynomials with these coefficients, one list for each component.
    pub(super) fn of_powers<'c>(
        (from, to): (f64, f64),
        like: &V,
        components: impl ExactSizeIterator<Item = &'c [f64]>,
    ) -> Self {
        let (n, mut before, mut powers) = (components.len(), like.zeros_like(), SmallVec::new());
        for (axis, coefficients) in components.enumerate() {
            before.components_mut()[axis] = coefficients[0];
            powers.resize(n * (coefficients.len() - 1), 0.0);
            for (k, coefficient) in coefficients[1..].iter().enumerate() {
                powers[k * n + axis] = *coefficient;
            }
        }
        Step { from, to, before, polynomial: Polynomial::Powers(powers) }
    }

    /// The state at a time of the step.
    pub(super) fn state(&self, time: f64) -> V {
        match &self.polynomial {
            Polynomial::Chebyshev(interpolant) => {
                // The formula is symmetric in both ends: u is exactly ∓1 there.
                let u = ((time - self.from) - (self.to - time)) / (self.to - self.from);
                interpolant.state(&self.before, u)
            }
            Polynomial::Powers(powers) => {
                let since = time - self.from;
                let mut sum = self.before.zeros_like();
                for row in powers.rchunks_exact(self.before.dimension().max(1)) {
                    for (sum, coefficient) in sum.components_mut().iter_mut().zip(row) {
                        *sum = *sum * since + coefficient;
                    }
                }
                let mut state = self.before.clone();
                state.add_scaled(since, &sum);
                state
            }
        }
    }

    /// Numbers as large as the rounding of each component along the step, in ulps: a bound on its absolute value, and
    /// [`CHANGE_ROUNDING`] times one on that of its change: Σ|cₖ|, because |Tₖ| ≤ 1, or Σ|cₖ|hᵏ.
    pub(super) fn rounding_size(&self) -> V {
        let n = self.before.dimension();
        let change = |axis: usize| match &self.polynomial {
            Polynomial::Chebyshev(interpolant) => {
                let coefficients = interpolant.coefficients(n);
                let terms = 0..=interpolant.degree;
                let sum = terms.fold(0.0, |sum, k| sum + coefficients[k * n + axis].abs());
                (1.0 + CHANGE_ROUNDING) * sum
            }
            Polynomial::Powers(powers) => {
                let length = (self.to - self.from).abs();
                let terms = powers[axis..].iter().step_by(n).rev();
                let sum = terms.fold(0.0, |sum, c| (sum + c.abs()) * length);
                (1.0 + TAYLOR_ROUNDING) * sum
            }
        };
        self.before.filled(|axis| self.before.components()[axis].abs() + change(axis))
    }
}

impl Interpolant {
    fn coefficients(&self, n: usize) -> &[f64] {
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

    /// The state at u, by Clenshaw's recurrence, from that before the step.
    ///
    /// All components take one step of the recurrence after the other: the processor computes them in parallel.
    fn state<V: StateVector>(&self, before: &V, u: f64) -> V {
        let n = before.dimension();
        let coefficients = self.coefficients(n);
        let (mut next, mut after) = (before.zeros_like(), before.zeros_like());
        for row in coefficients[n..(self.degree + 1) * n].chunks_exact(n.max(1)).rev() {
            let both = next.components_mut().iter_mut().zip(after.components_mut());
            for ((next, after), coefficient) in both.zip(row) {
                let sum = coefficient + 2.0 * u * *next - *after;
                (*after, *next) = (*next, sum);
            }
        }
        let both = next.components_mut().iter_mut().zip(after.components());
        for (((next, after), coefficient), before) in
            both.zip(coefficients).zip(before.components())
        {
            *next = before + (coefficient + *next * u - after);
        }
        next
    }
}
