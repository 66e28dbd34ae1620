//! The part of a guard's value that may be rounding.
//!
//! The computed value ĝ(x) of a guard is wrong for two reasons: the state x is rounded, and so is every operation
//! of the guard. The first error is the change of ĝ when the components change by an ulp or two. The second error
//! is the scatter of ĝ around a smooth function: along a line through x the third differences of a smooth function
//! at distances δ are of order δ³, far below an ulp, so that they contain only rounding.
//!
//! ```text
//!   hypot(x − 2, y) − d,  x ≈ 10⁻³:    an ulp of x changes ĝ by 2·10⁻¹⁹, but x − 2 alone is rounded to 2·10⁻¹⁶
//! ```
//!
//! A model can state the second error instead: `HybridSystem::guard_error`.

use crate::state::StateVector;

/// The change of each component, in units of ε times its size. A component that was computed is wrong by an ulp or
/// two. A smaller number would take rounding for a distance from the surface; a larger one would take small
/// distances for zero.
const COMPONENT_ULPS: f64 = 2.0;

/// The second distance, in units of the first: a power of two, so that the difference of both is exact for a
/// straight guard. A larger number would take a bend of the guard for rounding.
const FARTHER: f64 = 8.0;

/// Factor on the sum of the changes, for the interplay of the components. It is an estimate, not a bound.
const ROOM: f64 = 2.0;

/// With at most this many components each of them is moved by itself, and the changes are added. With more, the guard
/// would be evaluated too often: all components are moved together, with different signs.
const SINGLE_COMPONENTS: usize = 8;

/// Number of moves of all components together with signs at random. Four changes show the size of a random sum within a
/// factor of about two.
const RANDOM_MOVES: u32 = 4;

/// Distances between the states at which the scatter is measured, relative to each component: 256 ulps, then 2²² ulps.
/// The first shows the rounding of terms up to about 100 times the components; it does not reach over an oscillation,
/// even in a guard sin(1000 t) at t = 10⁸. The second is used only where the first does not change the value at all.
const COMPONENT_DISTANCES: [f64; 2] = [256.0 * f64::EPSILON, 4_194_304.0 * f64::EPSILON];

/// The distance if neither of these changes the value: 4096 ulps, relative to the value of the guard, then to its
/// square root beside the largest component, then to the largest component. It shows the rounding in a guard whose
/// own terms are much larger than the components that it uses. The shortest distance that changes the value is
/// taken, so that a large component does not hide a guard on another one.
const LARGEST_DISTANCE: f64 = 4096.0 * f64::EPSILON;

/// The scatter in units of the largest third difference. A third difference of errors up to e is 2.6 e in the mean; one
/// of two is often less than half of that. With this factor the scatter is 1 to 8 times the error.
const SCATTER: f64 = 2.0;

/// If the estimate on one side of the state is so many times larger than on the other side, the guard jumps or
/// bends there, which says nothing about its rounding. Estimates of the same rounding differ by less, in all but
/// one case of some hundreds. A larger number would take more jumps for rounding.
const ONE_SIDED: f64 = 16.0;

/// A guard is clearly off its surface if moving the components by about [`FAR_MOVE`] of the largest one changes the
/// guard by at most this many times its value. The rounding would have to be 10⁷ times larger than usual to matter.
const FAR: f64 = 1e3;

/// See [`FAR`]: about 10⁻³, a power of two.
const FAR_MOVE: f64 = 1.0 / 1024.0;

/// An estimate of the rounding error of `guard` at `state`: [`rounding_of_state`] and the rounding of the guard's own
/// operations, which is measured.
///
/// A guard whose value is smaller than this may be zero. Terms of the guard that are 10⁵ times larger than the
/// components are not seen.
///
/// Returns 0 if the guard is not finite near `state`: then there is no estimate, and only an exact zero counts as
/// zero.
pub(crate) fn guard_rounding<X: StateVector>(
    state: &X,
    size: &X,
    guard: &dyn Fn(&X) -> f64,
) -> f64 {
    let upwards = scatter(state, 1.0, guard);
    let ahead = rounding_of_state(state, size, guard) + upwards;
    if ahead < guard(state).abs() {
        return ahead;
    }
    let own = smaller(ahead, scatter(state, -1.0, guard));
    let sum = rounding_beside_jumps(state, size, guard) + own.min(upwards);
    if sum.is_finite() { sum } else { 0.0 }
}

/// An estimate that would hide the guard's value, or another one of the same, measured on the other side, that is much
/// smaller: then a jump or a kink of the guard next to the state was measured.
fn smaller(here: f64, there: f64) -> f64 {
    if ONE_SIDED * there < here { there } else { here }
}

/// The rounding of the state, each component moved to the side on which the guard does not jump.
fn rounding_beside_jumps<X: StateVector>(state: &X, size: &X, guard: &dyn Fn(&X) -> f64) -> f64 {
    if state.dimension() > SINGLE_COMPONENTS {
        let [up, down] = [1.0, -1.0].map(|side| rounding_on_side(state, (size, side), guard));
        return smaller(up, down);
    }
    let value = guard(state);
    let mut moved = state.clone();
    let mut sum = 0.0;
    for axis in 0..state.dimension() {
        let component = state.components()[axis];
        let reach = COMPONENT_ULPS * f64::EPSILON * size.components()[axis].abs();
        let [up, down] = [1.0, -1.0].map(|side| {
            let mut change = |distance: f64| {
                moved.components_mut()[axis] = component + side * distance;
                (guard(&moved) - value).abs()
            };
            (change(FARTHER * reach) - change(reach)).abs()
        });
        moved.components_mut()[axis] = component;
        sum += if ONE_SIDED * up < down { up } else { smaller(up, down) };
    }
    ROOM * sum / (FARTHER - 1.0)
}

/// The same, with the error of the guard's own operations as the model has `stated` it, if it has.
pub(crate) fn stated_or_measured<X: StateVector>(
    stated: Option<f64>,
    state: &X,
    guard: &dyn Fn(&X) -> f64,
) -> f64 {
    match stated {
        Some(stated) => {
            let ahead = rounding_of_state(state, state, guard);
            match ahead + stated < guard(state).abs() {
                true => ahead + stated,
                false => rounding_beside_jumps(state, state, guard) + stated,
            }
        }
        None => guard_rounding(state, state, guard),
    }
}

/// The rounding of the guard's own operations at a zero: as the model has `stated` it, or as it is measured before
/// and behind the zero. At the zero itself a jump of the guard would count as rounding.
pub(crate) fn rounding_beside_zero<X: StateVector>(
    stated: Option<f64>,
    beside: [&X; 2],
    guard: &dyn Fn(&X) -> f64,
) -> f64 {
    stated.unwrap_or_else(|| {
        let [before, behind] = beside.map(|state| scatter(state, 1.0, guard));
        // `min` drops NaN.
        let least = before.min(behind);
        if least.is_finite() { least } else { 0.0 }
    })
}

/// An estimate of the error of `guard` at `state` by the rounding of the state. The components of `size` are
/// |state| for a state that is given, and larger for a state that was computed from larger numbers.
pub(crate) fn rounding_of_state<X: StateVector>(
    state: &X,
    size: &X,
    guard: &dyn Fn(&X) -> f64,
) -> f64 {
    rounding_on_side(state, (size, 1.0), guard)
}

/// The larger one of the estimates on both sides: for a guard that is zero beside its jump.
#[cfg(feature = "ode")]
pub(crate) fn rounding_around<X: StateVector>(state: &X, guard: &dyn Fn(&X) -> f64) -> f64 {
    let [up, down] = [1.0, -1.0].map(|side| rounding_on_side(state, (state, side), guard));
    up.max(down)
}

/// The same with the components moved upwards or downwards, by the sign of `side`.
fn rounding_on_side<X: StateVector>(
    state: &X,
    (size, side): (&X, f64),
    guard: &dyn Fn(&X) -> f64,
) -> f64 {
    let ulps = side * COMPONENT_ULPS * f64::EPSILON;
    let reach = |axis: usize| ulps * size.components()[axis].abs();
    let near = change_by_components(state, reach, guard);
    let far = change_by_components(state, |axis| FARTHER * reach(axis), guard);
    // The change of a smooth guard grows with the reach, and that of a jump does not: its height is no error.
    let sum = ROOM * (far - near).abs() / (FARTHER - 1.0);
    if sum.is_finite() { sum } else { 0.0 }
}

/// The side of the surface on which `state` lies, ±1; `None` if the guard is zero within rounding, or not a number.
/// `stated` is the error of the guard's own operations, if the model states it.
///
/// A guard that is far from its surface, which is the usual case, is evaluated twice.
#[cfg(feature = "ode")]
pub(crate) fn side_of_surface<X: StateVector>(
    state: &X,
    stated: Option<f64>,
    guard: impl Fn(&X) -> f64,
) -> Option<f64> {
    let value = guard(state);
    if value == 0.0 || value.is_nan() {
        return None;
    }
    let far = stated.is_none_or(|stated| stated < value.abs())
        && is_far(state, state.largest(), value, &guard);
    let rounding = || stated_or_measured(stated, state, &guard);
    (far || value.abs() > rounding()).then(|| value.signum())
}

/// True if the guard, whose value at `state` is `value`, is clearly off its surface. This test takes one evaluation.
///
/// `size` is the size of the state, or a larger one if the state has an error that is small on another scale only.
///
/// Each component is moved by its own distance. A gap between two components does not change if both move by the same.
pub(crate) fn is_far<X: StateVector>(
    state: &X,
    size: f64,
    value: f64,
    guard: impl Fn(&X) -> f64,
) -> bool {
    value != 0.0 && FAR_MOVE * range(state, size, value, guard) <= FAR * value.abs()
}

/// The size of the values of a guard among states of this size, by its change over a small part of that.
pub(crate) fn range<X: StateVector>(
    state: &X,
    size: f64,
    value: f64,
    guard: impl Fn(&X) -> f64,
) -> f64 {
    let reach = FAR_MOVE * size;
    let moved = state.filled(|axis| state.components()[axis] + reach * spread(axis));
    (guard(&moved) - value).abs() / FAR_MOVE
}

/// A number from ½ to 3/2, different for each component: ½ and the fractional part of axis/golden ratio.
pub(crate) fn spread(axis: usize) -> f64 {
    /// 2³² divided by the golden ratio.
    const MULTIPLIER: u32 = 0x9e37_79b9;
    let fraction = (axis as u32).wrapping_mul(MULTIPLIER);
    0.5 + f64::from(fraction) / 4_294_967_296.0
}

/// The change of `guard` when component i changes by reach(i): the sum of all changes, or an estimate if there are many
/// components.
pub(crate) fn change_by_components<X: StateVector>(
    state: &X,
    reach: impl Fn(usize) -> f64,
    guard: &dyn Fn(&X) -> f64,
) -> f64 {
    let value = guard(state);
    let mut moved = state.clone();
    if state.dimension() <= SINGLE_COMPONENTS {
        let mut sum = 0.0;
        for axis in 0..state.dimension() {
            let component = state.components()[axis];
            moved.components_mut()[axis] = component + reach(axis);
            sum += (guard(&moved) - value).abs();
            moved.components_mut()[axis] = component;
        }
        return sum;
    }
    // Two components have the same sign in the first move, and opposite signs in one of those by the bits of their
    // numbers. So a guard of one or two components, such as a gap, shows its whole change.
    let bits = usize::BITS - (state.dimension() - 1).leading_zeros();
    let mut largest: f64 = 0.0;
    for joint in 0..=bits + RANDOM_MOVES {
        let sign = |axis: usize| match joint.checked_sub(bits + 1) {
            Some(random) => random_sign(axis, random),
            None if joint < bits && axis >> joint & 1 == 1 => -1.0,
            None => 1.0,
        };
        for (axis, component) in state.components().iter().enumerate() {
            moved.components_mut()[axis] = component + sign(axis) * reach(axis);
        }
        largest = largest.max((guard(&moved) - value).abs());
    }
    // The largest of four sums at random is about the root of the sum of squares.
    ROOM * largest
}

/// ±1, different for each component and move: a bit of a product with an odd number (a multiplicative hash).
fn random_sign(axis: usize, joint: u32) -> f64 {
    /// 2⁶⁴ divided by the golden ratio, odd.
    const MULTIPLIER: u64 = 0x9e37_79b9_7f4a_7c15;
    let mixed = (axis as u64)
        .wrapping_mul(u64::from(RANDOM_MOVES))
        .wrapping_add(u64::from(joint) + 1)
        .wrapping_mul(MULTIPLIER);
    if (mixed ^ (mixed >> 32)).wrapping_mul(MULTIPLIER) >> 63 == 0 { 1.0 } else { -1.0 }
}

/// The scatter of the guard's values around a smooth function, at five states on a line from `state`, upwards or
/// downwards by the sign of `side`.
fn scatter<X: StateVector>(state: &X, side: f64, guard: &dyn Fn(&X) -> f64) -> f64 {
    let (value, largest) = (guard(state).abs(), state.largest());
    let by_component = COMPONENT_DISTANCES.map(|distance| (distance, 0.0));
    let by_size = [value.min(largest), (value * largest).sqrt().min(largest), largest]
        .map(|size| (0.0, LARGEST_DISTANCE * size));
    for (relative, absolute) in by_component.into_iter().chain(by_size) {
        let values: [f64; 5] = std::array::from_fn(|k| {
            let along = |axis: usize| {
                let component = state.components()[axis];
                component + side * k as f64 * (relative * component.abs() + absolute)
            };
            guard(&state.filled(along))
        });
        if values.iter().any(|value| *value != values[0]) {
            let third =
                |k: usize| values[k + 3] - 3.0 * (values[k + 2] - values[k + 1]) - values[k];
            return SCATTER * third(0).abs().max(third(1).abs());
        }
    }
    // The guard does not depend on the state here.
    0.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DVector;

    /// A joint move with the same signs on both components would show no change of the gap between them.
    #[test]
    fn every_gap_between_two_of_many_components_shows_its_rounding() {
        for dimension in [9, 10, 64, 65, 100] {
            let state = DVector::from_element(dimension, 1.0);
            for i in 0..dimension {
                for j in 0..i {
                    let gap = rounding_of_state(&state, &state, &|x| x[i] - x[j]);
                    // Two components of size 1, COMPONENT_ULPS each, twice ROOM.
                    assert_eq!(gap, 16.0 * f64::EPSILON, "{i} {j} of {dimension}");
                    let sum = rounding_of_state(&state, &state, &|x| x[i] + x[j] - 2.0);
                    assert_eq!(sum, 16.0 * f64::EPSILON, "{i} {j} of {dimension}");
                }
            }
        }
    }

    #[test]
    fn a_gap_of_rounding_is_not_far() {
        for dimension in [2, 10, 1000] {
            let mut state = DVector::from_element(dimension, 1.0);
            state[dimension - 1] += 8.0 * f64::EPSILON;
            for i in 0..dimension - 1 {
                let gap = |x: &DVector<f64>| x[dimension - 1] - x[i];
                assert!(!is_far(&state, 1.0, gap(&state), gap), "{i} of {dimension}");
            }
            state[dimension - 1] = 2.0;
            let gap = |x: &DVector<f64>| x[dimension - 1] - x[0];
            assert!(is_far(&state, 2.0, gap(&state), gap));
        }
    }
}
