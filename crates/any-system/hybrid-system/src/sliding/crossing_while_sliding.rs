//! A sliding motion along σ reaches another surface ρ of the model.
//!
//! Behind ρ each side of σ has the mode to which the reset of that side leads. If the resets agree about the state, the
//! rates of these two modes decide how the motion goes on:
//!
//! | ġ below | ġ above | motion |
//! |---|---|---|
//! | > 0 | < 0 | slides on, between the new modes |
//! | > 0 | > 0 | leaves σ upwards |
//! | < 0 | < 0 | leaves σ downwards |
//! | < 0 | > 0 | leaves to either side: not unique |
//!
//! If the sliding field behind ρ points back at ρ, the motion stays where both surfaces meet. Filippov's convention
//! gives no unique field there. The execution recognises this as sliding along ρ between two sliding modes, and
//! ends.

use super::detection::{is_unchanged, same_surface};
use super::filippov::{Filippov, Sides};
use super::filippov_modes::FilippovMode;
use super::rates::guard_rates;
use crate::guard::{Direction, Guard, Role};
use crate::system::{HybridSystem, Reset};
use std::cell::Cell;

/// Why the motion behind a surface is not unique.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct NotUnique(pub(super) &'static str);

type Mode<T> = FilippovMode<<T as HybridSystem>::Mode, <T as HybridSystem>::Surface>;
type Continued<T> = Reset<Mode<T>, <T as HybridSystem>::State>;

/// The result of one side's reset.
enum Side<M, X> {
    /// No guard of this side is crossed.
    Unaffected,
    /// The mode and state to which the reset leads.
    Jump(M, X),
    Stop,
}

/// Mode and state after a sliding motion between `sides` has reached `other`.
pub(super) fn after_crossing<T: HybridSystem>(
    filippov: &Filippov<T>,
    (sides, partner): (&Sides<T::Mode, T::Surface>, T::Surface),
    other: T::Surface,
    state: &T::State,
) -> Result<Continued<T>, NotUnique> {
    let system = &filippov.system;
    // The direction in which the sliding motion passes through the other surface.
    let field = filippov.field_at(sides, state);
    let rate = field.map_or(0.0, |field| filippov.rate(other, state, &field));
    let admits = |guard: &Guard<T::Surface>, rate: f64| {
        guard.direction == Direction::Either || guard.direction.leads_to(rate) || rate == 0.0
    };
    let by_name = |guard: &&Guard<T::Surface>| {
        guard.surface == other && (guard.role == Role::Clock || admits(guard, rate))
    };
    let own = [sides.surface, partner];
    // The mode of the other side may have a name of its own for the same surface. Its guard is crossed as well.
    let by_place = |guard: &&Guard<T::Surface>| {
        guard.role.bounds_flow()
            && !own.contains(&guard.surface)
            && same_surface(system, other, guard.surface, state)
                .is_some_and(|scale| admits(guard, rate / scale))
    };
    let is_switch = |mode: T::Mode| {
        system.guards(mode).iter().any(|guard| guard.surface == other && guard.role.bounds_flow())
    };
    let is_place = is_switch(sides.below) || is_switch(sides.above);
    let resizes = Cell::new(false);
    let after = |mode: T::Mode| {
        let guards = system.guards(mode);
        let named = guards.iter().find(by_name);
        let placed = || guards.iter().filter(|_| is_place).find(by_place);
        match named.or_else(placed) {
            None => Side::Unaffected,
            Some(guard) => match system.reset(mode, guard.surface, state) {
                Reset::Jump { mode, state } => Side::Jump(mode, state),
                Reset::Resize { mode, state } => {
                    resizes.set(true);
                    Side::Jump(mode, state)
                }
                Reset::Stop => Side::Stop,
            },
        }
    };
    let unchanged = |after: &T::State| is_unchanged(state, after);
    let (below, above, reached) = match (after(sides.below), after(sides.above)) {
        (Side::Stop, _) | (_, Side::Stop) => return Ok(Reset::Stop),
        (Side::Unaffected, Side::Unaffected) => (sides.below, sides.above, state.clone()),
        (Side::Jump(below, reached), Side::Unaffected) if unchanged(&reached) => {
            (below, sides.above, reached)
        }
        (Side::Unaffected, Side::Jump(above, reached)) if unchanged(&reached) => {
            (sides.below, above, reached)
        }
        (Side::Jump(below, reached), Side::Jump(above, same)) if is_unchanged(&reached, &same) => {
            (below, above, reached)
        }
        _ => return Err(NotUnique("the modes on both sides reset the state differently")),
    };
    let free = |mode, state| {
        let mode = FilippovMode::Free(mode);
        Ok(if resizes.get() { Reset::Resize { mode, state } } else { Reset::Jump { mode, state } })
    };
    let sliding = |state| {
        let (surface, partner) = (sides.surface, partner);
        let mode = FilippovMode::Sliding { surface, partner, below, above };
        Ok(Reset::Jump { mode, state })
    };
    if below == above {
        return free(below, reached);
    }
    // An observer changes neither the modes nor the state.
    if (below, above) == (sides.below, sides.above) && reached == *state {
        return sliding(reached);
    }
    if let Err(off) = filippov.check_on_surface(sides.surface, &reached) {
        return free(if off.value > 0.0 { above } else { below }, reached);
    }
    // The reset may have left the surface by roundings.
    let reached = filippov.on_surface(&Sides { surface: sides.surface, below, above }, reached);
    let side = |mode| guard_rates(system, mode, sides.surface, &reached).and_then(|r| r.side());
    match (side(below), side(above)) {
        (Some(a), Some(b)) if a > 0.0 && b < 0.0 => sliding(reached),
        (Some(a), Some(b)) if a > 0.0 && b > 0.0 => free(above, reached),
        (Some(a), Some(b)) if a < 0.0 && b < 0.0 => free(below, reached),
        (Some(_), Some(_)) => Err(NotUnique("behind the surface both fields point away")),
        _ => Err(NotUnique("rounding hides the rates behind the surface")),
    }
}
