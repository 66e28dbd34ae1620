//! Fatou coordinates: Abel's equation, inverses, jumps.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use hopper_asymptotics::{Escape, FatouCoordinate, Offset, Phase, Side};
use passive_hopper::{LiftOffMap, MassRatio};

const RATIOS: [f64; 9] = [0.02, 0.05, 0.12, 0.2, 0.5, 0.8, 1.0, 3.0, 50.0];

/// (Ψ(f(δ)) − Ψ(δ)) ± 1, with the sum of the errors.
fn abel(psi: &FatouCoordinate, map: &LiftOffMap, n: u64, delta: f64) -> (f64, f64) {
    let next = map.hop_near_fixed_point(n, delta).unwrap().next.unwrap();
    let (from, to) = (psi.phase(delta.into()).unwrap(), psi.phase(next.into()).unwrap());
    let sign = if psi.side() == Side::Left { -1 } else { 1 };
    let whole = to.whole() - from.whole() - sign;
    let whole: f64 = i64::try_from(whole).unwrap() as f64;
    (whole + (to.fraction() - from.fraction()), from.error() + to.error())
}

/// A hop is right to 8 ulps of δ′; it moves the phase by 8ε/(3 A x).
fn hop_error(psi: &FatouCoordinate, delta: f64) -> f64 {
    8.0 * f64::EPSILON / (3.0 * psi.drift() * delta.abs().cbrt())
}

#[test]
fn abel_equation_holds_to_the_bounds() {
    let mut worst = (0.0, 0.0);
    for n in 1..=10 {
        for m in RATIOS {
            let ratio = MassRatio::new(m).unwrap();
            let map = LiftOffMap::new(ratio);
            for side in [Side::Left, Side::Right] {
                let psi = FatouCoordinate::new(n, ratio, side).unwrap();
                for k in 0..30 {
                    let size = 0.9 * psi.reach() * 10f64.powf(-0.4 * f64::from(k));
                    let delta = if side == Side::Left { -size } else { size };
                    if size < 1e-15 || map.hop_near_fixed_point(n, delta).unwrap().next.unwrap().abs() > psi.reach() {
                        continue;
                    }
                    let (off, error) = abel(&psi, &map, n, delta);
                    assert!(off.abs() <= error + hop_error(&psi, delta), "{n} {m} {delta:e}: {off:e} {error:e}");
                    if off.abs() - hop_error(&psi, delta) > worst.0 { worst.0 = off.abs() - hop_error(&psi, delta); println!("{n} {m} {delta:e} off {off:e} err {error:e}, hop {:e} range {:e}", hop_error(&psi, delta), psi.range()); }
                    if error > worst.1 { worst.1 = error; println!("ERR {n} {m} {delta:e} off {off:e} err {error:e} range {:e} reach {:e}", psi.range(), psi.reach()); }
                }
            }
        }
    }
    println!("{worst:?}");
}

#[test]
fn look() {
    let ratio = MassRatio::new(0.2).unwrap();
    let psi = Escape::new(2, ratio).unwrap();
    for text in ["-1e-6", "-1e-12", "-1e-15", "-1e-100", "-1e-300", "-1e-1000", "-1e-9999"] {
        let begin = std::time::Instant::now();
        let phase = psi.phase(text.parse().unwrap()).unwrap();
        let time = begin.elapsed();
        let digits = phase.whole().to_string().len();
        let (back, error) = psi.coordinate().offset(&phase).unwrap();
        println!("{text}: {} digits .{:.16} ± {:e} in {time:?}; back {back} {error:e}", digits, phase.fraction(), phase.error());
        if digits < 20 { println!("   {phase}"); }
    }
    let (after, error) = psi.offset_after("-1e-100".parse().unwrap(), 1000).unwrap();
    println!("{after} {error:e} {:?}", Phase::new(0, 0.5, 0.0));
    let _ = Offset::from(1.0);
}
