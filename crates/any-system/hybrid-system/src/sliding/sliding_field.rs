//! Filippov's sliding field.
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
    from.filled(|axis| {
        let (from, to) = (from.components()[axis], to.components()[axis]);
        from + part * (to - from)
    })
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
}
