//! The part of a guard's value that may be the rounding error of the state.

use crate::state::StateVector;

/// The change of each component, in units of ε times its size. A component that was computed is wrong by an ulp or two. A
/// smaller number would take rounding for a distance from the surface; a larger one would take small distances for
/// zero.
const COMPONENT_ULPS: f64 = 2.0;

/// Factor on the sum of the changes, for the roundings inside the guard. It is an estimate, not a bound: the operations
/// of the guard are not known here.
const ROOM: f64 = 2.0;

/// An estimate of the rounding error of `guard` at `state`: how much the guard changes if each component changes by
/// [`COMPONENT_ULPS`] of the same component of `size`, added over the components, times [`ROOM`].
///
/// A guard whose value is smaller than this may be zero. `size` is |state| for a state that is given, and larger for a
/// state that was computed from larger numbers.
///
/// Returns 0 if the guard is not finite near `state`: then there is no estimate, and only an exact zero counts as
/// zero.
pub(crate) fn guard_rounding<X: StateVector>(
    state: &X,
    size: &X,
    guard: impl Fn(&X) -> f64,
) -> f64 {
    let value = guard(state);
    let mut moved = state.clone();
    let mut sum = 0.0;
    for axis in 0..state.dimension() {
        let component = state.components()[axis];
        let reach = COMPONENT_ULPS * f64::EPSILON * size.components()[axis].abs();
        moved.components_mut()[axis] = component + reach;
        sum += (guard(&moved) - value).abs();
        moved.components_mut()[axis] = component;
    }
    if sum.is_finite() { ROOM * sum } else { 0.0 }
}
