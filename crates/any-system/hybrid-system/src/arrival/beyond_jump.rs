//! Where does a reset or a flow lead, if the guard jumps at its surface, so that its value does not tell?

use super::{Arrival, LOOKBACK};
use crate::crossing::{GuardedFlow, is_far};
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};

/// The shortest look at a flow behind a jump of its guard, relative to the longest one: a motion under a force of 1
/// moves by the rounding of a state of size 1 in √(2·10⁻¹⁶). A smaller number would take more looks.
const SHORTEST_LOOK: f64 = 1.0 / 268_435_456.0;

impl<M: Copy, S: Copy + PartialEq, X: StateVector> Arrival<M, S, X> {
    /// True if the reset has moved the state beyond the crossed surface, although the guard has the same value
    /// there: it jumps at the surface.
    pub(crate) fn is_beyond_jump<T>(&self, next: &FlowFrom<T>) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let Some(surface) = self.surface else { return false };
        let value = next.guard_value(surface, next.start);
        let guard = |state: &X| next.guard_value(surface, state);
        // The usual case, a value of rounding, takes one evaluation.
        if self.from * value >= 0.0 || !is_far(next.start, next.start.largest(), value, guard) {
            return false;
        }
        let (_, change) = self.earlier(next.system, surface);
        let jumps = value.abs() > next.rounding_at(surface, next.start) + change;
        let moved = || self.moved_on(next, next.start, surface);
        jumps && moved().is_some_and(|moved| moved * self.from <= 0.0)
    }

    /// The guard a moment before the crossing, still on the side from which it came, moved on as the state has moved
    /// since the crossing up to `now`: by the reset, and along the flow of `next`. Where it is not on that side any
    /// more, this motion leads beyond the surface. `None` if the arc before was too short to show that side.
    fn moved_on<T>(&self, next: &FlowFrom<T>, now: &X, surface: S) -> Option<f64>
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let mut lookback = LOOKBACK * self.time_rounding.max(f64::EPSILON * self.duration);
        while lookback > 0.0 && lookback <= self.duration {
            let mut moved = self.state_before(next.system, lookback);
            if next.guard_value(surface, &moved) * self.from > 0.0 {
                moved.add_scaled(1.0, now);
                moved.add_scaled(-1.0, &self.before);
                return Some(next.guard_value(surface, &moved));
            }
            lookback *= 2.0;
        }
        None
    }

    /// True if the flow of `next` leads on beyond the surface that was crossed, and false if it turns back over it.
    /// The guard jumps there, so that its value does not tell: a path beside the flow, from the side before the
    /// crossing, comes beyond the surface within `longest`, or the flow comes back. `None` for a guard that does not
    /// jump, or if neither happens.
    pub(crate) fn leads_beyond<T>(
        &self,
        next: &FlowFrom<T>,
        surface: S,
        longest: f64,
    ) -> Option<bool>
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let now = next.guard_value(surface, next.start);
        let is_beyond = |state: &X| Some(self.moved_on(next, state, surface)? * now > 0.0);
        if Some(surface) != self.surface || is_beyond(next.start)? {
            return None;
        }
        // The next flight may be as short as the last one.
        let mut time = SHORTEST_LOOK * longest.min(self.duration);
        while time > 0.0 && time <= longest {
            let state = next.system.flow(next.mode, next.start, time);
            let has_returned = next.guard_value(surface, &state) * now < 0.0;
            if has_returned || is_beyond(&state)? {
                return Some(!has_returned);
            }
            time *= 2.0;
        }
        None
    }
}
