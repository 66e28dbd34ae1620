//! Derivatives of the map, against references and near fixed points.

#![allow(clippy::excessive_precision)] // published digits, as they are printed

use hopper_reference::{map, rows};
use passive_hopper::{FixedPointSpeed, LiftOffMap, MassRatio};
use std::f64::consts::PI;

/// The allowed error of a slope is its change within an ulp of α, times 64, and 1e-13 of its size.
#[test]
fn slopes_agree_with_the_reference() {
    let files = [
        include_str!("data/hops_random.jsonl"),
        include_str!("data/hops_window.jsonl"),
        include_str!("data/hops_extreme.jsonl"),
    ];
    let mut compared = 0;
    for row in files.into_iter().flat_map(rows) {
        let (m, alpha) = (row.input("mass_ratio"), row.input("alpha"));
        let slopes = |alpha: f64| map(m).slopes(alpha).unwrap();
        let found = slopes(alpha);
        assert_eq!(found.is_none(), row.is_grounded("alpha_next"), "{row}");
        let (Some(found), Some(_)) = (found, row.result("dalpha_next_dalpha")) else { continue };
        let (up, down) = (slopes(alpha.next_up()), slopes(alpha.next_down()));
        let (Some(up), Some(down)) = (up, down) else { continue };
        let judge = |slope: fn(&passive_hopper::Slopes) -> f64, key: &str, size: f64| {
            let condition =
                (slope(&up) - slope(&found)).abs() + (slope(&down) - slope(&found)).abs();
            let error = (slope(&found) - row.result(key).unwrap()).abs();
            let allowed = 64.0 * condition + 1e-13 * (slope(&found).abs() + size);
            assert!(error <= allowed, "{row}: {error:e} over {allowed:e}");
        };
        judge(|s| s.by_speed, "dalpha_next_dalpha", 1.0);
        judge(|s| s.by_mass_ratio, "dalpha_next_dM", (1.0 + alpha) / (1.0 + m));
        compared += 1;
    }
    assert!(compared > 1000, "{compared}");
}

/// f′ = 1 − (4/3) λ δ^{1/3} on the right of α*_n, 1 + (40/3) λ |δ|^{1/3} on the left.
#[test]
fn slopes_next_to_fixed_points() {
    for (n, lambda) in [(1, 14.467_799_178_408_585), (2, 25.948_279_431_728_652)] {
        for m in [0.2, 1.0, 5.0] {
            let ratio = MassRatio::new(m).unwrap();
            let star = FixedPointSpeed::new(n);
            for side in [1.0, -1.0] {
                let alpha = star.value() + side * 1e-9;
                let root = star.offset_of(alpha).abs().cbrt();
                let slope = LiftOffMap::new(ratio).slopes(alpha).unwrap().unwrap().by_speed;
                let factor = if side > 0.0 { -4.0 / 3.0 } else { 40.0 / 3.0 };
                let leading = factor * lambda * ratio.mu() * root;
                assert!(((slope - 1.0) / leading - 1.0).abs() < 0.02, "{n} {m} {side}: {slope}");
            }
        }
    }
    assert_eq!(map(1.0).slopes(PI).unwrap(), None);
}

/// A hop with other landings in plain `f64` than in longer arithmetic: the landings and the slopes follow the latter.
#[test]
fn slopes_follow_the_decided_landings() {
    let (m, alpha) = (1.979_049_840_015_386, 4_619_303.598_589_695);
    assert_eq!(map(m).landings(alpha).unwrap().len(), 1 + map(m).hop(alpha).unwrap().sudden);
    let slope = map(m).slopes(alpha).unwrap().unwrap().by_speed;
    assert!(slope.is_finite() && slope.abs() > 1e20, "{slope:e}");
}
