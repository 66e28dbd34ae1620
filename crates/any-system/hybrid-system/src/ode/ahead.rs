//! The first steps of an arc that are known before its events are searched: `many_fates` writes them.

use equations::Step;

/// Steps that are known ahead, in memory that is used again.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ahead {
    steps: Vec<Step>,
    count: usize,
    /// The time from the start of the arc to which they lead.
    horizon: f64,
}

impl Ahead {
    /// The steps of a search up to this time, from the start of the arc on. A step may end at the horizon: one to another horizon would
    /// be another one.
    pub(crate) fn steps(&self, horizon: f64) -> &[Step] {
        let count = if horizon == self.horizon { self.count } else { 0 };
        &self.steps[..count]
    }

    /// Begins with the steps of an arc up to a time.
    pub(crate) fn begin(&mut self, horizon: f64) {
        (self.count, self.horizon) = (0, horizon);
    }

    /// The number of steps.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Memory for the next step, which `make` makes at first. [`keep`](Self::keep) counts it.
    pub(crate) fn memory(&mut self, make: impl FnOnce() -> Step) -> &mut Step {
        if self.count == self.steps.len() {
            self.steps.push(make());
        }
        &mut self.steps[self.count]
    }

    /// The step that was written into the memory belongs to the arc.
    pub(crate) fn keep(&mut self) {
        self.count += 1;
    }

    /// Forgets the steps: the arc has been followed.
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }
}
