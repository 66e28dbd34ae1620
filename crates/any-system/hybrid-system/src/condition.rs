//! Does an event count?

use crate::condition_error::ConditionError;
use crate::crossing::{Crossing, EventKind, GuardedFlow, stated_or_measured};
use crate::error::Error;
use crate::execution::Execution;
use crate::system::HybridSystem;

/// What events that do not count have left on an arc: the state at each of them is a new start.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Passed {
    /// Their number.
    pub(crate) number: usize,
    /// The sum of the errors of their states, as far as those of their times show them.
    error: f64,
}

impl<T: HybridSystem> Execution<'_, T> {
    /// Notes an event that does not count, with the error of its time since the last start.
    pub(crate) fn pass(&mut self, crossing: &Crossing<T::Surface, T::State>, time_error: f64) {
        self.passed.number += 1;
        if crossing.kind == EventKind::Crossing {
            let error = time_error * self.rate_at(crossing);
            // Of an error that is not known nothing is known, whatever the rate.
            self.passed.error += if error.is_nan() { f64::INFINITY } else { error };
        }
    }

    /// The error of the time of an event by the events that were passed since the start of its arc.
    pub(crate) fn error_by_passed(&self, crossing: &Crossing<T::Surface, T::State>) -> f64 {
        if self.passed.number == 0 || crossing.kind != EventKind::Crossing {
            return 0.0;
        }
        let rounding = self.flow().rounding_at(crossing.surface, &crossing.state);
        let error = self.passed.error + self.passed.number as f64 * rounding;
        // A guard without a rate may be zero without any error.
        if error == 0.0 { 0.0 } else { error / self.rate_at(crossing) }
    }

    /// The rate of a guard at its event.
    fn rate_at(&self, crossing: &Crossing<T::Surface, T::State>) -> f64 {
        let Crossing { surface, ref state, time, time_error, .. } = *crossing;
        let look =
            self.look_time(time_error, (self.at.time.value() + time).abs().max(f64::MIN_POSITIVE));
        let flow = self.flow();
        let later = self.beside(state, (time, look));
        (flow.guard_value(surface, &later) - flow.guard_value(surface, state)).abs() / look
    }

    /// True if the event has no condition, or if its condition is positive at the state before it.
    ///
    /// # Errors
    /// [`ConditionError::OfBound`] for a guard that is no crossing; [`ConditionError::Undecided`] if its error is larger than the
    /// condition: by the rounding of the state, and by the time of the event, along the flow.
    pub(crate) fn counts(&self, crossing: &Crossing<T::Surface, T::State>) -> Result<bool, Error> {
        let Crossing { surface, ref state, .. } = *crossing;
        let condition = |state: &T::State| self.system.condition(self.at.mode, surface, state);
        let Some(value) = condition(state) else { return Ok(true) };
        let mut guards = self.system.guards(self.at.mode).iter();
        if guards.any(|guard| guard.surface == surface && guard.role.bounds_flow()) {
            return Err(ConditionError::OfBound { surface: format!("{surface:?}") }.into());
        }
        let of = |state: &T::State| condition(state).unwrap_or(f64::NAN);
        let by_time = match crossing.kind {
            EventKind::Clock => 0.0,
            _ => {
                let later = self.beside(state, (crossing.time, crossing.time_error));
                (of(&later) - value).abs()
            }
        };
        let error = stated_or_measured(None, state, &of) + by_time;
        // A zero without any error is not positive. NaN decides nothing.
        if value.abs() > error || value == 0.0 && error == 0.0 {
            return Ok(value > 0.0);
        }
        let (surface, time) = (format!("{surface:?}"), self.at.time.value() + crossing.time);
        Err(ConditionError::Undecided { surface, time, value, error }.into())
    }
}
