//! One step of an integration as a polynomial, cheap to look into.

use super::chebyshev::{CHEBYSHEV, NODES};
use crate::State;
use std::cell::OnceCell;

/// Coefficients of the interpolants, which are of degree eight at most.
const COEFFICIENTS: usize = 9;

/// The state along one step: component by component a polynomial in u ∈ [−1, 1], t = middle + u·radius.
#[derive(Debug, Clone)]
pub(super) struct Step<const N: usize> {
    pub(super) from: f64,
    pub(super) to: f64,
    /// At the Chebyshev nodes.
    nodes: [State<N>; NODES],
    /// Chebyshev coefficients, once they are needed.
    coefficients: OnceCell<[State<N>; COEFFICIENTS]>,
}

impl<const N: usize> Step<N> {
    /// From its values at 16 Chebyshev nodes.
    pub(super) fn new(from: f64, to: f64, nodes: [State<N>; NODES]) -> Self {
        Step { from, to, nodes, coefficients: OnceCell::new() }
    }

    fn coefficients(&self) -> &[State<N>; COEFFICIENTS] {
        self.coefficients.get_or_init(|| CHEBYSHEV.coefficients(&self.nodes))
    }

    /// The state at a time of the step, by Clenshaw's recurrence.
    pub(super) fn state(&self, time: f64) -> State<N> {
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

    /// A bound on the size of each component along the step.
    pub(super) fn size(&self) -> State<N> {
        self.coefficients().iter().fold(State::zeros(), |sum, c| sum + c.abs())
    }
}
