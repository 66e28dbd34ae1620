//! The state along one step of an integration, as a polynomial in time.

use super::chebyshev::{CHEBYSHEV, NODES};
use crate::state::State;
use std::cell::OnceCell;

/// The number of Chebyshev coefficients of the polynomial. The interpolants have degree eight at most: the other seven
/// of the 16 coefficients would be rounding errors.
const COEFFICIENTS: usize = 9;

/// The state along one step: component by component a polynomial in u ∈ [−1, 1], t = middle + u·radius.
#[derive(Debug, Clone)]
pub(super) struct Step<const N: usize> {
    pub(super) from: f64,
    pub(super) to: f64,
    /// The states at the Chebyshev nodes.
    nodes: [State<N>; NODES],
    /// Chebyshev coefficients, computed at their first use.
    coefficients: OnceCell<[State<N>; COEFFICIENTS]>,
}

impl<const N: usize> Step<N> {
    pub(super) fn new(from: f64, to: f64, nodes: [State<N>; NODES]) -> Self {
        Step { from, to, nodes, coefficients: OnceCell::new() }
    }

    fn coefficients(&self) -> &[State<N>; COEFFICIENTS] {
        self.coefficients.get_or_init(|| CHEBYSHEV.coefficients(&self.nodes))
    }

    /// The state at a time of the step, by Clenshaw's recurrence.
    pub(super) fn state(&self, time: f64) -> State<N> {
        // The formula is symmetric in both ends: u is exactly ∓1 there.
        let u = ((time - self.from) - (self.to - time)) / (self.to - self.from);
        let coefficients = self.coefficients();
        let (mut next, mut after) = (State::<N>::zeros(), State::<N>::zeros());
        for coefficient in coefficients.iter().skip(1).rev() {
            for axis in 0..N {
                let sum = coefficient[axis] + 2.0 * u * next[axis] - after[axis];
                (after[axis], next[axis]) = (next[axis], sum);
            }
        }
        coefficients[0] + next * u - after
    }

    /// A bound on the absolute value of each component along the step: Σ|cₖ|, because |Tₖ| ≤ 1.
    pub(super) fn magnitude(&self) -> State<N> {
        self.coefficients().iter().fold(State::zeros(), |sum, c| sum + c.abs())
    }
}
