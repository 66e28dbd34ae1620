//! What orbits of maps do: fates, diagrams, exponents, rotation numbers.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use crate::sections::strobe;
use equations::{Formulas, Names};
use hybrid_system::Equations;
use return_map::{
    DiagramColumn, EquationReturns, Error, FormulaMap, MapFamily, OrbitEnd, OrbitLength,
    PeriodicAttractor, Seeds, bifurcation_diagram, family, lyapunov_exponents, orbit_fate,
    orbit_fates, periodic_attractors, rotation_number, scalar_family,
};
use std::ops::ControlFlow::{Break, Continue};

/// A ball that is dropped anew once in three time units, seen at each bounce: its bounces are infinitely many in each of them. Orbits go on
/// behind their limit, and exponents say that there is none.
#[test]
fn infinitely_many_returns() {
    let ball = Equations::new(&["height", "speed", "drops"], &[("r", "0.3")])
        .mode_text("flight", &["speed", "-1", "0"])
        .falling_text("floor", "height")
        .resets_text(&["height", "-r*speed", "drops"])
        .rests("rest")
        .clock_text("drop", "3", "3")
        .resets_text(&["1/2", "0", "drops + 1"])
        .to("flight")
        .mode_text("rest", &["0", "0", "0"])
        .clock_text("drop again", "3", "3")
        .resets_text(&["1/2", "0", "drops + 1"])
        .to("flight");
    let map = EquationReturns::new(&ball, "r", ("flight", "floor"), &["v", "n"])
        .unwrap()
        .starting_text(&["0", "v", "n"])
        .unwrap()
        .coordinates_text(&["speed", "drops"])
        .unwrap();
    let exponents = lyapunov_exponents(&map, (&[0.3, 0.0], 0.3), 0, 2000);
    assert!(exponents.is_err(), "{exponents:?}");
}

/// Fates and diagrams have the same bits on one and on three threads.
#[cfg(feature = "parallel")]
#[test]
fn the_same_bits_on_any_number_of_threads() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let starts: Vec<Vec<f64>> = (1..200).map(|k| vec![f64::from(k) / 200.0]).collect();
    let parameters: Vec<f64> = (0..100).map(|k| 3.5 + 0.005 * f64::from(k)).collect();
    let length = OrbitLength { transient: 50, keep: 20 };
    let all = || {
        let seeds = &starts[..3];
        let diagrams = [Seeds::Fresh, Seeds::Carried].map(|from| {
            bifurcation_diagram(&logistic, &parameters, (seeds, from), length, |_| Continue(()))
        });
        (orbit_fates(&logistic, (&starts, 3.9), &[], 100, |_| Continue(())), diagrams)
    };
    let on = |threads: usize| {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(all)
    };
    assert_eq!(on(1), on(3));
}

/// A rod falls from the upright to one side or to the other, by events that end the run, after some returns.
#[test]
fn two_surfaces_that_end_a_run() {
    let rod = Equations::new(&["x", "v"], &[("p", "0")])
        .mode_text("falls", &["v", "x + p"])
        .rising_text("forward", "x - 1")
        .stops()
        .falling_text("back", "x + 1")
        .stops()
        .clock_text("strobe", "1", "1");
    let map = EquationReturns::new(&rod, "p", ("falls", "strobe"), &["x", "v"]).unwrap();
    let starts: Vec<Vec<f64>> = [0.5, 0.01, 1e-6, -1e-6, -0.01, 0.0].map(|x| vec![x, 0.0]).to_vec();
    let fates = orbit_fates(&map, (&starts, 0.0), &[], 50, |_| Continue(()));
    for (start, fate) in starts.iter().zip(&fates) {
        let fate = fate.as_ref().unwrap();
        if start[0] == 0.0 {
            assert_eq!((&fate.end, fate.images), (&OrbitEnd::Budget, 50));
            continue;
        }
        let side = if start[0] > 0.0 { "forward" } else { "back" };
        assert_eq!(fate.end, OrbitEnd::Terminal(side.to_owned()));
        // |x| cosh t = 1.
        let time = (1.0 / start[0].abs()).acosh();
        assert!((fate.time - time).abs() < 1e-9, "{fate:?}");
        assert_eq!(fate.images, time.floor() as usize);
    }
}

/// ln 2 of the logistic map at r = 4; of Hénon's map the sum is ln b, and the largest 0.4192.
#[test]
fn lyapunov_exponents_are_the_known_ones() {
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let found = lyapunov_exponents(&logistic, (&[0.3], 4.0), 100, 32_000).unwrap().per_image;
    assert!((found[0].value - 2f64.ln()).abs() < 5e-3, "{found:?}");
    // A cycle: the multiplier −0.5 of r = 2.5.
    let cycle = lyapunov_exponents(&logistic, (&[0.3], 2.5), 1000, 160).unwrap().per_image;
    assert!(
        (cycle[0].value - 0.5f64.ln()).abs() < 1e-10 && cycle[0].upper - cycle[0].lower < 1e-10
    );
    let names = Names::new(&["x", "y"], &[("a", "1.4"), ("b", "0.3")]).unwrap();
    let henon =
        FormulaMap::new(&Formulas::from_text(names, &["1 - a*x^2 + y", "b*x"]).unwrap(), "a")
            .unwrap();
    let found = lyapunov_exponents(&henon, (&[0.1, 0.1], 1.4), 100, 32_000).unwrap().per_image;
    assert!((found[0].value + found[1].value - 0.3f64.ln()).abs() < 1e-10, "{found:?}");
    assert!(found[0].lower < 0.4192 && 0.4192 < found[0].upper, "{found:?}");
    assert!(found[0].upper - found[0].lower < 0.04);
}

/// Carried seeds stay on their attractor: ẋ-like cubic map with two attractors, in both directions.
#[test]
fn diagrams_carry_their_seeds() {
    // x ↦ x + (p + x − x³)/5 has three fixed points for |p| < 2/√27.
    let map = scalar_family(|x, p| x + 0.2 * (p + x - x * x * x));
    let up: Vec<f64> = (0..=80).map(|k| -0.8 + 0.02 * f64::from(k)).collect();
    let length = OrbitLength { transient: 400, keep: 1 };
    let seeds = [vec![-1.0]];
    let last = |columns: &[DiagramColumn], k: usize| columns[k].orbits[0].as_ref().unwrap()[0][0];
    let carried =
        bifurcation_diagram(&map, &up, (&seeds, Seeds::Carried), length, |_| Continue(()));
    let down: Vec<f64> = up.iter().rev().copied().collect();
    let back =
        bifurcation_diagram(&map, &down, (&[vec![1.0]], Seeds::Carried), length, |_| Continue(()));
    // At p = 0 the branch below and the one above.
    assert!((last(&carried, 40) + 1.0).abs() < 1e-9 && (last(&back, 40) - 1.0).abs() < 1e-9);
    let both = [vec![-1.0], vec![1.0]];
    let fresh = bifurcation_diagram(&map, &[0.0], (&both, Seeds::Fresh), length, |_| Continue(()));
    let found: Vec<f64> =
        fresh[0].orbits.iter().map(|orbit| orbit.as_ref().unwrap()[0][0]).collect();
    assert!((found[0] + 1.0).abs() < 1e-9 && (found[1] - 1.0).abs() < 1e-9);
    // An orbit without an image is its own error, and the columns can be stopped.
    let gap = family(1, |x, p| match p < 0.5 {
        true => Ok(vec![0.5 * x[0]]),
        false => Err(Error::NoImage { point: x.to_vec(), parameter: p }),
    });
    let columns =
        bifurcation_diagram(&gap, &[0.0, 1.0], (&seeds, Seeds::Fresh), length, |_| Continue(()));
    assert!(columns[0].orbits[0].is_ok() && columns[1].orbits[0].is_err());
    let stopped = bifurcation_diagram(&map, &up, (&seeds, Seeds::Fresh), length, |_| Break(()));
    assert!(stopped.len() < up.len());
}

/// Nearby, two orbits of one attractor are one; a slow spiral is found once, and its seeds end there.
#[test]
fn attracting_orbits_have_traps() {
    // A rotation by 0.3 that shrinks by 0.997 at each image.
    let spiral = family(2, |x, _| {
        let (sin, cos) = 0.3f64.sin_cos();
        Ok(vec![0.997 * (cos * x[0] - sin * x[1]), 0.997 * (sin * x[0] + cos * x[1])])
    });
    let seeds: Vec<Vec<f64>> =
        (0..20).map(|k| vec![0.1 * f64::from(k) - 1.0, 0.05 * f64::from(k)]).collect();
    let found = periodic_attractors(&spiral, 0.0, &seeds, (100, 20), |_| Continue(()));
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].orbit.len(), 1);
    let ends = orbit_fates(&spiral, (&seeds, 0.0), &found, 10_000, |_| Continue(()));
    assert!(ends.iter().all(|end| end.as_ref().unwrap().end == OrbitEnd::Attractor(0)));
    // Two attractors and the saddle between them, which has no trap.
    let cubic = scalar_family(|x, p| x + 0.2 * (p + x - x * x * x));
    let seeds: Vec<Vec<f64>> = (0..9).map(|k| vec![0.25 * f64::from(k) - 0.99]).collect();
    let found = periodic_attractors(&cubic, 0.0, &seeds, (1000, 4), |_| Continue(()));
    assert_eq!(found.len(), 2);
    let saddle = PeriodicAttractor::new(&cubic, 1, (&[0.01], 0.0));
    assert!(matches!(saddle, Err(Error::NoTrap { .. })), "{saddle:?}");
    for (seed, end) in
        seeds.iter().zip(orbit_fates(&cubic, (&seeds, 0.0), &found, 1000, |_| Continue(())))
    {
        let OrbitEnd::Attractor(number) = end.unwrap().end else { panic!() };
        assert_eq!(found[number].orbit[0][0] > 0.0, seed[0] > 0.0);
    }
    // A cycle of period 4 that is asked for with 8 points has 4; chaos has none.
    let logistic = scalar_family(|x, r| r * x * (1.0 - x));
    let cycle = PeriodicAttractor::new(&logistic, 8, (&[0.5], 3.5)).unwrap();
    assert_eq!(cycle.orbit.len(), 4);
    assert!(
        periodic_attractors(&logistic, 3.9, &[vec![0.3]], (1000, 16), |_| Continue(())).is_empty()
    );
    assert_eq!(orbit_fate(&logistic, (&[0.3], 3.9), &[], 10).end, OrbitEnd::Budget);
}

/// A ball over two holes: one of them is deep. The end of an orbit has its surface, its time and its events.
#[test]
fn orbits_of_returns_end_at_surfaces() {
    // Each bounce keeps the part r of the speed; the ball drifts by 1 in a unit of time and falls over an edge at 3.
    let ball = Equations::new(&["x", "height", "speed"], &[("r", "0.5")])
        .mode_text("flight", &["1", "speed", "-1"])
        .falling_text("floor", "height")
        .resets_text(&["x", "0", "-r*speed"])
        .rising_text("edge", "x - 3")
        .stops();
    let bounces = EquationReturns::new(&ball, "r", ("flight", "floor"), &["x", "v"])
        .unwrap()
        .starting_text(&["x", "0", "v"])
        .unwrap()
        .coordinates_text(&["x", "speed"])
        .unwrap();
    // 2 v (1 + r + r² …) = 4 v for r = ½: from 0 the ball with v = 1 falls, that with v = 0.5 comes to rest.
    let fate = orbit_fate(&bounces, (&[0.0, 1.0], 0.5), &[], 1000);
    assert_eq!(fate.end, OrbitEnd::Terminal("edge".to_owned()));
    // Bounces at 2 and at 3: the second one comes with the edge. Up to rounding the last one counts or not.
    let fate = orbit_fate(&bounces, (&[0.2, 1.0], 0.5), &[], 1000);
    assert_eq!((fate.end, fate.images, fate.events), (OrbitEnd::Terminal("edge".to_owned()), 1, 2));
    assert!((fate.time - 2.8).abs() < 1e-12);
    let rest = orbit_fate(&bounces, (&[0.0, 0.5], 0.5), &[], 30);
    assert_eq!(rest.end, OrbitEnd::Budget);
    let zeno = orbit_fate(&bounces, (&[0.0, 0.5], 0.5), &[], 1000);
    assert!(zeno.end == OrbitEnd::Zeno && (zeno.time - 2.0).abs() < 1e-12, "{zeno:?}");
    // The return time and the events of one return.
    let image = bounces.image(&[0.0, 0.5], 0.5).unwrap();
    assert!((image.time - 1.0).abs() < 1e-13);
    assert_eq!(image.itinerary, ["flight: floor"]);
    // Thousands at once, as one by one, and they can be stopped.
    let starts: Vec<Vec<f64>> = (0..200).map(|k| vec![0.01 * f64::from(k), 0.7]).collect();
    let many = orbit_fates(&bounces, (&starts, 0.5), &[], 20, |_| Continue(()));
    for (start, fate) in starts.iter().zip(&many) {
        assert_eq!(fate.as_ref().unwrap(), &orbit_fate(&bounces, (start, 0.5), &[], 20));
    }
    let stopped = orbit_fates(&bounces, (&starts, 0.5), &[], 20, |_| Break(()));
    assert!(stopped.iter().any(Option::is_none));
}

/// The map of a flow over one period shrinks areas by e^(−2ζT): the exponents of the flow are −ζ.
#[test]
fn exponents_of_a_flow_through_events() {
    use example_systems::impact_oscillator::steady_start;
    let strobe = strobe();
    let [x, v, _] = steady_start(0.3);
    let found = lyapunov_exponents(&strobe, (&[x, v], 0.3), 1, 64).unwrap();
    let sum: f64 = found.per_time.iter().map(|exponent| exponent.value).sum();
    assert!((sum + 0.1).abs() < 1e-10, "{found:?}");
    assert!((found.mean_time - std::f64::consts::TAU / 1.3).abs() < 1e-12);
    // With impacts the area shrinks by e² at each: beyond grazing, at F = 0.5.
    let found = lyapunov_exponents(&strobe, (&[0.3, 0.2], 0.5), 200, 160).unwrap();
    let (mut at, mut hits) = (vec![0.3, 0.2], 0);
    for k in 0..360 {
        let image = strobe.image(&at, 0.5).unwrap();
        hits += if k < 200 { 0 } else { image.itinerary.len() - 1 };
        at = image.point;
    }
    let sum: f64 = found.per_time.iter().map(|exponent| exponent.value).sum();
    let exact = -0.1 + 2.0 * 0.8f64.ln() * f64::from(hits as u32) / (160.0 * found.mean_time);
    assert!(hits > 50 && (sum - exact).abs() < 1e-8, "{sum} {exact} {hits}");
}

/// The golden rotation, conjugated by a circle map; a locked one.
#[test]
fn rotation_numbers() {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    // h(θ) = θ + 0.1 sin 2πθ / 2π conjugates the rotation.
    let tau = std::f64::consts::TAU;
    let h = move |y: f64| y + 0.1 * (tau * y).sin() / tau;
    let inverse = move |x: f64| (0..60).fold(x, |y, _| x - 0.1 * (tau * y).sin() / tau);
    let circle = scalar_family(move |x, w| h(inverse(x) + w));
    let turns = |x: &[f64], image: &[f64]| image[0] - x[0];
    let found = rotation_number(&circle, (&[0.1], golden), 0, 2000, turns).unwrap();
    assert!((found.value - golden).abs() < 1e-12, "{found:?}");
    assert!(found.lower < golden && golden < found.upper);
    // Turns about a point: a linear spiral by 0.3 rad.
    let spiral = family(2, |x, _| {
        let (sin, cos) = 0.3f64.sin_cos();
        Ok(vec![cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]])
    });
    let angle =
        |x: &[f64], y: &[f64]| (x[0] * y[1] - x[1] * y[0]).atan2(x[0] * y[0] + x[1] * y[1]) / tau;
    let found = rotation_number(&spiral, (&[1.0, 0.0], 0.0), 0, 100, angle).unwrap();
    assert!((found.value - 0.3 / tau).abs() < 1e-14);
    assert!(rotation_number(&spiral, (&[1.0, 0.0], 0.0), 0, 0, angle).is_err());
    assert!(rotation_number(&spiral, (&[0.0, 0.0], 0.0), 0, 9, |_, _| f64::NAN).is_err());
}

/// The returns of a valve to its turning points become infinitely many in finite time. Image for image they would come nearer to the seat for
/// ever; the orbit passes the limit, rests, and is released.
#[test]
fn an_orbit_passes_zeno_limits() {
    let section = ("open", "turning point");
    let names = ["displacement", "pressure"];
    let valve = example_systems::valve::valve_equations();
    let returns = EquationReturns::new(&valve, "flow", section, &names)
        .unwrap()
        .tolerances(hybrid_system::Tolerances::both(1e-9));
    let (mut largest, mut count) = (0.0f64, 0);
    let mut see = |image: return_map::Image| {
        count += 1;
        if count > 200 {
            largest = largest.max(image.point[0]);
        }
        Continue(())
    };
    returns.orbit(&[0.001, 1.0], 0.2, 260, &mut see).unwrap();
    assert!(count == 260 && largest > 0.1, "{largest}");
    let mut point = vec![0.001, 1.0];
    for _ in 0..260 {
        point = returns.image(&point, 0.2).unwrap().point;
    }
    assert!(point[0] < 1e-20, "{point:?}");
}
