//! From which side has a guard come to its zero at the end of an arc?

use super::{Arrival, LONGER, LOOKBACK, PLACES};
use crate::crossing::{GuardedFlow, as_searched, guard_rate};
use crate::guard::Guard;
use crate::state::StateVector;
use crate::system::{FlowFrom, HybridSystem};

impl<M: Copy, S: Copy + PartialEq, X: StateVector> Arrival<M, S, X> {
    /// The side from which a guard has come to its zero on the computed trajectory; `None` if it has not come
    /// there. The signs of its values decide, and no distance: a zero that is an ulp later is another event.
    ///
    /// The search has reported no event of the guard on the arc. So a guard that started on a side from which
    /// crossings count, and is now on the other one, or zero, has come to its zero at the end. One that started on
    /// its far side may have gone and come back: its values before the end tell.
    pub(super) fn side_before<T>(&self, arc: &FlowFrom<T>, guard: &Guard<S>) -> Option<f64>
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let value = |state: &X| arc.guard_value(guard.surface, state);
        let (start, now) = (value(arc.start), value(&self.before));
        let left = self.leaving.iter().find(|leaving| leaving.surface == guard.surface);
        let side = left.map_or(start.signum(), |leaving| leaving.side);
        let is_hidden = left.is_some_and(|left| left.hidden > self.duration);
        if side == 0.0 || start == 0.0 && left.is_none() || is_hidden {
            return None;
        }
        // The bounds of a guard and its value round differently: what one of them shows counts.
        let shows = |side: f64| {
            let by_time = || self.earlier(arc.system, guard.surface).1;
            let rounding = || arc.rounding_at(guard.surface, &self.before);
            let near = || now.abs() <= rounding() + by_time();
            let searched = || as_searched(arc, guard.surface, self.duration);
            now * side >= 0.0 || near() && searched() * side >= 0.0
        };
        if !guard.direction.admits(side, -side) {
            // From the far side it comes to an event after two zeros only, the second one at the end.
            let came_back = shows(side) && self.was_on_side_before(arc, guard.surface, -side);
            return came_back.then_some(-side);
        }
        if !shows(-side) {
            return None;
        }
        // It may not have come to its side yet, if the arc is short.
        let is_there = left.is_none_or(|leaving| leaving.ahead) || start * side > 0.0;
        (is_there || self.has_left(arc, guard.surface, side)).then_some(side)
    }

    /// Whether a guard was on `side` shortly before the end of the arc: the nearest one of some earlier values that
    /// is no rounding.
    fn was_on_side_before<T>(&self, arc: &FlowFrom<T>, surface: S, side: f64) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let value = |state: &X| arc.guard_value(surface, state);
        let mut lookback = LOOKBACK * self.time_rounding.max(f64::EPSILON * self.duration);
        while lookback < self.duration {
            let state = self.state_before(arc.system, lookback);
            let earlier = value(&state);
            if earlier.abs() > arc.rounding_at(surface, &state) {
                return earlier * side > 0.0;
            }
            lookback *= LONGER;
        }
        false
    }

    /// Whether a guard that started on its surface has been clearly on `side` on the arc.
    pub(super) fn has_left<T>(&self, arc: &FlowFrom<T>, surface: S, side: f64) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        PLACES.iter().any(|part| {
            let state = arc.state(part * self.duration);
            side * arc.guard_value(surface, &state) > arc.rounding_at(surface, &state)
        })
    }

    /// The side from which a guard has come to its zero, if the model has solved for the crossing. Two surfaces that
    /// are reached together by its formulas have signs of rounding.
    pub(super) fn side_by_rounding<T>(&self, arc: &FlowFrom<T>, surface: S) -> Option<f64>
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let value = |state: &X| arc.guard_value(surface, state);
        let now = value(&self.before);
        let rounding = arc.rounding_at(surface, &self.before);
        let (earlier, change) = self.earlier(arc.system, surface);
        // It has another sign a moment earlier, or in the middle of the arc, and no event since.
        let jumped = earlier * now < 0.0
            || value(arc.start) * now < 0.0 && value(&arc.state(0.5 * self.duration)) * now < 0.0;
        if !(jumped || now.abs() <= change + rounding) {
            return None;
        }
        let has_come = match self.leaving.iter().find(|leaving| leaving.surface == surface) {
            // It was on its way, however near.
            Some(left) if left.ahead => return Some(left.side),
            // It has had its event, and may still be between its zero and its side.
            Some(left) if left.side != 0.0 => self.has_left(arc, surface, left.side),
            _ => !self.has_stayed(arc, surface),
        };
        if !has_come {
            return None;
        }
        // The side from which the guard comes: by its rate, or by its value at the start of the arc.
        let field = arc.vector_field(&self.before);
        let rate = field.and_then(|field| guard_rate(&self.before, &field, rounding, &value));
        Some(match rate {
            _ if jumped => -now,
            Some(rate) => -rate,
            None => value(arc.start),
        })
    }

    /// True if a guard was on its surface at the start of the arc, and has not left it up to the end, as far as
    /// rounding shows: the arc was too short. Its event has been before this arc, or is still to come.
    pub(super) fn has_stayed<T>(&self, arc: &FlowFrom<T>, surface: S) -> bool
    where
        T: HybridSystem<State = X, Surface = S, Mode = M>,
    {
        let is_zero =
            |state: &X| arc.guard_value(surface, state).abs() <= arc.rounding_at(surface, state);
        is_zero(arc.start) && PLACES.iter().all(|part| is_zero(&arc.state(part * self.duration)))
    }
}
