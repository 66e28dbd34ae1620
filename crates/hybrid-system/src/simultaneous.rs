//! Events at the same instant.
//!
//! Of guards that are crossed together the one listed first is the event. What its reset makes of the state decides
//! about the others: one that is still on its surface, and leaves it through to the other side, is an event at the
//! same instant; one that is turned back is not.

use crate::crossing::rounding_at;
use crate::{Arc, Direction, HybridSystem, State};

/// Ulps of its time by which events of the same instant may differ.
const ULPS: f64 = 16.0;

/// Looks, each twice as far as the one before, at how a guard leaves its surface.
const LOOKS: i32 = 40;

/// The guards, besides the one that was crossed, that were about to be crossed as an arc ended.
pub(crate) fn together<T, const N: usize>(
    system: &T,
    arc: &Arc<T::Mode, T::Surface, N>,
    crossed: T::Surface,
    end: &State<N>,
) -> Vec<T::Surface>
where
    T: HybridSystem<N>,
{
    // Allocates only if there are any.
    let others = system.guards(arc.mode).iter().filter(|guard| guard.surface != crossed);
    let about = others.filter(|guard| {
        let value = |state: &State<N>| system.guard_value(guard.surface, state);
        let (before, now) = (value(&arc.start), value(end));
        let rounding = rounding_at(end, &end.abs(), value);
        // The common case without the flow: far from its surface.
        if !(now.abs() <= 1e-6 * (before.abs() + now.abs()) + rounding) {
            return false;
        }
        let earlier = arc.duration * (1.0 - ULPS * f64::EPSILON);
        let change = (value(&system.flow(arc.mode, &arc.start, earlier)) - now).abs();
        now.abs() <= change + rounding && from_before(guard.direction, before)
    });
    about.map(|guard| guard.surface).collect()
}

/// Whether a guard with this value is on a side that a crossing may come from.
fn from_before(direction: Direction, value: f64) -> bool {
    direction.admits(value, -value)
}

/// The first of `pending` surfaces, in the order of the guards of `mode`, that the state is still on and that
/// it leaves through to the other side.
pub(crate) fn next_of<T, const N: usize>(
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
    let mut through = guards.filter(|guard| {
        let value = |state: &State<N>| system.guard_value(guard.surface, state);
        let now = value(state);
        let rounding = ULPS * rounding_at(state, &state.abs(), value);
        if now.abs() > rounding {
            return guard.direction.leads_to(now);
        }
        let longest = horizon.min(1.0);
        (0..LOOKS)
            .rev()
            .map(|halvings| value(&system.flow(mode, state, longest * 0.5f64.powi(halvings))))
            .find(|later| later.abs() > 4.0 * rounding || !later.is_finite())
            .is_some_and(|later| guard.direction.leads_to(later))
    });
    through.next().map(|guard| guard.surface)
}
