//! What an integration knows after a step: its state, and the states inside the step, by a separate step, by the
//! interpolant, and by what the step has computed anyway.

use super::chebyshev::NODES;
use super::rows::Rows;
use super::steps::{AFTER, BEFORE, SLOPE, STATE, Steps, finite};
use super::vector::Vector;
use crate::error::Error;

/// The cubic through a step is sampled at its eighths.
const CUBIC_PARTS: u32 = 8;

impl<F: Fn(f64, &V) -> V, V: Vector> Steps<F, V> {
    /// True if the field is zero and does not depend on time: the state stays for ever.
    pub(super) fn at_rest(&self) -> bool {
        self.autonomous && self.vectors.row(SLOPE, self.n()).iter().all(|slope| *slope == 0.0)
    }

    /// True if the end has been reached.
    pub(super) fn ended(&self) -> bool {
        self.time == self.end
    }

    /// Trials that are left, rejected ones counted as well.
    pub(super) fn left(&self) -> usize {
        self.tolerances.steps.saturating_sub(self.taken)
    }

    pub(super) fn state(&self) -> V {
        self.argument.with_components(self.vectors.row(STATE, self.n()))
    }

    /// Makes each component of `sizes` at least as large as that of the state.
    pub(super) fn enlarge(&self, sizes: &mut V) {
        for (axis, component) in self.vectors.row(STATE, self.n()).iter().enumerate() {
            sizes.set_component(axis, sizes.component(axis).max(component.abs()));
        }
    }

    /// The field there.
    pub(super) fn slope(&self) -> V {
        self.argument.with_components(self.vectors.row(SLOPE, self.n()))
    }

    /// The state at a time in the last step, by a separate step that ends there.
    ///
    /// The coefficients of the interpolant are large and cancel. This separate step loses no digits. Its stages
    /// overwrite the stages of the last step.
    pub(super) fn directly_at(&mut self, time: f64) -> Result<V, Error> {
        let n = self.n();
        // Here the separate step would be the last step again, or have length zero.
        if time == self.time {
            return Ok(self.state());
        }
        if time == self.from {
            return Ok(self.argument.with_components(self.vectors.row(BEFORE, n)));
        }
        let size = time - self.from;
        for stage in 1..self.scheme.stages {
            if self.stage(stage, (self.from, BEFORE), size, time).is_err() {
                let state = self.vectors.row(BEFORE, n).to_vec();
                return Err(Error::FieldNotFinite { time: self.from, state });
            }
        }
        self.combine(BEFORE, size);
        let state = self.vectors.row(AFTER, n);
        if !finite(state) {
            return Err(Error::StateNotFinite { time, jumps: 0, state: state.to_vec() });
        }
        Ok(self.argument.with_components(state))
    }

    /// The polynomial of the last step: its degree, the state before the step, and the changes at the nodes. That at
    /// node j is h Σᵢ bᵢ(sⱼ) kᵢ.
    pub(super) fn inside(&mut self) -> Result<(usize, V, Rows<NODES>), Error> {
        let n = self.n();
        if !self.dense {
            for stage in self.scheme.stages..self.scheme.all_stages() {
                if self.stage(stage, (self.from, BEFORE), self.last, self.time).is_err() {
                    let state = self.vectors.row(BEFORE, n).to_vec();
                    return Err(Error::FieldNotFinite { time: self.from, state });
                }
            }
            self.dense = true;
        }
        let mut nodes = Rows::new(n);
        let slopes = self.slopes.all(n);
        for axis in 0..n {
            let mut changes = [0.0; NODES];
            for (stage, weights) in self.scheme.nodes.iter().enumerate() {
                for (sum, weight) in changes.iter_mut().zip(weights) {
                    *sum += weight * slopes[stage * n + axis];
                }
            }
            for (j, change) in changes.iter().enumerate() {
                nodes.all_mut(n)[j * n + axis] = self.last * change;
            }
        }
        let before = self.argument.with_components(self.vectors.row(BEFORE, n));
        Ok((self.scheme.degree, before, nodes))
    }

    /// States along the last step that need no evaluation of the field: see
    /// [`Integration::samples`](super::integration::Integration::samples).
    pub(super) fn samples(&self) -> impl Iterator<Item = V> {
        let n = self.n();
        let row = move |k| self.vectors.row(k, n);
        let (before, state, slope) = (row(BEFORE), row(STATE), row(SLOPE));
        let first = self.slopes.row(0, n);
        let cubic = (0..=CUBIC_PARTS).map(move |k| {
            // The cubic Hermite interpolant at s ∈ [0, 1], r = 1 − s.
            let s = f64::from(k) / f64::from(CUBIC_PARTS);
            let (r, part) = (1.0 - s, s * (1.0 - s) * self.last);
            let (a, b) = (r * r * (1.0 + 2.0 * s), s * s * (1.0 + 2.0 * r));
            let mut sample = self.argument.clone();
            for axis in 0..n {
                let bend = (first[axis] * r - slope[axis] * s) * part;
                sample.set_component(axis, before[axis] * a + state[axis] * b + bend);
            }
            sample
        });
        let stages = 1..self.scheme.stages;
        stages.map(move |k| self.argument.with_components(self.stages.row(k, n))).chain(cubic)
    }
}
