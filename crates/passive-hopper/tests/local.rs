//! Hops in the coordinate of a fixed point.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]
#![allow(clippy::excessive_precision)] // published digits, as they are printed

use passive_hopper::{Error, LiftOffMap, MassRatio};
use serde_json::Value;

fn map(mass_ratio: f64) -> LiftOffMap {
    LiftOffMap::new(MassRatio::new(mass_ratio).unwrap())
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// (n, δ) to (n, δ′), relative to δ′ and to what an ulp of δ does to it.
#[test]
fn hops_in_the_fixed_points_own_coordinate() {
    const ULPS: f64 = 8.0;
    let files = [
        include_str!("data/hops_near_fixed_point.jsonl"),
        include_str!("data/hops_hard_offsets.jsonl"),
    ];
    for line in files.into_iter().flat_map(str::lines) {
        let row: Value = serde_json::from_str(line).unwrap();
        let (n, delta) = (row["n"].as_u64().unwrap(), row["offset"].as_f64().unwrap());
        let hop = map(row["mass_ratio"].as_f64().unwrap()).hop_near_fixed_point(n, delta).unwrap();
        assert_eq!(hop.sudden as u64, row["sudden"].as_u64().unwrap(), "{line}");
        assert_eq!(hop.next.is_none(), row["offset_next"].is_null(), "{line}");
        if let Some(next) = hop.next {
            let error = (next / number(&row["offset_next"]) - 1.0).abs();
            assert!(error <= ULPS * f64::EPSILON, "{line}: {next:e}");
            // The loss is no difference of the two.
            let loss = delta - next;
            assert!(
                (hop.loss.unwrap() - loss).abs() <= f64::EPSILON * (delta.abs() + loss),
                "{line}"
            );
        }
        if let Some(shift) = row["flight_time_minus_2alpha_star"].as_str() {
            let error = (hop.time_shift / shift.parse::<f64>().unwrap() - 1.0).abs();
            assert!(error < ULPS * f64::EPSILON, "{line}: {}", hop.time_shift);
        }
    }
}

/// Just inside and outside the ends of a cell, which lie between two f64.
#[test]
fn cells_end_where_they_should() {
    for n in [1u64, 1000, 100_000, 1 << 40] {
        let error = |delta: f64| map(3.0).hop_near_fixed_point(n, delta).unwrap_err();
        let Error::Offset { left, right, .. } = error(4.0) else { panic!() };
        for (end, outside) in [(left, -1), (right, 1)] {
            let step = |ulps: i64| {
                f64::from_bits(end.to_bits().wrapping_add_signed(ulps * end.signum() as i64))
            };
            let (out, inside) = (step(i64::from(outside) * 2), step(-i64::from(outside) * 2));
            assert!(matches!(
                error(if outside < 0 { out.min(end.next_down()) } else { out.max(end.next_up()) }),
                Error::Offset { .. }
            ));
            let hop = map(3.0).hop_near_fixed_point(
                n,
                if outside < 0 { inside.max(end.next_up()) } else { inside.min(end.next_down()) },
            );
            assert!(hop.is_ok(), "{n} {hop:?}");
        }
        assert!(map(3.0).hop_near_fixed_point(n, f64::NAN).is_err());
    }
    assert!(
        map(1.0).hop_near_fixed_point(0, 0.1).is_err()
            && map(1.0).hop_near_fixed_point(1 << 43, 0.1).is_err()
    );
}

/// δ after up to ten thousand hops, against seventy digits.
#[test]
fn orbits_follow_the_reference() {
    for line in include_str!("data/orbits.jsonl").lines() {
        let row: Value = serde_json::from_str(line).unwrap();
        let (n, hops) = (row["n"].as_u64().unwrap(), row["hops"].as_u64().unwrap());
        let map = map(row["mass_ratio"].as_f64().unwrap());
        let mut delta = row["offset"].as_f64().unwrap();
        for _ in 0..hops {
            delta = map.hop_near_fixed_point(n, delta).unwrap().next.unwrap();
        }
        let error = (delta / number(&row["offset_after"]) - 1.0).abs();
        assert!(error < 1e-13, "{line}: {delta:e}");
    }
}

/// The algebraic approach δ_k ≈ (3/(λk))³, for ever: α itself would stand still at 3e-12.
#[test]
fn orbits_approach_without_stagnating() {
    let (map, mut delta) = (map(1.0), 1e-3);
    let mut last = delta;
    for k in 1..=1_000_000u32 {
        delta = map.hop_near_fixed_point(1, delta).unwrap().next.unwrap();
        assert!(delta < last && delta > 0.0, "{k}");
        last = delta;
    }
    // δ^{−1/3} = λk/3 + (β/α* + 2λ/3) ln k + C: the logarithm is 1e-4 of the rest.
    let leading = (3.0 / (3.616_949_794_602_146 * 1e6f64)).powi(3);
    assert!((delta / leading - 1.0).abs() < 2e-3, "{delta:e} {leading:e}");
}
