//! Steps of other lengths than the controller plans: the first one, and the one of a state that stays.

use super::first_step::first_step;
use super::steps::{AFTER, SLOPE, SLOPE_AFTER, STATE, Steps, finite, no_later};
use super::vector::Vector;
use crate::error::Error;

impl<F: Fn(f64, &V) -> V, V: Vector> Steps<F, V> {
    /// The length of the first step.
    pub(super) fn length_of_first_step(&mut self, direction: f64) -> f64 {
        let n = self.n();
        let (state, slope) = (self.vectors.row(STATE, n), self.vectors.row(SLOPE, n));
        let longest = (self.end - self.time).abs().min(self.tolerances.longest_step);
        let slope_after = |size: f64, after: &mut [f64]| {
            for axis in 0..n {
                let value = state[axis] + direction * size * slope[axis];
                self.argument.set_component(axis, value);
            }
            let time = no_later(self.time + direction * size, self.end, direction);
            let found = (self.field)(time, &self.argument);
            // A field of another length is an error of the first step.
            for (axis, after) in after.iter_mut().enumerate() {
                *after = if axis < found.length() { found.component(axis) } else { f64::NAN };
            }
            finite(after)
        };
        let (tolerances, order) = (&self.tolerances, self.scheme.order);
        // No step has used the slopes of stages yet.
        let space = self.slopes.row_mut(0, n);
        let first = first_step(state, slope, longest, tolerances, order, slope_after, space);
        first.min(self.longest_first)
    }

    /// A step to the end along which the state stays.
    pub(super) fn rest(&mut self) -> Result<(), Error> {
        if self.end.is_infinite() {
            let reason = "the field is zero, and the state stays for ever";
            return Err(Error::Integration { reason, time: self.time });
        }
        let n = self.n();
        self.slopes.all_mut(n).fill(0.0);
        for stage in 1..self.scheme.stages {
            self.stages.row_mut(stage, n).copy_from_slice(self.vectors.row(STATE, n));
        }
        self.vectors.row_mut(SLOPE_AFTER, n).fill(0.0);
        let all = self.vectors.all_mut(n);
        all.copy_within(STATE * n..(STATE + 1) * n, AFTER * n);
        self.accept(self.end - self.time, self.end);
        self.dense = true;
        Ok(())
    }
}
