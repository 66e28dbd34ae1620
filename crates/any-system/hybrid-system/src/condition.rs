//! Does an event count?

use crate::condition_error::ConditionError;
use crate::crossing::{Crossing, EventKind, stated_or_measured};
use crate::error::Error;
use crate::execution::Execution;
use crate::system::HybridSystem;

impl<T: HybridSystem> Execution<'_, T> {
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
        // NaN decides nothing.
        if value.abs() > error {
            return Ok(value > 0.0);
        }
        let (surface, time) = (format!("{surface:?}"), self.at.time.value() + crossing.time);
        Err(ConditionError::Undecided { surface, time, value, error }.into())
    }
}
