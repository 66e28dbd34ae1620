//! Derivatives of the map.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use passive_hopper::{FixedPointSpeed, LiftOffMap, MassRatio};
use serde_json::Value;
use std::f64::consts::PI;

fn map(mass_ratio: f64) -> LiftOffMap {
    LiftOffMap::new(MassRatio::new(mass_ratio).unwrap())
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// Errors are judged by what an ulp of α does to the slopes, and by their own size.
#[test]
fn slopes_agree_with_the_reference() {
    let files = [
        include_str!("data/hops_random.jsonl"),
        include_str!("data/hops_window.jsonl"),
        include_str!("data/hops_extreme.jsonl"),
    ];
    let mut compared = 0;
    for line in files.into_iter().flat_map(str::lines) {
        let row: Value = serde_json::from_str(line).unwrap();
        let (m, alpha) = (row["mass_ratio"].as_f64().unwrap(), row["alpha"].as_f64().unwrap());
        let slopes = |alpha: f64| map(m).slopes(alpha).unwrap();
        let found = slopes(alpha);
        assert_eq!(found.is_none(), row["alpha_next"].is_null());
        let (Some(found), Some(_)) = (found, row["dalpha_next_dalpha"].as_str()) else { continue };
        let (up, down) = (slopes(alpha.next_up()), slopes(alpha.next_down()));
        let (Some(up), Some(down)) = (up, down) else { continue };
        let judge = |slope: fn(&passive_hopper::Slopes) -> f64, key: &str, size: f64| {
            let condition =
                (slope(&up) - slope(&found)).abs() + (slope(&down) - slope(&found)).abs();
            let error = (slope(&found) - number(&row[key])).abs();
            let allowed = 64.0 * condition + 1e-13 * (slope(&found).abs() + size);
            assert!(error <= allowed, "{line}: {error:e} over {allowed:e}");
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

/// A hop that was decided in longer arithmetic has the slopes of that hop.
#[test]
fn slopes_follow_the_decided_landings() {
    let (m, alpha) = (1.979_049_840_015_386, 4_619_303.598_589_695);
    let plain = map(m).landings(alpha).unwrap().count();
    let hop = map(m).hop(alpha).unwrap();
    assert_ne!(plain, hop.sudden + 1, "no longer a hard case");
    let slope = map(m).slopes(alpha).unwrap().unwrap().by_speed;
    assert!(slope.is_finite() && slope.abs() > 1e20, "{slope:e}");
}
