//! Fatou coordinates: reference phases, Abel's equation, jumps over many hops, and the inverse.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hopper_asymptotics::{BigInt, Error, Escape, FatouCoordinate, Offset, Phase, Side};
use hopper_reference::{Row, rows};
use passive_hopper::{Arithmetic, ExtendedOrbit, ExtendedStep, LiftOffMap, MassRatio, alpha_star};
use proptest::prelude::*;

const SIDES: [Side; 2] = [Side::Left, Side::Right];
const RATIOS: [f64; 9] = [0.02, 0.05, 0.12, 0.2, 0.5, 0.8, 1.0, 3.0, 50.0];

fn sign(side: Side) -> f64 {
    match side {
        Side::Left => -1.0,
        Side::Right => 1.0,
    }
}

fn coordinate(n: u64, mass_ratio: f64, side: Side) -> FatouCoordinate {
    FatouCoordinate::new(n, MassRatio::new(mass_ratio).unwrap(), side).unwrap()
}

/// phase − (whole + fraction).
fn difference(phase: &Phase, whole: &BigInt, fraction: f64) -> f64 {
    let whole = i64::try_from(phase.whole() - whole).unwrap();
    whole as f64 + (phase.fraction() - fraction)
}

/// The effect of half an ulp of `delta` on its phase, 3/2 of the leading term: the next ones are smaller.
fn half_ulp(psi: &FatouCoordinate, delta: f64) -> f64 {
    1.5 * 0.5 * f64::EPSILON / (3.0 * psi.drift() * delta.abs().cbrt())
}

/// The coordinate and the offset of a line of a reference file.
fn scene(row: &Row) -> (FatouCoordinate, Offset) {
    let side = if row.text("side") == "left" { Side::Left } else { Side::Right };
    let exponent = row.input("exponent") as i64;
    let delta = Offset::new(sign(side) * row.input("mantissa"), exponent).unwrap();
    (coordinate(row.integer("n"), row.input("mass_ratio"), side), delta)
}

#[test]
fn phases_agree_with_28_digits() {
    // At |δ| ≥ 10⁻¹⁵: the largest error, and the largest bound.
    let (mut nearer, mut bound) = (0.0f64, 0.0f64);
    let (mut worst, mut deepest, mut compared) = (0.0f64, 0, 0);
    for row in rows(include_str!("data/phases.jsonl")) {
        let (psi, delta) = scene(&row);
        if delta.nearest().abs() > psi.reach() {
            assert!(matches!(psi.phase(delta), Err(Error::OutsideRange { .. })), "{row}");
            continue;
        }
        let phase = psi.phase(delta).unwrap();
        let whole: BigInt = row.text("whole").parse().unwrap();
        assert_eq!(phase.whole(), &whole, "{row}");
        let error = difference(&phase, &whole, row.result("fraction").unwrap()).abs();
        // The reference as an `f64` is right to half an ulp of one.
        assert!(error <= phase.error() + 0.5 * f64::EPSILON, "{row} {phase} {error:e}");
        worst = worst.max(error);
        if delta.nearest().abs() >= 1e-15 {
            nearer = nearer.max(error);
            bound = bound.max(phase.error());
        }
        deepest = deepest.min(delta.exponent());
        compared += 1;
    }
    assert!(worst < 1e-12, "{worst:e}");
    assert!(nearer < 2e-13 && bound < 1e-12, "{nearer:e} {bound:e}");
    assert!(compared >= 272 && deepest == -1000, "{compared} {deepest}");
}

#[test]
fn leading_coefficients_agree_with_30_digits() {
    for row in rows(include_str!("data/phases.jsonl")) {
        let (psi, _) = scene(&row);
        let reference = |key: &str| -> f64 { row.inner_result("coefficients", key) };
        assert!((psi.drift() / reference("a") - 1.0).abs() < 8.0 * f64::EPSILON, "{row}");
        assert!((psi.logarithm() / reference("c") - 1.0).abs() < 8.0 * f64::EPSILON, "{row}");
    }
}

/// Up to 10⁶ hops, jumped over; the reference follows them one by one.
#[test]
fn offsets_after_many_hops_agree_with_30_digits() {
    let mut most = 0;
    for row in rows(include_str!("data/slow_orbits.jsonl")) {
        let (psi, start) = scene(&row);
        if start.nearest().abs() > psi.reach() {
            continue;
        }
        let (hops, exact) = (row.integer("hops"), row.result("offset_after").unwrap());
        let phase = psi.phase(start).unwrap();
        let (after, error) = match psi.side() {
            Side::Left => {
                let ratio = MassRatio::new(row.input("mass_ratio")).unwrap();
                let escape = Escape::new(row.integer("n"), ratio).unwrap();
                // The offset and the number of hops are the same statement.
                let found = escape.hops(start, exact.into()).unwrap();
                let off = difference(&found, &hops.into(), 0.0);
                assert!(off.abs() <= found.error() + half_ulp(&psi, exact), "{row} {found}");
                escape.offset_after(start, hops).unwrap()
            }
            Side::Right => psi.offset(&phase.plus(hops)).unwrap(),
        };
        let off = (after.nearest() / exact - 1.0).abs();
        assert!(off <= error && error < 1e-12, "{row}: {after} {off:e} {error:e}");
        assert!(off < 4e-15, "{row}: {after} {off:e}");
        most = most.max(hops);
    }
    assert_eq!(most, 1_000_000);
}

/// The offset after `hops` hops of 256 bits from `delta`, while it stays within `reach`, and their number.
fn exact_hops(map: &LiftOffMap, n: u64, delta: f64, hops: i64, reach: f64) -> (f64, i64) {
    let mut orbit = ExtendedOrbit::new(map, alpha_star(n), Arithmetic::Bits256).unwrap();
    orbit.move_to(n, delta, 0.0).unwrap();
    let (mut last, mut followed) = (delta, 0);
    while followed < hops {
        assert_eq!(orbit.hop().unwrap(), ExtendedStep::LiftsOff);
        let (next, error) = orbit.offset_from(n);
        assert!(error <= 0.51 * f64::EPSILON * next.abs(), "{next:e} {error:e}");
        if next.abs() > reach {
            break;
        }
        (last, followed) = (next, followed + 1);
    }
    (last, followed)
}

/// By how much Ψ(f^k(δ)) ∓ k differs from Ψ(δ), the two bounds together, and k, which is at most `hops`.
fn abel(psi: &FatouCoordinate, n: u64, ratio: f64, delta: f64, hops: i64) -> (f64, f64, i64) {
    let map = LiftOffMap::new(MassRatio::new(ratio).unwrap());
    let (after, hops) = exact_hops(&map, n, delta, hops, psi.reach());
    let (from, to) = (psi.phase(delta.into()).unwrap(), psi.phase(after.into()).unwrap());
    let moved = to.plus(-sign(psi.side()) as i64 * hops);
    let off = difference(&moved, from.whole(), from.fraction()).abs();
    (off, from.error() + to.error() + half_ulp(psi, after), hops)
}

#[test]
fn abels_equation_holds_for_exact_hops() {
    let (mut worst, mut single) = (0.0f64, 0);
    for n in 1..=10 {
        for ratio in RATIOS {
            for side in SIDES {
                let psi = coordinate(n, ratio, side);
                for k in 0..12 {
                    let delta = sign(side) * 0.9 * psi.reach() * 10f64.powf(-1.05 * f64::from(k));
                    let (off, error, hops) = abel(&psi, n, ratio, delta, 1);
                    assert!(off <= error, "{n} {ratio} {delta:e}: {off:e} {error:e}");
                    worst = worst.max(off - 2.0 * half_ulp(&psi, delta));
                    single += hops;
                }
            }
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
    assert!(single > 2000, "{single}");
}

/// Above the range of the series a phase is found by hops into the range, and Abel's equation holds by
/// construction. There it is compared with a phase thirty and more hops further in.
#[test]
fn phases_above_the_range_agree_with_a_smaller_start_of_the_series() {
    let mut worst = 0.0f64;
    for n in 1..=10 {
        for ratio in RATIOS {
            for side in SIDES {
                let psi = coordinate(n, ratio, side);
                for hops in [60, 45, 30] {
                    // 25 hops outside the range Ψ is some 25; and 1/(A x) falls by one in a hop.
                    let delta = match side {
                        Side::Left => -0.09 * psi.range(),
                        Side::Right => psi.reach() * (1.0 - 0.01 * hops as f64),
                    };
                    let (off, error, followed) = abel(&psi, n, ratio, delta, hops);
                    assert!(
                        off <= error && followed >= 30,
                        "{n} {ratio} {side:?} {followed}: {off:e} {error:e}"
                    );
                    worst = worst.max(off);
                }
            }
        }
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn an_offset_comes_back_from_its_phase() {
    for (n, ratio) in [
        (1, 0.02),
        (1, 0.2),
        (2, 0.2),
        (3, 0.8),
        (10, 1.0),
        (7, 50.0),
        (1000, 0.3),
        (1_000_000, 1.0),
    ] {
        for side in SIDES {
            let psi = coordinate(n, ratio, side);
            let range = psi.range();
            let inside = (0..16).map(|k| Offset::from(sign(side) * 0.99 * range * 10f64.powi(-k)));
            let outside = [0.999, 0.7].map(|part| Offset::from(sign(side) * part * psi.reach()));
            let is_near = |delta: &Offset| delta.nearest().abs() <= psi.range();
            let deep = [-20, -100, -250, -300, -308, -320, -400, -700, -830, -1000, -3000]
                .map(|exponent| Offset::new(sign(side) * 3.0, exponent).unwrap());
            for delta in inside.chain(outside).chain(deep.into_iter().filter(is_near)) {
                let phase = psi.phase(delta).unwrap();
                let (back, error) = psi.offset(&phase).unwrap();
                let scene = format!("{n} {ratio} {delta}: {back} ± {error:e}");
                assert!(error < 1e-10, "{scene}");
                let shift = back.exponent() - delta.exponent();
                let off = back.mantissa() / delta.mantissa() * 10f64.powi(shift as i32) - 1.0;
                assert!(off.abs() <= error + 1e-15, "{scene} {off:e}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    /// The bound of a phase is a bound, at every depth: up to 200 exact hops lead from a point whose bound is far
    /// smaller, or to it.
    #[test]
    fn bounds_of_phases_hold(
        n in 1..=50u64,
        exponent in -3.0..3.0f64,
        left in any::<bool>(),
        depth in 0.0..12.0f64,
        hops in 1..200i64,
    ) {
        let side = if left { Side::Left } else { Side::Right };
        let ratio = 10f64.powf(exponent);
        let psi = coordinate(n, ratio, side);
        let delta = sign(side) * 0.999 * psi.reach() * 10f64.powf(-depth);
        let (off, error, _) = abel(&psi, n, ratio, delta, hops);
        prop_assert!(off <= error, "{} {} {:e}: {:e} {:e}", n, ratio, delta, off, error);
    }
}
