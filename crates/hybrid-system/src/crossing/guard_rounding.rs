//! The part of a guard's value that may be the rounding error of the state.

use crate::state::State;

/// An estimate of the rounding error of `guard` at `state`: how much the guard changes if each component changes by
/// two ulps of the same component of `size`, added over the components and doubled.
///
/// A guard whose value is smaller than this may be zero. `size` is |state| for a state that is given, and larger for a
/// state that was computed from larger numbers. The factors of two leave room for the roundings inside the guard.
///
/// Returns 0 if the guard is not finite near `state`: then there is no estimate, and only an exact zero counts as
/// zero.
pub(crate) fn guard_rounding<const N: usize>(
    state: &State<N>,
    size: &State<N>,
    guard: impl Fn(&State<N>) -> f64,
) -> f64 {
    let value = guard(state);
    let change = |axis: usize| {
        let mut moved = *state;
        moved[axis] += 2.0 * f64::EPSILON * size[axis];
        (guard(&moved) - value).abs()
    };
    let sum: f64 = (0..N).map(change).sum();
    if sum.is_finite() { 2.0 * sum } else { 0.0 }
}
