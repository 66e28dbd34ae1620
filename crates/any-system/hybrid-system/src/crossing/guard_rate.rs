//! The rate of a guard along a vector field.

use crate::state::StateVector;

/// The state is moved along the field by this distance, relative to its components, to compute the rate of a guard.
/// The distance is about √ε, as for finite differences: the rounding of the difference is 1e-8 of it, and so is the
/// effect of the guard's second derivative.
const DIFFERENCE_REACH: f64 = 1e-8;

/// A guard has a visible rate if its change over both sides exceeds this multiple of its bend. Where the bend is as
/// large as the change, the guard may fall on one side and rise on the other, and the difference has no meaning.
const STRAIGHT: f64 = 1.0;

/// ġ = ∇g·f at `state` by a central difference along the field f.
///
/// Returns `None` if the change of the guard is hidden by `rounding`, its error at one state, or by its bend; also if a
/// value is not finite, or the field is zero.
pub(crate) fn guard_rate<X: StateVector>(
    state: &X,
    field: &X,
    rounding: f64,
    guard: &dyn Fn(&X) -> f64,
) -> Option<f64> {
    // The shortest reach first: on a longer one a component that is large, and moves slowly, would carry the others
    // far.
    let by_component = state.components().iter().zip(field.components());
    let shortest = by_component
        .map(|(component, rate)| (1.0 + component.abs()) / rate.abs())
        .fold(f64::INFINITY, f64::min);
    let longest = (1.0 + state.largest()) / field.largest();
    [shortest, longest]
        .into_iter()
        .find_map(|reach| rate_over(state, field, DIFFERENCE_REACH * reach, rounding, guard))
}

/// The same by a difference over this time on both sides.
fn rate_over<X: StateVector>(
    state: &X,
    field: &X,
    reach: f64,
    rounding: f64,
    guard: &dyn Fn(&X) -> f64,
) -> Option<f64> {
    let at = |distance: f64| {
        let mut moved = state.clone();
        moved.add_scaled(distance, field);
        guard(&moved)
    };
    let (ahead, behind, value) = (at(reach), at(-reach), guard(state));
    let (change, bend) = (ahead - behind, ahead + behind - 2.0 * value);
    // The conditions are false for NaN.
    let visible = change.abs() > 2.0 * rounding && change.abs() > STRAIGHT * bend.abs();
    (visible && reach.is_finite()).then(|| change / (2.0 * reach))
}
