//! Filippov's sliding field, and the way back onto the surface.
//!
//! Below the surface, where g < 0, the field is f⁻; above it is f⁺. Write a = ∇g·f⁻ and b = ∇g·f⁺ for the rates of g.
//! Sliding is attracting where a > 0 > b. The mean f⁻ + λ(f⁺ − f⁻) is tangent to the surface if
//!
//! ```text
//!   a + λ(b − a) = 0     λ = a/(a − b)     f_s = (a f⁺ − b f⁻)/(a − b)
//! ```
//!
//! λ is the part of the time that a relay with a narrow hysteresis spends above. At a = 0 the sliding field is f⁻, at
//! b = 0 it is f⁺: a motion that leaves the surface there has no kink.

use crate::state::StateVector;

/// f_s from the fields (f⁻, f⁺) and the rates (a, b). NaN if a = b.
pub(crate) fn sliding_field<X: StateVector>(fields: (&X, &X), rates: (f64, f64)) -> X {
    let ((below, above), (a, b)) = (fields, rates);
    let (lambda, rest) = (a / (a - b), -b / (a - b));
    // From the field with the larger weight. A component that is equal in both fields keeps its bits.
    let (from, to, part) =
        if lambda <= 0.5 { (below, above, lambda) } else { (above, below, rest) };
    from.from_fn_like(|axis| {
        let (from, to) = (from.components()[axis], to.components()[axis]);
        from + part * (to - from)
    })
}

/// Most steps onto the surface. The first step leaves the square of the distance, times the curvature of the surface. So
/// two steps are usual, and the number only limits a search that does not converge.
const MOST_CORRECTIONS: usize = 8;

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
    use nalgebra::{Vector2, Vector3};

    #[test]
    fn the_sliding_field_is_tangent_and_between_both_fields() {
        let gradient = Vector3::new(1.0, -2.0, 0.5);
        let below = Vector3::new(3.0, 0.25, 1.0);
        let above = Vector3::new(-1.0, 2.0, 1.0);
        let (a, b) = (gradient.dot(&below), gradient.dot(&above));
        assert!(a > 0.0 && b < 0.0);
        let field = sliding_field((&below, &above), (a, b));
        assert!(gradient.dot(&field).abs() < 1e-15);
        assert_eq!(field[2], 1.0);
        // The contract of both notations: f_s = (b f⁻ − a f⁺)/(b − a).
        let other = (below * b - above * a) / (b - a);
        assert!((field - other).amax() < 1e-15);
    }

    #[test]
    fn where_one_field_is_tangent_it_is_the_sliding_field() {
        let (below, above) = (Vector2::new(0.0, 0.7), Vector2::new(-1.0, 0.3));
        assert_eq!(sliding_field((&below, &above), (0.0, -1.0)), below);
        let (below, above) = (Vector2::new(2.0, 0.7), Vector2::new(0.0, 0.3));
        assert_eq!(sliding_field((&below, &above), (2.0, 0.0)), above);
    }

    #[test]
    fn two_equal_rates_give_no_field() {
        let field = Vector2::new(1.0, 1.0);
        assert!(sliding_field((&field, &field), (1.0, 1.0))[0].is_nan());
    }

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
