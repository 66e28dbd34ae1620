//! Periodic orbits that exist, of models without closed forms.

use crate::models::{map_of, oscillator};
use equations::{Formulas, Names};
use example_systems::impact_oscillator::impact_oscillator;
use hybrid_system::Equations;
use validated_dynamics::{
    EnclosedMap, Enclosure, FormulaMap, Reason, SectionMap, ValidatedSystem, fixed_point,
};

/// CAPD's proof has y near −8.3809417428298 and z near 0.029590060630665.
#[test]
fn rossler_has_the_orbit_of_period_one() {
    let rossler = Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
        .mode_text("flow", &["-y - z", "x + a*y", "b + z*(x - c)"])
        .rising_text("section", "x");
    let system = ValidatedSystem::new(&rossler).unwrap();
    let chart = system.chart("flow", &["y", "z"], &["0", "y", "z"]).unwrap();
    let map = SectionMap::new(&system, chart, "section", 1, &["y", "z"]).unwrap();
    let orbit = fixed_point(&map, &[-8.38, 0.0296], &[]).unwrap();
    assert!(orbit.point[0].widened(1e-13).contains(-8.380_941_742_829_8));
    assert!(orbit.point[1].widened(1e-14).contains(0.029_590_060_630_665));
    assert!(orbit.point.iter().all(|x| x.width() < 2e-12));
    assert!(orbit.is_saddle() && !orbit.is_attracting());
    let stretching = orbit.multipliers[1].real().unwrap();
    assert!(stretching.contains(-2.403_953_5) || (stretching.middle() + 2.403_953_5).abs() < 1e-6);
}

/// ẍ + 0.1ẋ + x = cos 1.3t with a stop at 0.5 and restitution 0.8. Its orbit with one impact is computed by hand: between impacts
/// x = A cos(1.3t − φ) + a transient, and the two unknowns follow from the impact law.
#[test]
fn an_impact_oscillator_has_a_stable_orbit_also_for_an_interval_of_forcings() {
    let oscillator = impact_oscillator("1");
    let period = 2.0 * std::f64::consts::PI / 1.3;
    let system = ValidatedSystem::new(&oscillator).unwrap();
    let chart = system.chart("free", &["v", "s"], &["stop", "v", "s"]).unwrap();
    let map = SectionMap::new(&system, chart, "stop", 1, &["v", "t - 2*pi/frequency"]).unwrap();
    let orbit = fixed_point(&map, &[-1.48, 0.16], &[]).unwrap();
    assert!(orbit.is_attracting() && orbit.point.iter().all(|x| x.width() < 1e-12));
    assert!(orbit.image.events[0].time.contains(period));
    // The same numbers as the integrator's, to its tolerance.
    let model = oscillator.model::<nalgebra::DVector<f64>>().unwrap();
    let start = nalgebra::DVector::from_vec(vec![0.0, 1.0, 0.0]);
    let mut speed = 0.0;
    for arc in model.start("free", start, 600.0).unwrap() {
        let arc = arc.unwrap();
        speed = arc.event().and_then(|event| event.after.clone()).map_or(speed, |after| after.1[1]);
    }
    assert!((orbit.point[0].middle() - speed).abs() < 1e-8);

    let system = ValidatedSystem::with_interval_parameters(&oscillator, &["forcing"]).unwrap();
    let chart =
        system.chart("free", &["v", "s", "forcing"], &["stop", "v", "s", "forcing"]).unwrap();
    let map = SectionMap::new(&system, chart, "stop", 1, &["v", "t - 2*pi/frequency"]).unwrap();
    let orbits = fixed_point(&map, &[-1.48, 0.16], &[Enclosure::new(0.999, 1.001)]).unwrap();
    assert!(orbits.is_attracting());
    assert!(orbit.point[0].is_inside(&orbits.point[0]));
}

#[test]
fn multipliers_follow_the_trace_and_the_determinant() {
    // Hénon's map: at the fixed point x the multipliers have the sum −2ax and the product −b.
    let names = Names::new(&["x", "y"], &[("a", "1.4"), ("b", "0.3")]).unwrap();
    let henon = Formulas::from_text(names, &["1 - a*x^2 + y", "b*x"]).unwrap();
    let found = fixed_point(&FormulaMap::new(henon, 1).unwrap(), &[0.6, 0.2], &[]).unwrap();
    let x = found.point[0].middle();
    let (first, second) =
        (found.multipliers[0].real().unwrap(), found.multipliers[1].real().unwrap());
    assert!((first + second).widened(1e-14).contains(-2.8 * x));
    assert!((first * second).widened(1e-14).contains(-0.3));
    assert!(found.is_saddle());
}

#[test]
fn a_doubled_orbit_lies_between_two_parameters() {
    // x → r x (1 − x): the multiplier of the fixed point is 2 − r, and passes −1 at r = 3.
    let multiplier = |r: &str| {
        let names = Names::new(&["x"], &[("r", r)]).unwrap();
        let map = Formulas::from_text(names, &["r*x*(1 - x)"]).unwrap();
        let found = fixed_point(&FormulaMap::new(map, 1).unwrap(), &[0.66], &[]).unwrap();
        found.multipliers[0].real().unwrap()
    };
    assert!(multiplier("2.999999999").low() > -1.0);
    assert!(multiplier("3.000000001").high() < -1.0);
}

/// At a point of rest that is a pair of doubles nothing moves, and the velocity is 0 exactly.
#[test]
fn a_guess_may_be_a_point_of_rest_exactly() {
    let oscillator = Equations::new(&["x", "v"], &[])
        .mode_text("flow", &["v", "1 - x - 0.7*v"])
        .rising_text("later", "t - 2");
    let system = ValidatedSystem::new(&oscillator).unwrap();
    let start = system.chart("flow", &["x", "v"], &["x", "v", "0"]).unwrap();
    let map = SectionMap::new(&system, start, "later", 1, &["x", "v"]).unwrap();
    let rest = fixed_point(&map, &[1.0, 0.0], &[]).unwrap();
    assert!(rest.is_attracting() && rest.point[0].contains(1.0) && rest.point[1].contains(0.0));
}

#[test]
fn what_is_no_fixed_point_is_not_proved() {
    let names = Names::new(&["x"], &[]).unwrap();
    let map = |text: &str| {
        FormulaMap::new(Formulas::from_text(names.clone(), &[text]).unwrap(), 1).unwrap()
    };
    let reason = |text: &str, guess: f64| {
        let error = fixed_point(&map(text), &[guess], &[]).unwrap_err();
        error.undecided().unwrap().reason.clone()
    };
    // x² + ½ lies above the diagonal.
    assert!(matches!(reason("x^2 + 0.5", 0.4), Reason::NoPoint { .. } | Reason::Singular));
    // x + x³ touches it with the multiplier 1.
    assert!(matches!(
        reason("x + x^3", 1e-3),
        Reason::NotInside { .. } | Reason::NoPoint { .. } | Reason::Singular
    ));
    assert_eq!(reason("x", 0.3), Reason::Singular);
    assert!(map("x").image(&[Enclosure::new(0.0, f64::NAN)]).is_err());
    assert!(fixed_point(&map("x/2"), &[f64::NAN], &[]).is_err());
    assert!(fixed_point(&map("x/2"), &[], &[]).is_err());
}

#[test]
fn a_map_is_stopped_by_its_caller() {
    let system = ValidatedSystem::new(&oscillator().rising_text("section", "x")).unwrap();
    let chart = system.chart("flow", &["v"], &["0", "v"]).unwrap();
    let stop = || true;
    let map = SectionMap::new(&system, chart, "section", 1, &["v"]).unwrap().stopped_by(&stop);
    let error = map.image(&[Enclosure::from(1.0)]).unwrap_err();
    assert_eq!(error.undecided().unwrap().reason, Reason::Interrupted);
}

/// Beside a coordinate that the map contracts to second order, another one that is exactly 0.
#[test]
fn a_fixed_point_with_a_superattracting_coordinate_and_a_zero_is_proved() {
    let map = map_of(&["x", "y"], &["1.5*x - 0.5*x^3", "y/2"]);
    let found = fixed_point(&map, &[0.9, 0.0], &[]).unwrap();
    assert!(found.point[0].contains(1.0) && found.point[1].contains(0.0));
    assert!(found.point.iter().all(|x| x.width() < 1e-14) && found.is_attracting());
}
