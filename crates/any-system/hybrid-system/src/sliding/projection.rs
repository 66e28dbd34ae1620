//! The way of a state back onto the surface along which it slides.

use crate::state::StateVector;

/// Most steps onto the surface. A step leaves rounding, relative to the distance: on a surface like {x : x₁ = 0}
/// the component shrinks by a factor of 10⁻¹⁶ in each step, and is exactly 0 after 20 of them. Elsewhere the steps
/// end earlier, at the rounding of the guard. The number only limits a search that converges slowly.
const MOST_CORRECTIONS: usize = 40;

/// The point of the surface next to `state` along f⁺ − f⁻.
///
/// ∇g·(f⁺ − f⁻) = b − a < 0: this direction is transverse to the surface wherever it attracts. Newton's steps with
/// this rate end where the value of the guard does not become smaller: at zero, within the rounding of the guard.
pub(crate) fn onto_surface<X: StateVector>(
    state: X,
    fields: (&X, &X),
    rates: (f64, f64),
    guard: impl Fn(&X) -> f64,
) -> X {
    let ((below, above), (a, b)) = (fields, rates);
    let mut best = state;
    let mut value = guard(&best);
    for _ in 0..MOST_CORRECTIONS {
        let length = -value / (b - a);
        let mut moved = best.clone();
        moved.add_scaled(length, above);
        moved.add_scaled(-length, below);
        let left = guard(&moved);
        // The condition is false for NaN as well.
        if !(left.abs() < value.abs()) {
            break;
        }
        (best, value) = (moved, left);
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    #[test]
    fn a_state_next_to_a_circle_is_put_on_it() {
        let circle = |x: &Vector2<f64>| x.dot(x) - 1.0;
        let state = Vector2::new(0.6 + 1e-5, 0.8 - 3e-5);
        let (below, above) = (Vector2::new(1.0, 2.0), Vector2::new(-1.0, -0.5));
        let rates = (2.0 * state.dot(&below), 2.0 * state.dot(&above));
        let on = onto_surface(state, (&below, &above), rates, circle);
        let value = circle(&on);
        assert!(value.abs() <= 2.0 * f64::EPSILON, "{value}");
        assert!((on - state).norm() < 1e-4);
        // The displacement is along f⁺ − f⁻.
        let (moved, along) = (on - state, above - below);
        assert!((moved[0] * along[1] - moved[1] * along[0]).abs() < 1e-15);
    }

    #[test]
    fn a_state_on_the_surface_keeps_its_bits() {
        let state = Vector2::new(0.0, 0.123);
        let (below, above) = (Vector2::new(1.0, 1.0), Vector2::new(-1.0, 1.0));
        assert_eq!(onto_surface(state, (&below, &above), (1.0, -1.0), |x| x[0]), state);
    }
}
