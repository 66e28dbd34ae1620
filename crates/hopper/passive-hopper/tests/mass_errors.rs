//! Bounds for all speeds and mass ratios of a box: against the hops of its corners and of points inside.

use basin_of_attraction::SplitMix64;
use passive_hopper::{
    Arithmetic, ExtendedOrbit, ExtendedStep, HopWithin, LiftOffMap, MassRatio, alpha_star,
};

fn ratio(m: f64) -> MassRatio {
    MassRatio::new(m).unwrap()
}

/// Boxes of a speed and a mass ratio: anywhere, next to multiples of π, and left of a fixed point.
fn boxes(count: u64) -> impl Iterator<Item = (f64, f64, f64, f64)> {
    let random = SplitMix64::from_seed(78);
    (0..count).map(move |k| {
        let part = |i: u64| random.uniform(8 * k + i);
        let n = 1 + (6.0 * part(1)) as u64;
        let near = pxfm::f_exp10(-6.0 * part(2));
        let speed = match k % 3 {
            0 => 0.5 + 30.0 * part(1),
            1 => n as f64 * std::f64::consts::PI + near,
            _ => alpha_star(n) - near,
        };
        let m = pxfm::f_exp10(-1.7 + 3.0 * part(3));
        let error = pxfm::f_exp10(-12.0 + 10.0 * part(4));
        (speed, m, error, m * pxfm::f_exp10(-12.0 + 10.0 * part(5)))
    })
}

#[test]
fn hops_of_a_box_are_within_its_bound() {
    let (mut conclusive, mut largest, mut grounded) = (0, 0.0_f64, 0);
    for (speed, m, error, width) in boxes(60_000) {
        let map = LiftOffMap::new(ratio(m));
        let ends = (ratio(m - width), ratio(m + width));
        let found = map.hop_within_masses(speed, error, ends);
        if found == HopWithin::Inconclusive {
            continue;
        }
        for (i, j) in [(-1, -1), (-1, 1), (1, -1), (1, 1), (0, 1), (1, 0), (0, -1), (-1, 0)] {
            let (start, of) =
                (speed + 0.9999 * error * f64::from(i), m + 0.9999 * width * f64::from(j));
            let next = LiftOffMap::new(ratio(of)).image(start).unwrap();
            match (found, next) {
                (HopWithin::Next { speed: middle, error: bound }, Some(next)) => {
                    conclusive += 1;
                    let off = (next - middle).abs();
                    assert!(
                        off <= bound,
                        "M = {m} ± {width:e}, α = {speed} ± {error:e}: {off:e} > {bound:e}"
                    );
                    largest = largest.max(off / bound);
                }
                (HopWithin::Grounded, None) => grounded += 1,
                _ => panic!("M = {m} ± {width:e}, α = {speed} ± {error:e}: {found:?}, {next:?}"),
            }
        }
    }
    assert!(conclusive > 100_000 && grounded > 1000, "{conclusive} {grounded}");
    assert!(largest > 0.99, "{largest}");
}

#[test]
fn a_map_outside_its_own_masses_is_inconclusive() {
    let map = LiftOffMap::new(ratio(0.2));
    for ends in [(0.21, 0.3), (0.1, 0.19), (0.3, 0.1)] {
        let found = map.hop_within_masses(5.5, 1e-9, (ratio(ends.0), ratio(ends.1)));
        assert_eq!(found, HopWithin::Inconclusive);
    }
    let ends = (ratio(0.2), ratio(0.2));
    for (speed, error) in [(f64::NAN, 0.0), (-1.0, 0.0), (5.5, f64::NAN), (5.5, f64::INFINITY)] {
        assert_eq!(map.hop_within_masses(speed, error, ends), HopWithin::Inconclusive);
    }
}

/// docs/theory.md, Corollary 93: left of a fixed point α′ falls as κ grows, for M ≤ 1.
#[test]
fn left_of_a_fixed_point_the_next_speed_falls_with_kappa() {
    for n in 1..=12 {
        for k in 0..8 {
            let speed = alpha_star(n) - 0.0109 * pxfm::f_exp2(-f64::from(k));
            let next = |m: f64| LiftOffMap::new(ratio(m)).image(speed).unwrap().unwrap_or(0.0);
            let falls = |m: f64| next(m) < next(0.98 * m);
            assert!((1..=50).all(|m| falls(0.02 * f64::from(m))), "n = {n}, α = {speed}");
        }
    }
}

/// Orbits from the corners of a box of starts and mass ratios are where the tangent of the middle says.
#[test]
fn orbits_of_a_box_are_where_the_tangent_says() {
    let (mut checked, mut largest) = (0, 0.0_f64);
    for (speed, m, _, _) in boxes(600) {
        let (radius, width) = (1e-8, 1e-8 * m);
        let map = LiftOffMap::new(ratio(m));
        let kappa = |m: f64| m / (1.0 + m);
        let kappa_radius = kappa(m + width) - kappa(m);
        let orbit = ExtendedOrbit::new(&map, speed, Arithmetic::Bits256).unwrap();
        let mut orbit = orbit.with_radii(radius, kappa_radius);
        let mut others =
            [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0), (0.0, 1.0)].map(|(i, j)| {
                let (start, of) = (speed + 0.99 * i * radius, m + 0.98 * j * width);
                let (y, k) = (start - speed, kappa(of) - kappa(m));
                let map = LiftOffMap::new(ratio(of));
                (y, k, ExtendedOrbit::new(&map, start, Arithmetic::Bits256).unwrap())
            });
        for _ in 0..4 {
            if orbit.hop().unwrap() != ExtendedStep::LiftsOff {
                break;
            }
            let tangent = orbit.tangent().unwrap();
            for (y, k, other) in &mut others {
                assert_eq!(other.hop().unwrap(), ExtendedStep::LiftsOff, "M = {m}, α = {speed}");
                let moved = other.minus(orbit.speed()) - orbit.minus(orbit.speed());
                let rest = moved - tangent.slope * *y - tangent.kappa_slope * *k;
                // k has the rounding of κ.
                let rounding = 2.0 * f64::EPSILON * tangent.kappa_slope.abs();
                let most = tangent.rounding + tangent.second + rounding;
                assert!(rest.abs() <= most, "M = {m}, α = {speed}: {rest:e} {most:e} {tangent:?}");
                assert!(moved.abs() <= tangent.reach());
                largest = largest.max(moved.abs() / tangent.reach());
                checked += 1;
            }
        }
    }
    assert!(checked > 2000 && largest > 0.9, "{checked} {largest}");
}
