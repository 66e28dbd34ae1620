//! The remainders of the expansions, enclosed for all fixed points and mass ratios at once.
//!
//! These tests are the computations in the proofs of docs/theory.md, Theorems 67 to 71. They use intervals that are
//! rounded outwards, and Taylor models. The parameters are p = 1/α*_n, at the first forty fixed points and on an
//! interval that holds all others and p = 0, and μ or κ in small intervals that cover all mass ratios.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

mod first_flight;
mod interval;
mod left;
mod model;
mod others;
mod right;

use hopper_asymptotics::{
    Decay, FIXED_POINT_REMAINDER, LEFT_RANGE, LeftExpansion, RIGHT_RANGE, RightExpansion,
    SMALL_ALPHA_RANGE, SMALL_HOP_REMAINDER, SMALLEST_LAMBDA, TRAP_LENGTH_REMAINDER,
};
use interval::split;
use interval_arithmetic::Enclosure;
use left::Left;
use passive_hopper::alpha_star;
use right::Right;

/// Fixed points with an interval of their own. More points make the proofs longer; fewer need more parts of the rest.
const SINGLE: u64 = 40;

/// Parts of the interval of p from 0 to the fixed points after [`SINGLE`].
const PARTS_OF_THE_REST: u32 = 8;

/// 1/α*_n for all n ≥ 1, in intervals.
fn inverse_speeds() -> Vec<Enclosure> {
    let inverse = |n: u64| {
        let a = alpha_star(n);
        Enclosure::from(1.0) / Enclosure::new(a.next_down(), a.next_up())
    };
    let rest = split(0.0, inverse(SINGLE + 1).high(), PARTS_OF_THE_REST);
    (1..=SINGLE).map(inverse).chain(rest).collect()
}

/// Theorems 67 and 70: the right side, and the length of the trap.
#[test]
fn right_remainders_are_below_their_bounds() {
    const { assert!(RIGHT_RANGE <= 0.1 && SMALLEST_LAMBDA >= 3.0) };
    for (index, p) in inverse_speeds().into_iter().enumerate() {
        // The higher coefficients are largest at n = 1.
        let parts = if index == 0 { 64 } else { 8 };
        for mu in split(0.0, 0.25, parts) {
            let right = Right::new(p, mu);
            assert!(right.remainder.magnitude() <= 0.445, "{p:?} {mu:?} {:?}", right.remainder);
            assert!(right.trap_remainder.magnitude() <= 6.155, "{p:?} {mu:?}");
            assert!(
                right.loss.low() >= right::SMALLEST_LOSS && right.loss.high() <= 1.15,
                "{p:?} {:?}",
                right.loss
            );
        }
    }
    const { assert!(RightExpansion::REMAINDER > 0.445 && TRAP_LENGTH_REMAINDER > 6.155) };
}

/// Theorem 68: the left side. The second flight ends in contact.
#[test]
fn the_left_remainder_is_below_its_bound() {
    const { assert!(LEFT_RANGE <= 1e-3) };
    /// Parts of 0 ≤ κ ≤ 1, an even number, so that κ = ½ is an end.
    const PARTS: u32 = 32;
    for p in inverse_speeds() {
        for kappa in split(0.0, 1.0, PARTS) {
            // μ = κ (1 − κ) is monotone on each part.
            let mu = |kappa: f64| {
                Enclosure::from(kappa) * (Enclosure::from(1.0) - Enclosure::from(kappa))
            };
            let mu = mu(kappa.low()).hull(&mu(kappa.high()));
            let left = Left::new(p, kappa, mu);
            assert!(left.remainder.magnitude() <= 8.79, "{p:?} {kappa:?} {:?}", left.remainder);
            assert!(
                left.second_excess.high() < 0.0 && left.velocity.high() < 0.0,
                "{p:?} {kappa:?}"
            );
        }
    }
    const { assert!(LeftExpansion::REMAINDER > 8.79) };
}

/// Theorem 69: one hop on the right changes K by 1, to (0.55 + 0.3 λ³) u⁻³.
#[test]
fn one_hop_changes_the_number_of_hops_by_one() {
    let mu = Enclosure::new(0.0, 0.25);
    let [constant, cubic] = Decay::ONE_HOP;
    for p in inverse_speeds() {
        for z in split(0.0, 1.0, 256) {
            let found = right::hop_remainder(p, mu, z, RightExpansion::REMAINDER);
            // (0.55 + 0.3 λ³) v³ over (v + s)³, s = λv, at the corner where it is smallest.
            let bound = constant * (1.0 - z.high()).powi(3) + cubic * z.low().powi(3);
            assert!(found.magnitude() < bound, "{p:?} {z:?}: {found:?} {bound}");
        }
    }
    // Σ u_j⁻³ ≤ u₀⁻³ + u₀⁻²/(2 r min G), and r/u₀ ≤ 1/30.
    let sum = 1.0 / 30.0 + 0.5 / right::SMALLEST_LOSS;
    assert!(sum < 0.603 && Decay::ORBIT > 0.603, "{sum}");
}

/// Theorem 69: the slope of rK.
#[test]
fn the_slope_of_the_number_of_hops_is_near_one() {
    let mut range = Enclosure::from(1.0);
    for p in inverse_speeds() {
        for v in split(0.0, right::LARGEST_ROOT, 16) {
            for s in split(0.0, 0.1, 8) {
                range = range.hull(&right::slope(p, v, s));
            }
        }
    }
    assert!(range.low() >= 0.69 && range.high() <= 1.2, "{range:?}");
}

/// Theorem 71: small hops, and the fixed points.
#[test]
fn remainders_of_small_hops_and_fixed_points_are_below_their_bounds() {
    const { assert!(SMALL_ALPHA_RANGE <= 0.3) };
    for mu in split(0.0, 0.25, 8) {
        let found = others::small_hop_remainder(mu);
        assert!(found.magnitude() <= 2.365, "{mu:?} {found:?}");
    }
    let found = others::fixed_point_remainder();
    assert!(found.low() > 4.7 && found.high() < 5.177, "{found:?}");
    const { assert!(SMALL_HOP_REMAINDER > 2.365 && FIXED_POINT_REMAINDER > 5.177) };
}

/// The enclosures contain values of the map. (A wrong coefficient of an expansion is seen in `Model::without`.)
#[test]
fn enclosures_are_near_values_of_the_map() {
    use hopper_asymptotics::{Coefficients, Form};
    use passive_hopper::{LiftOffMap, MassRatio};
    for (n, m) in [(1, 1.0), (1, 0.3), (2, 5.0), (10, 1.0)] {
        let ratio = MassRatio::new(m).unwrap();
        let map = LiftOffMap::new(ratio);
        let a = alpha_star(n);
        let p = Enclosure::from(1.0) / Enclosure::new(a.next_down(), a.next_up());
        let around = |x: f64| Enclosure::new(x * (1.0 - 1e-9), (x * (1.0 + 1e-9)).min(1.0));
        let (right, left) = (
            Right::new(p, around(ratio.mu())),
            Left::new(p, around(ratio.kappa()), around(ratio.mu())),
        );
        let lambda = Coefficients::new(n, ratio, Form::Corrected).unwrap().lambda;
        for delta in [1e-3f64, 0.01, 0.05, 0.1] {
            let exact = map.reference_local_hop(n, delta).unwrap().unwrap().loss.unwrap().nearest;
            let v = delta.cbrt();
            let series = RightExpansion::new(n, ratio).unwrap().loss(delta).unwrap().value;
            let rest = (exact - series) / (lambda * delta * delta * delta);
            assert!(
                right.remainder.low() <= rest && rest <= right.remainder.high(),
                "{n} {m} {rest}"
            );
            assert!(right.loss.low() <= exact / (lambda * delta * v));
        }
        let series = LeftExpansion::new(n, ratio).unwrap();
        for delta in [1.0, 0.3, 0.1].map(|part| part * series.range()) {
            let exact = map.reference_local_hop(n, -delta).unwrap().unwrap().loss.unwrap().nearest;
            let rest = (exact - series.loss(-delta).unwrap().value)
                / (10.0 * lambda * delta.cbrt() * delta * delta);
            let found = left.remainder;
            assert!(found.low() <= rest && rest <= found.high(), "{n} {m} {rest} {found:?}");
        }
    }
}
