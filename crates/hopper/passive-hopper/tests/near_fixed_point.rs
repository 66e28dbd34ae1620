//! Hops in (n, δ), the coordinate of a fixed point: α = α*_n + δ.

#![allow(clippy::excessive_precision)] // published digits, as they are printed

use hopper_reference::{map, rows};
use passive_hopper::Error;

/// Largest error of δ′, in ulps, as stated in the crate's documentation.
const ULPS: f64 = 8.0;

#[test]
fn hops_near_fixed_points_are_right_to_eight_ulps() {
    let files = [
        include_str!("data/hops_near_fixed_point.jsonl"),
        include_str!("data/hops_hard_offsets.jsonl"),
    ];
    for row in files.into_iter().flat_map(rows) {
        let (n, delta) = (row.integer("n"), row.input("offset"));
        let hop = row.map().hop_near_fixed_point(n, delta).unwrap();
        assert_eq!(hop.sudden as u64, row.integer("sudden"), "{row}");
        assert_eq!(hop.next.is_none(), row.is_grounded("offset_next"), "{row}");
        if let Some(next) = hop.next {
            let error = (next / row.result("offset_next").unwrap() - 1.0).abs();
            assert!(error <= ULPS * f64::EPSILON, "{row}: {next:e}");
            // The loss is computed separately, not as the difference δ − δ′. It agrees with this difference to the
            // rounding of the difference.
            let loss = delta - next;
            assert!(
                (hop.loss.unwrap() - loss).abs() <= f64::EPSILON * (delta.abs() + loss),
                "{row}"
            );
        }
        if let Some(shift) = row.result("flight_time_minus_2alpha_star") {
            let error = (hop.time_shift / shift - 1.0).abs();
            assert!(error < ULPS * f64::EPSILON, "{row}: {}", hop.time_shift);
        }
    }
}

#[test]
fn the_largest_index_is_an_error() {
    for n in [u64::MAX, u64::MAX - 1, 1 << 63] {
        let error = map(1.0).hop_near_fixed_point(n, 1e-5).unwrap_err();
        assert!(matches!(error, Error::Offset { .. }), "{error}");
    }
}

/// The ends nπ and (n+1)π of the interval of a fixed point lie between two `f64`. Offsets two ulps inside are
/// accepted, and offsets outside are errors.
#[test]
fn offsets_are_accepted_up_to_the_ends_of_the_interval_of_the_fixed_point() {
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

/// δ after up to ten thousand hops, against references of seventy digits.
#[test]
fn orbits_follow_the_reference() {
    for row in rows(include_str!("data/orbits.jsonl")) {
        let (n, hops) = (row.integer("n"), row.integer("hops"));
        let map = row.map();
        let mut delta = row.input("offset");
        for _ in 0..hops {
            delta = map.hop_near_fixed_point(n, delta).unwrap().next.unwrap();
        }
        let error = (delta / row.result("offset_after").unwrap() - 1.0).abs();
        assert!(error < 1e-13, "{row}: {delta:e}");
    }
}

/// The approach δ_k ≈ (3/(λk))³ goes on without end. In α it would stop at δ ≈ 3e-12, where the loss is below an ulp.
#[test]
fn orbits_approach_without_stagnating() {
    let (map, mut delta) = (map(1.0), 1e-3);
    let mut last = delta;
    for k in 1..=1_000_000u32 {
        delta = map.hop_near_fixed_point(1, delta).unwrap().next.unwrap();
        assert!(delta < last && delta > 0.0, "{k}");
        last = delta;
    }
    // δ^{−1/3} = λk/3 + (β/α* + 2λ/3) ln k + C: the logarithm is 1e-4 of the other terms.
    let leading = (3.0 / (3.616_949_794_602_146 * 1e6f64)).powi(3);
    assert!((delta / leading - 1.0).abs() < 2e-3, "{delta:e} {leading:e}");
}
