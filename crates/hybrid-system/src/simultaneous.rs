//! Events at the same instant.
//!
//! Of guards that are crossed together, the one listed first is the event. The state after its reset decides about the
//! others. A guard that is still at its surface, and passes through it to the other side, is an event at the same
//! instant. A guard whose direction the reset reversed is no event. This is statement (9) of
//! [mathematics](crate::mathematics).

use crate::arc::Arc;
use crate::crossing::guard_rounding;
use crate::guard::Direction;
use crate::state::State;
use crate::system::HybridSystem;

/// Two events are at the same instant if their times differ by this many ulps at most. A crossing is moved up to some
/// ulps past its root, and each guard has its own rounding. A larger number would join events that are distinct. With a
/// smaller number an event could be lost, because the next arc would start beyond its surface.
const SAME_INSTANT_ULPS: f64 = 16.0;

/// Largest value of a guard at the end of an arc, relative to its values at both ends, for which the flow is
/// evaluated once more. Within 16 ulps of the duration a guard moves that far only if its slope there is 10⁸ times
/// its mean slope.
const NEAR_SURFACE: f64 = 1e-6;

/// Number of times after a reset at which a guard is evaluated, to find the side to which it goes: LONGEST_LOOK · 2⁻³⁹,
/// 2⁻³⁸, … 1. The shortest, 2·10⁻¹², is near the rounding of a guard that moves at a rate of 1.
const LOOKS: i32 = 40;

/// The longest of these times, unless the limit on time comes earlier: one unit of time, because the scale of the model
/// is not known.
const LONGEST_LOOK: f64 = 1.0;

/// A guard has left its surface when its value is this many times its rounding error.
const LEFT_SURFACE: f64 = 4.0;

/// The other guards, besides the one that was `crossed`, that are at their surfaces at the end of an arc and come
/// from the side from which a crossing counts.
pub(crate) fn also_at_surface<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, N>,
    crossed: T::Surface,
    end: &State<N>,
) -> Vec<T::Surface>
where
    T: HybridSystem<N>,
{
    let others = system.guards(arc.mode).iter().filter(|guard| guard.surface != crossed);
    let at_surface = others.filter(|guard| {
        let value = |state: &State<N>| system.guard_value(guard.surface, state);
        let (before, now) = (value(&arc.start), value(end));
        let rounding = guard_rounding(end, &end.abs(), value);
        // The usual case, a guard far from its surface, needs no evaluation of the flow.
        if !(now.abs() <= NEAR_SURFACE * (before.abs() + now.abs()) + rounding) {
            return false;
        }
        let earlier = arc.duration * (1.0 - SAME_INSTANT_ULPS * f64::EPSILON);
        let change = (value(&system.flow(arc.mode, &arc.start, earlier)) - now).abs();
        now.abs() <= change + rounding && may_cross_from(guard.direction, before)
    });
    // An empty list needs no allocation.
    at_surface.map(|guard| guard.surface).collect()
}

/// True if a guard with this value is on a side from which a crossing counts.
fn may_cross_from(direction: Direction, value: f64) -> bool {
    direction.admits(value, -value)
}

/// The next event at the same instant: the first of the `pending` surfaces, in the order of the guards of `mode`, on
/// which the state still is and through which it passes; `None` if there is none.
pub(crate) fn next_at_same_instant<T, const N: usize>(
    system: &T,
    mode: T::Mode,
    state: &State<N>,
    pending: &[T::Surface],
    horizon: f64,
) -> Option<T::Surface>
where
    T: HybridSystem<N>,
{
    let guards = system.guards(mode).iter().filter(|guard| pending.contains(&guard.surface));
    let mut going_through = guards.filter(|guard| {
        let value = |state: &State<N>| system.guard_value(guard.surface, state);
        let now = value(state);
        let rounding = SAME_INSTANT_ULPS * guard_rounding(state, &state.abs(), value);
        // The reset, or the step past the root, has already moved the state off this surface.
        if now.abs() > rounding {
            return guard.direction.leads_to(now);
        }
        let longest = horizon.min(LONGEST_LOOK);
        (0..LOOKS)
            .rev()
            .map(|halvings| value(&system.flow(mode, state, longest * 0.5f64.powi(halvings))))
            .find(|later| later.abs() > LEFT_SURFACE * rounding || !later.is_finite())
            .is_some_and(|later| guard.direction.leads_to(later))
    });
    going_through.next().map(|guard| guard.surface)
}
