//! Does an execution reach a surface at which the fields on both sides point?
//!
//! An event on the surface σ leads from mode m to m⁺. There an event follows at once, on the same surface. The
//! execution slides if
//!
//! * the two resets lead back and forth between m and m⁺ and leave the state where it is,
//! * the state is on the surface, and
//! * the guard of m rises through σ and that of m⁺ falls through it, or the other way round, by the signs of their
//!   rates.
//!
//! The decision needs these signs, not a number of bounces. A rate of zero is decided by the second derivative: a field
//! that is tangent to the surface and bends back to it points at it, too. If rounding hides both, or if the model gives
//! no rates, there is no decision, and the execution ends with [`Error::TimelessChain`](crate::Error::TimelessChain).

use super::rates::guard_rates;
use super::sliding_field::sliding_field;
use super::sliding_point::Sliding;
use crate::crossing::stated_or_measured;
use crate::guard::Direction;
use crate::state::StateVector;
use crate::system::{HybridSystem, Reset};

/// A reset leaves the state where it is if no component changes by more than this many ulps of its size. A larger
/// number would take small impacts for roundings; a smaller one would miss resets that compute the state again.
const UNCHANGED_ULPS: f64 = 16.0;

/// A state is on a surface if the guard is within this multiple of its rounding error. A reset may add some
/// roundings to those of the guard. A larger number would take a state beside the surface for one on it.
const ON_SURFACE: f64 = 16.0;

/// Two surfaces are the same at a state if the sine of the angle between their gradients is below this number. The
/// gradients are central differences, with errors of about 10⁻¹⁰. Two surfaces that touch at the state count as the
/// same: to first order the fields cannot tell them apart.
const SAME_ANGLE: f64 = 1e-6;

/// Displacement for the gradients, relative to the size of a component: ε^(1/3), which makes truncation and rounding
/// equal.
const GRADIENT_REACH: f64 = 6e-6;

/// An event at once, after another event at the same instant.
pub(crate) struct AtOnce<'a, M, S, X> {
    /// Mode, and surface of the event at once.
    pub(crate) mode: M,
    pub(crate) surface: S,
    /// The state, after the reset of the event before.
    pub(crate) state: &'a X,
    pub(crate) time: f64,
    /// Mode and surface of the event before.
    pub(crate) last: Option<(M, S)>,
    /// The state before the reset of the last crossing, if that crossing was on the surface of the event before.
    pub(crate) before: Option<&'a X>,
}

/// The sliding point, if the last event and this event at once lead to each other and the fields on both sides point at
/// the surface.
pub(crate) fn sliding_point<T: HybridSystem>(
    system: &T,
    at: &AtOnce<T::Mode, T::Surface, T::State>,
) -> Option<Sliding<T::Mode, T::Surface, T::State>> {
    let (mode, surface) = at.last?;
    let (next, back, state) = (at.mode, at.surface, at.state);
    if mode == next
        || !leads_to(system, (next, back), state, mode)
        || !leads_to(system, (mode, surface), state, next)
    {
        return None;
    }
    let scale = same_surface(system, surface, back, state)?;
    let rates = guard_rates(system, mode, surface, state)?;
    let back_rates = guard_rates(system, next, back, state)?;
    let (side, back_side) = (rates.side()?, back_rates.side()?);
    // In units of the first guard the sides are opposite. Each must be the side of an event.
    if !fires_towards(system, (mode, surface), side)
        || !fires_towards(system, (next, back), back_side)
        || side * back_side * scale >= 0.0
    {
        return None;
    }
    let (own, other) = (rates.first.value, scale * back_rates.first.value);
    if !is_on_surface(system, surface, at, if own.abs() < other.abs() { own } else { other }) {
        return None;
    }
    // Along m the guard rises: m is below the surface.
    let ((below, above), rates) =
        if side > 0.0 { ((mode, next), (own, other)) } else { ((next, mode), (other, own)) };
    let fields = system.vector_field(below, state).zip(system.vector_field(above, state));
    let field = fields.as_ref().map(|(below, above)| sliding_field((below, above), rates));
    Some(Sliding {
        surface,
        below,
        above,
        time: at.time,
        state: state.clone(),
        rates,
        fields,
        // Two tangent fields have no mean that is defined.
        field: field.filter(T::State::is_finite),
    })
}

/// True if the event of this mode and surface leads to the mode `to` and leaves the state where it is.
fn leads_to<T: HybridSystem>(
    system: &T,
    (mode, surface): (T::Mode, T::Surface),
    state: &T::State,
    to: T::Mode,
) -> bool {
    match system.reset(mode, surface, state) {
        Reset::Jump { mode, state: after } => mode == to && is_unchanged(state, &after),
        Reset::Resize { .. } | Reset::Stop => false,
    }
}

/// True if no component differs by more than roundings: of its own size, and of the largest component.
pub(crate) fn is_unchanged<X: StateVector>(before: &X, after: &X) -> bool {
    let of_state = f64::EPSILON * before.largest();
    let mut components = before.components().iter().zip(after.components());
    components.all(|(before, after)| {
        (before - after).abs() <= UNCHANGED_ULPS * f64::EPSILON * before.abs() + of_state
    })
}

/// True if `mode` has a guard of this surface that is an event for a state that passes to this side, ±1. A guard that
/// counts both ways never is an event at once.
fn fires_towards<T: HybridSystem>(
    system: &T,
    (mode, surface): (T::Mode, T::Surface),
    side: f64,
) -> bool {
    system.guards(mode).iter().any(|guard| {
        guard.surface == surface
            && guard.role.bounds_flow()
            && guard.direction != Direction::Either
            && guard.direction.leads_to(side)
    })
}

/// True if the state is on the surface: within rounding of the guard, or as close as the crossing before, or so
/// close that a motion at this rate of the guard takes less than some roundings of the time.
fn is_on_surface<T: HybridSystem>(
    system: &T,
    surface: T::Surface,
    at: &AtOnce<T::Mode, T::Surface, T::State>,
    rate: f64,
) -> bool {
    let value = |state: &T::State| system.guard_value(surface, state);
    let now = value(at.state).abs();
    // The time of a crossing has an error, so that the guard has one that is larger than its rounding.
    let crossed_there = at.before.is_some_and(|before| now <= value(before).abs());
    let in_no_time = now <= ON_SURFACE * f64::EPSILON * (rate * at.time).abs();
    crossed_there || in_no_time || now <= ON_SURFACE * rounding(system, surface, at.state)
}

/// The rounding error of a guard, from its state and from its own arithmetic.
pub(super) fn rounding<T: HybridSystem>(system: &T, surface: T::Surface, state: &T::State) -> f64 {
    let guard = |state: &T::State| system.guard_value(surface, state);
    stated_or_measured(system.guard_error(surface, state), state, &guard)
}

/// The factor c of ∇g = c ∇h for the guards g of `surface` and h of `other`, if the two are the same surface near
/// `state`: h = g/c there, within rounding, and the gradients are parallel. `None` if the surfaces differ.
pub(super) fn same_surface<T: HybridSystem>(
    system: &T,
    surface: T::Surface,
    other: T::Surface,
    state: &T::State,
) -> Option<f64> {
    if surface == other {
        return Some(1.0);
    }
    let (mut gg, mut gh, mut hh) = (0.0, 0.0, 0.0);
    for axis in 0..state.dimension() {
        let slope = |surface| {
            let mut moved = state.clone();
            let component = state.components()[axis];
            let reach = GRADIENT_REACH * (1.0 + component.abs());
            moved.components_mut()[axis] = component + reach;
            let ahead = system.guard_value(surface, &moved);
            moved.components_mut()[axis] = component - reach;
            (ahead - system.guard_value(surface, &moved)) / (2.0 * reach)
        };
        let (g, h) = (slope(surface), slope(other));
        (gg, gh, hh) = (gg + g * g, gh + g * h, hh + h * h);
    }
    let scale = gh / hh;
    // sin² of the angle = 1 − (∇g·∇h)²/(|∇g|²|∇h|²).
    let parallel = 1.0 - (gh / gg) * scale <= SAME_ANGLE * SAME_ANGLE;
    let (g, h) = (system.guard_value(surface, state), system.guard_value(other, state));
    let errors = rounding(system, surface, state) + scale.abs() * rounding(system, other, state);
    (parallel && (g - scale * h).abs() <= ON_SURFACE * errors + SAME_ANGLE * g.abs())
        .then_some(scale)
}
