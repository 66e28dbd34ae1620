//! Orbits with bounds: the exact orbit, computed in 1024 bits, lies within them.

use passive_hopper::{
    Arithmetic, BoundedOrbit, Error, ExtendedOrbit, ExtendedStep, LiftOffMap, MassRatio,
};

/// The golden ratio's fraction spreads k over [0, 1).
fn spread(k: u32) -> f64 {
    (f64::from(k) * 0.618_033_988_749_894_9).fract()
}

#[test]
fn the_exact_orbit_is_within_the_bounds() {
    let (mut hops, mut grounded) = (0, 0);
    for k in 0..120 {
        let (m, alpha) = (0.05 + 0.9 * spread(k), 1.0 + 25.0 * spread(7 * k + 3));
        let map = LiftOffMap::new(MassRatio::new(m).unwrap());
        let mut orbit = BoundedOrbit::new(&map, alpha).unwrap();
        let mut exact = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits512).unwrap();
        for _ in 0..12 {
            let step = orbit.hop().unwrap();
            assert_eq!(step, exact.hop().unwrap(), "M = {m}, α = {alpha}");
            if step != ExtendedStep::LiftsOff {
                grounded += 1;
                break;
            }
            hops += 1;
            let off = exact.minus(orbit.speed()).abs();
            assert!(off <= orbit.error() + exact.error(), "M = {m}, α = {alpha}: {off:e}");
            assert!(orbit.error() <= 1e-9 * orbit.speed());
        }
    }
    assert!(hops > 500 && grounded > 5, "{hops} {grounded}");
}

/// A chaotic orbit: the one in `f64` leaves the exact one after some hops.
#[test]
fn an_orbit_that_f64_leaves_open_goes_on_in_longer_arithmetic() {
    let map = LiftOffMap::new(MassRatio::new(20.0).unwrap());
    let mut orbit = BoundedOrbit::new(&map, 60.0).unwrap();
    let mut exact = ExtendedOrbit::new(&map, 60.0, Arithmetic::Bits1024).unwrap();
    for hop in 1..=40 {
        assert_eq!(orbit.hop().unwrap(), ExtendedStep::LiftsOff);
        assert_eq!(exact.hop().unwrap(), ExtendedStep::LiftsOff);
        let (off, error) = (exact.minus(orbit.speed()).abs(), orbit.error());
        assert!(off <= error + exact.error() && error < 1e-9 * orbit.speed(), "{hop} {off:e}");
    }
    assert!(orbit.arithmetic().is_some());
    assert_eq!(orbit.hops(), 40);
}

/// The bound tells the distance that the orbit really has, up to the rounding of 106 bits.
#[test]
fn bounds_are_sharp() {
    for k in 0..50 {
        let (m, alpha) = (0.05 + 0.9 * spread(k), 1.0 + 25.0 * spread(7 * k + 3));
        let map = LiftOffMap::new(MassRatio::new(m).unwrap());
        let orbit = BoundedOrbit::follow(&map, alpha, 3).unwrap();
        let mut exact = ExtendedOrbit::new(&map, alpha, Arithmetic::Bits512).unwrap();
        for (speed, error) in orbit.speeds.iter().zip(&orbit.errors).skip(1) {
            exact.hop().unwrap();
            let off = exact.minus(*speed).abs();
            assert!(off <= error + exact.error(), "M = {m}, α = {alpha}: {error:e} {off:e}");
            assert!(*error <= 1.001 * off + 1e-20, "M = {m}, α = {alpha}: {error:e} {off:e}");
        }
    }
}

#[test]
fn wrong_speeds_are_errors() {
    let map = LiftOffMap::new(MassRatio::ONE);
    for alpha in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(BoundedOrbit::new(&map, alpha), Err(Error::LiftOffSpeed { .. })));
    }
}

/// The losses of the landings add up to the loss of the hop, and to the difference of the energies at both lift-offs.
#[test]
fn the_landings_take_the_energy_of_the_hop() {
    use passive_hopper::{HopperState, energy};
    for k in 0..300 {
        let (m, alpha) = (0.05 + 3.0 * spread(k), 0.5 + 25.0 * spread(5 * k + 1));
        let ratio = MassRatio::new(m).unwrap();
        let map = LiftOffMap::new(ratio);
        let hop = map.hop(alpha).unwrap();
        let landings = map.landings(alpha).unwrap();
        let sum: f64 = landings.iter().map(|landing| landing.energy_loss(ratio)).sum();
        let loss = hop.energy_loss(ratio);
        assert!((sum - loss).abs() <= 1e-11 * loss, "M = {m}, α = {alpha}: {sum} {loss}");
        if let Some(next) = hop.next {
            let at = |speed: f64| energy(ratio, &HopperState::lift_off(speed));
            let difference = at(alpha) - at(next);
            assert!((difference - loss).abs() <= 1e-12 * at(alpha), "{difference} {loss}");
        }
    }
}
