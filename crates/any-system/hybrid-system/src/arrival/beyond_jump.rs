//! Where does a reset or a flow lead, if the guard jumps at its surface, so that its value does not tell?

use super::{Arrival, LOOKBACK};
use crate::crossing::GuardedFlow;
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};

/// The shortest look at a flow behind a jump of its guard, relative to the longest one: a motion under a force of 1 moves by
/// the rounding of a state of size 1 in √(2·10⁻¹⁶). A smaller number would take more looks.
const SHORTEST_LOOK: f64 = 1.0 / 268_435_456.0;

impl<M: Copy, S: Copy + PartialEq, X: StateVector> Arrival<M, S, X> {
    /// True if the reset has moved the state beyond the crossed surface, although the guard has the same value there: it
    /// jumps at the surface.
    pub(crate) fn is_beyond_jump<T>(&self, next: &FlowFrom<T>, rounding: f64) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let Some(surface) = self.surface else { return false };
        let value = next.guard_value(surface, next.start);
        let (earlier, change) = self.earlier(next.system, surface);
        let jumps = earlier * value < 0.0 && value.abs() > rounding + change;
        jumps && self.moved_on(next, next.start, surface) * earlier <= 0.0
    }

    /// The guard a moment before the crossing, moved on as the state has moved since the crossing up to `now`: by the reset,
    /// and along the flow of `next`. Where it has not its sign before the crossing any more, this motion leads beyond
    /// the surface.
    fn moved_on<T>(&self, next: &FlowFrom<T>, now: &X, surface: S) -> f64
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let mut moved = self.state_before(next.system, LOOKBACK * self.time_rounding);
        moved.add_scaled(1.0, now);
        moved.add_scaled(-1.0, &self.before);
        next.guard_value(surface, &moved)
    }

    /// True if the flow of `next` leads beyond the surface that was crossed, although the guard jumps there and its value
    /// does not change: a path beside the flow, from the side before the crossing, comes there within `longest`.
    pub(crate) fn leads_beyond<T>(&self, next: &FlowFrom<T>, surface: S, longest: f64) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let now = next.guard_value(surface, next.start);
        if Some(surface) != self.surface || self.moved_on(next, next.start, surface) * now >= 0.0 {
            return false;
        }
        let mut time = SHORTEST_LOOK * longest;
        while time > 0.0 && time <= longest {
            let state = next.system.flow(next.mode, next.start, time);
            let has_returned = next.guard_value(surface, &state) * now < 0.0;
            if has_returned || self.moved_on(next, &state, surface) * now > 0.0 {
                return !has_returned;
            }
            time *= 2.0;
        }
        false
    }
}
