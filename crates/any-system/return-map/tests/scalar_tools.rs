//! Scalar maps with planted fixed points of known stability.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use proptest::prelude::*;
use return_map::{Error, Intersection, Side, Stability, fixed_points, one_sided_stability};
use std::cell::Cell;

proptest! {
    /// The map x + s (x − a)(x − b)² has a transverse fixed point a and a tangent one b.
    #[test]
    fn transverse_and_tangent_points_are_distinguished(a in -0.9..-0.1f64, b in 0.1..0.9f64, s in 0.2..1.5f64, up: bool) {
        let sign = if up { s } else { -s };
        let map = move |x: f64| Some(x + sign * (x - a) * (x - b) * (x - b));
        let found = fixed_points(map, -1.0, 1.0, 201).unwrap();
        prop_assert_eq!(found.len(), 2, "{:?}", found);
        prop_assert_eq!((found[0].intersection, found[1].intersection), (Intersection::Transverse, Intersection::Tangent));
        prop_assert!((found[0].location - a).abs() < 1e-13);
        // Within the square root of an ulp of a quadratic extremum all values are equal to rounding.
        prop_assert!((found[1].location - b).abs() < 1e-6);
    }

    #[test]
    fn linear_maps_attract_or_repel(slope in 0.0..3f64) {
        prop_assume!((slope - 1.0).abs() > 1e-6);
        let probed = one_sided_stability(|d| Some(slope * d), Side::Right, 1.0, 12);
        let expected = if slope < 1.0 { Stability::Attracting } else { Stability::Repelling };
        prop_assert_eq!(probed.stability, expected);
        let (exponent, coefficient) = probed.power_law().unwrap();
        prop_assert!((exponent - 1.0).abs() < 1e-6 && (coefficient - (1.0 - slope).abs()).abs() < 1e-5);
    }
}

#[test]
fn a_jump_through_the_diagonal_is_not_a_fixed_point() {
    let jump = |x: f64| Some(if x < 0.3 { x + 1.0 } else { x - 1.0 });
    assert_eq!(fixed_points(jump, 0.0, 1.0, 101).unwrap(), []);
}

#[test]
fn a_change_of_sides_is_undecided() {
    let probed = one_sided_stability(|d| Some(-0.5 * d), Side::Left, 1.0, 5);
    assert_eq!(probed.stability, Stability::Undecided);
    assert_eq!(probed.power_law(), None);
}

#[test]
fn bad_windows_are_errors() {
    for (left, right, samples) in [
        (1.0, 0.0, 10),
        (0.0, 1.0, 2),
        (0.0, f64::NAN, 10),
        (0.0, f64::INFINITY, 10),
        (0.0, 1.0, usize::MAX),
    ] {
        assert!(matches!(fixed_points(Some, left, right, samples), Err(Error::BadWindow { .. })));
    }
}

/// Some windows end where left + (right − left) rounds to a number above `right`.
#[test]
fn no_sample_lies_outside_the_window() {
    for k in 1..2000 {
        let (left, right) = (-0.001 * f64::from(k), 0.1 / f64::from(k));
        for samples in [3, 7, 50] {
            let ends = Cell::new((f64::INFINITY, f64::NEG_INFINITY));
            let map = |x: f64| {
                ends.set((ends.get().0.min(x), ends.get().1.max(x)));
                Some(x * x - 0.3 * x)
            };
            fixed_points(map, left, right, samples).unwrap();
            assert_eq!(ends.get(), (left, right));
        }
    }
    // The case itself: without care the last sample is above the right end.
    let beyond = (1..2000).any(|k| {
        let (left, right) = (-0.001 * f64::from(k), 0.1 / f64::from(k));
        left + (right - left) > right
    });
    assert!(beyond);
}

/// The distances 1, ½, ¼, … end at the smallest positive number, 2⁻¹⁰⁷⁴.
#[test]
fn a_billion_distances_end_at_the_smallest_number() {
    let probed = one_sided_stability(|d| Some(0.25 * d), Side::Right, 1.0, 1_000_000_000);
    assert_eq!((probed.stability, probed.approach.len()), (Stability::Attracting, 1075));
    assert_eq!(probed.approach[1074], (f64::from_bits(1), f64::from_bits(1)));
    for largest in [f64::INFINITY, f64::NAN, 0.0, -1.0] {
        let probed = one_sided_stability(Some, Side::Right, largest, usize::MAX);
        assert_eq!((probed.stability, probed.approach.len()), (Stability::Undecided, 0));
    }
}
