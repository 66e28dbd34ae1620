//! One step of an integration as a polynomial, cheap to look into.

use super::Integration;
use super::chebyshev::STATE;
use crate::{Error, State};

/// The state along one step: component by component a polynomial of degree nine in u ∈ [−1, 1],
/// t = middle + u·radius, by its Chebyshev coefficients.
#[derive(Debug, Clone, Copy)]
pub(super) struct Step<const N: usize> {
    pub(super) from: f64,
    pub(super) to: f64,
    coefficients: [State<N>; 10],
}

impl<const N: usize> Step<N> {
    /// The last step of an integration.
    pub(super) fn last_of<F: Fn(f64, &State<N>) -> State<N>>(
        integration: &mut Integration<F, N>,
    ) -> Result<Self, Error> {
        let (from, to) = integration.interval();
        let (middle, radius) = (0.5 * (from + to), 0.5 * (to - from));
        let transform = &*STATE;
        let mut values = [State::zeros(); 10];
        for (value, node) in values.iter_mut().zip(transform.nodes) {
            *value = integration.at((middle + radius * node).clamp(from, to))?;
        }
        Ok(Step { from, to, coefficients: transform.coefficients(&values) })
    }

    /// The state at a time of the step, by Clenshaw's recurrence.
    pub(super) fn state(&self, time: f64) -> State<N> {
        let u = ((time - self.from) - (self.to - time)) / (self.to - self.from);
        let (mut next, mut after) = (State::zeros(), State::zeros());
        for coefficient in self.coefficients.iter().skip(1).rev() {
            (next, after) = (coefficient + next * (2.0 * u) - after, next);
        }
        self.coefficients[0] + next * u - after
    }

    /// The same step, moved by a constant.
    pub(super) fn moved(mut self, by: State<N>) -> Self {
        self.coefficients[0] += by;
        self
    }

    /// A bound on the size of each component along the step.
    pub(super) fn size(&self) -> State<N> {
        self.coefficients.iter().fold(State::zeros(), |sum, c| sum + c.abs())
    }
}
