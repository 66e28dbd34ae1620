//! Linear fields of equations have their closed forms: their events are certain, and those that are none are integrated.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::DVector;
use std::f64::consts::PI;

/// Events of a run with their certainties.
fn events<const N: usize>(
    equations: &Equations,
    (mode, start, time): (&str, [f64; N], f64),
) -> Vec<(f64, Certainty)> {
    let model = equations.model::<State<N>>().unwrap();
    let arcs = model.start(mode, start, time).unwrap().map(Result::unwrap);
    arcs.filter_map(|arc| arc.event().map(|event| (event.time, event.certainty))).collect()
}

fn assert_times(found: &[(f64, Certainty)], exact: impl Fn(usize) -> f64, error: f64) {
    for (k, (time, _)) in found.iter().enumerate() {
        assert!((time - exact(k)).abs() <= error, "{k}: {time} {}", exact(k));
    }
}

fn all_certain(found: &[(f64, Certainty)]) -> bool {
    found.iter().all(|(_, certainty)| *certainty == Certainty::Certain)
}

#[test]
fn polynomials_exponentials_and_oscillators_are_certain() {
    let ball = Equations::new(&["x", "v"], &[("g", "1"), ("bounce", "0.5")])
        .mode("flight", |_, x, p| [x[1], -p["g"]])
        .falling("floor", |_, x, _| x[0])
        .resets(|_, x, p| [x[0], -p["bounce"] * x[1]]);
    let found = events(&ball, ("flight", [0.5, 0.0], 2.8));
    assert!(found.len() == 4 && all_certain(&found));
    assert_times(&found, |k| 3.0 - 2.0 * 0.5f64.powi(k as i32), 1e-14);

    let room = Equations::new(&["room"], &[("outside", "10"), ("heater", "20")])
        .mode("on", |_, x, p| [p["outside"] + p["heater"] - x[0]])
        .rising("warm", |_, x, _| x[0] - 21.0)
        .to("off")
        .mode("off", |_, x, p| [p["outside"] - x[0]])
        .falling("cold", |_, x, _| x[0] - 19.0)
        .to("on");
    let found = events(&room, ("on", [15.0], 4.0));
    let cycle = (11.0f64 / 9.0).ln();
    assert!(found.len() > 15 && all_certain(&found));
    assert_times(&found, |k| (15.0f64 / 9.0).ln() + k as f64 * cycle, 1e-13);

    // x″ + 2ζx′ + x = 0 from (1, 0), ζ = 0.1: x = 0 where tan ωt = −ω/ζ.
    let damped = Equations::new(&["x", "v"], &[("zeta", "0.1")])
        .mode("swing", |_, x, p| [x[1], -x[0] - 2.0 * p["zeta"] * x[1]])
        .either("zero", |_, x, _| x[0]);
    let found = events(&damped, ("swing", [1.0, 0.0], 40.0));
    let omega = 0.99f64.sqrt();
    assert!(found.len() == 13 && all_certain(&found));
    assert_times(&found, |k| (PI - (omega / 0.1).atan() + PI * k as f64) / omega, 1e-13);
}

/// A guard that is a product, along a chain of three components, with a polynomial and an exponential forcing.
#[test]
fn chains_of_components_with_forcing() {
    // z′ = −2z, y′ = −y + z + t, x′ = y.
    let chain = Equations::new(&["x", "y", "z"], &[])
        .mode("m", |t, x, _| [x[1], -x[1] + x[2] + t, -2.0 * x[2]])
        .either("product", |_, x, _| (x[0] - 1.0) * (x[1] - 0.4));
    let found = events(&chain, ("m", [0.0, 1.0, 1.0, 0.0], 9.0));
    assert!(all_certain(&found), "{found:?}");
    // z = e^(−2t), y = 3e^(−t) − e^(−2t) + t − 1, x = 5/2 − 3e^(−t) + e^(−2t)/2 + t²/2 − t.
    let y = |t: f64| 3.0 * (-t).exp() - (-2.0 * t).exp() + t - 1.0;
    let x = |t: f64| 2.5 - 3.0 * (-t).exp() + 0.5 * (-2.0 * t).exp() + 0.5 * t * t - t;
    assert_eq!(found.len(), 1);
    for (time, _) in &found {
        assert!(((x(*time) - 1.0) * (y(*time) - 0.4)).abs() < 1e-13, "{time}");
    }
}

/// Resonance and its neighbours: (cos ωt − cos t)/(1 − ω²), or t sin t/2.
#[test]
fn a_resonance_and_its_neighbours_are_right() {
    for omega in [1.0f64, 1f64.next_up(), 1f64.next_down(), 1.0 + 1e-9, 1.0 + 1e-4, 1.01, 1.7] {
        let forced = Equations::new(&["x", "v"], &[])
            .mode("m", move |t, x, _| [x[1], (omega * t).cos() - x[0]])
            .either("zero", |_, x, _| x[0]);
        let found = events(&forced, ("m", [0.0, 0.0, 0.0], 20.0));
        // The product form: t sin(at) sin(bt)/(…) with a = (1 + ω)/2: zeros at kπ/a while |b| t < π.
        let (a, b) = (0.5 * (1.0 + omega), 0.5 * (1.0 - omega).abs());
        let mut exact: Vec<f64> =
            (1..).map(|k| PI * f64::from(k) / a).take_while(|t| *t < 20.0).collect();
        exact.extend((1..).map(|k| PI * f64::from(k) / b).take_while(|t| *t < 20.0));
        exact.sort_by(f64::total_cmp);
        // At the resonance, and near it, it is integrated.
        assert_eq!(all_certain(&found), omega >= 1.01, "{omega}");
        // Double zeros are touches, which this guard does not have at these frequencies.
        assert_eq!(found.len(), exact.len(), "{omega}: {found:?} {exact:?}");
        assert_times(&found, |k| exact[k], 2e-9);
    }
}

/// A forced oscillator first meets a stop where its amplitude F/√((1 − ω²)² + (2ζω)²) is the gap.
#[test]
fn the_first_grazing_is_where_the_amplitude_is_the_gap() {
    let (force, omega, zeta) = (1.0f64, 0.8f64, 0.05f64);
    let (stiff, damped) = (1.0 - omega * omega, 2.0 * zeta * omega);
    let amplitude = force / stiff.hypot(damped);
    let phase = damped.atan2(stiff);
    for (part, impacts) in [(1.0 + 1e-9, 0), (1.0 - 1e-9, 5)] {
        let gap = part * amplitude;
        let oscillator = Equations::new(&["x", "v"], &[("zeta", "0.05")])
            .mode("m", |t, x, p| [x[1], (0.8 * t).cos() - x[0] - 2.0 * p["zeta"] * x[1]])
            .rising("stop", |_, x, _| x[0] - gap);
        let start = [amplitude * phase.cos(), amplitude * omega * phase.sin(), 0.0];
        let found = events(&oscillator, ("m", start, 5.0 * 2.0 * PI / omega));
        assert!(found.len() == impacts && all_certain(&found), "{part}: {found:?}");
    }
}

/// Critical damping and its neighbours: x = (1 + (1 + v₀)t)e^(−t) has its zero at −1/(1 + v₀).
#[test]
fn critical_damping_and_its_neighbours_are_right() {
    for damping in [2.0, 2f64.next_up(), 2f64.next_down(), 2.0 + 1e-9] {
        let oscillator = Equations::new(&["x", "v"], &[])
            .mode("m", move |_, x, _| [x[1], -x[0] - damping * x[1]])
            .falling("zero", |_, x, _| x[0]);
        let found = events(&oscillator, ("m", [1.0, -3.0], 30.0));
        assert_eq!(found.len(), 1, "{damping}");
        // Beside the double root the motion is integrated.
        assert_eq!(all_certain(&found), damping == 2.0, "{damping}");
        assert!((found[0].0 - 0.5).abs() < 1e-8, "{damping}: {found:?}");
    }
    let exact = Equations::new(&["x", "v"], &[])
        .mode("m", |_, x, _| [x[1], -x[0] - 2.0 * x[1]])
        .falling("zero", |_, x, _| x[0]);
    let found = events(&exact, ("m", [1.0, -3.0], 30.0));
    assert!(all_certain(&found) && (found[0].0 - 0.5).abs() < 1e-15);
}

/// The same oscillator with a stop, in closed form and integrated: a component that stays zero makes the field no linear
/// one.
#[test]
fn closed_forms_and_integration_agree() {
    let closed = Equations::new(&["x", "v"], &[])
        .mode("m", |t, x, _| [x[1], (1.3 * t).cos() - x[0] - 0.1 * x[1]])
        .rising("stop", |_, x, _| x[0] - 0.5)
        .resets(|_, x, _| [x[0], -0.8 * x[1]]);
    let other = Equations::new(&["x", "v", "z"], &[])
        .mode("m", |t, x, _| [x[1], (1.3 * t).cos() - x[0] - 0.1 * x[1], x[2] * x[2]])
        .rising("stop", |_, x, _| x[0] - 0.5)
        .resets(|_, x, _| [x[0], -0.8 * x[1], x[2]]);
    let a = events(&closed, ("m", [0.0, 1.0, 0.0], 60.0));
    let b = events(&other, ("m", [0.0, 1.0, 0.0, 0.0], 60.0));
    assert!(a.len() > 8 && a.len() == b.len());
    assert!(all_certain(&a));
    assert!(b.iter().all(|(_, certainty)| *certainty == Certainty::Interpolated));
    for ((first, _), (second, _)) in a.iter().zip(&b) {
        assert!((first - second).abs() < 1e-10, "{first} {second}");
    }
}

/// A guard that is no quasi-polynomial, or a closure, is searched along the integrated motion.
#[test]
fn other_guards_are_searched_on_steps() {
    let circle = Equations::new(&["x", "v"], &[])
        .mode("turn", |_, x, _| [x[1], -x[0]])
        .either("root", |_, x, _| (x[0] + 2.0).sqrt() - 1.5)
        .either("zero", |_, x, _| x[1]);
    let found = events(&circle, ("turn", [1.0, 0.5], 10.0));
    assert!(found.len() > 4);
    assert!(found.iter().all(|(_, certainty)| *certainty == Certainty::Interpolated));
}

/// A field with the same motion, in closed form and with a component that makes it none.
fn ends(field: &[&str], states: &[&str], start: &[f64], time: f64) -> [DVector<f64>; 2] {
    let run = |field: &[&str], states: &[&str], start: Vec<f64>| {
        let model = Equations::new(states, &[]).mode_text("m", field);
        let model = model.model::<DVector<f64>>().unwrap();
        let mut run = model.start("m", DVector::from_vec(start), time).unwrap();
        run.by_ref().for_each(|arc| drop(arc.unwrap()));
        run.state().clone()
    };
    // The time comes behind the components that have names.
    let mut longer = start.to_vec();
    longer.insert(states.len(), 0.0);
    let (field_with, states_with) = ([field, &["w^2"]].concat(), [states, &["w"]].concat());
    [run(field, states, start.to_vec()), run(&field_with, &states_with, longer)]
}

/// A small root beside a large forcing: the terms of the closed form are large and cancel. The motion is integrated then.
#[test]
fn closed_forms_that_cancel_are_integrated() {
    // i = R(1 − e^(−t/R)), q = t²/2 − t³/(6R) + …
    for r in ["1e7", "1e6", "1e5", "8388608"] {
        let circuit = Equations::new(&["q", "i"], &[("R", r)])
            .mode_text("m", &["i", "1 - i/R"])
            .rising_text("full", "q - 2");
        let found = events(&circuit, ("m", [0.0, 0.0], 5.0));
        let resistance: f64 = r.parse().unwrap();
        let exact = 2.0 + 4.0 / (6.0 * resistance);
        assert!(found.len() == 1 && (found[0].0 - exact).abs() < 1e-9, "{r}: {found:?} {exact}");
    }
    // A fall with a little drag lands, and bounces as often as its integration says.
    for drag in ["1e-8", "1e-6", "1e-4", "1e-3"] {
        let ball = |field: &[&str], states: &[&str], after: &[&str]| {
            Equations::new(states, &[("c", drag)])
                .mode_text("m", field)
                .falling_text("floor", "h")
                .resets_text(after)
        };
        let closed = ball(&["v", "-9.81 - c*v"], &["h", "v"], &["h", "-0.8*v"]);
        let other = ball(&["v", "-9.81 - c*v", "w^2"], &["h", "v", "w"], &["h", "-0.8*v", "w"]);
        let a = events(&closed, ("m", [1.0, 0.0], 3.5));
        let b = events(&other, ("m", [1.0, 0.0, 0.0], 3.5));
        assert!(a.len() == b.len() && a.len() > 8, "{drag}: {a:?} {b:?}");
        for ((a, _), (b, _)) in a.iter().zip(&b) {
            assert!((a - b).abs() < 1e-10, "{drag}: {a} {b}");
        }
    }
    for (field, states, start, time) in [
        (&["1e-9*z + t^2"][..], &["z"][..], &[0.5, 0.0][..], 1.0),
        (&["1e-4*z + t^3"], &["z"], &[0.5, 0.0], 1.0),
        (&["1e-12*z + 1"], &["z"], &[0.5], 1.0),
        (&["x - 1e-9*y", "-0.5*x - 1e-9*y + t"], &["x", "y"], &[2.0, 0.0, 0.0], 5.0),
        (&["1e-3*x + 3*y + t", "-1e-9*x + 1e-3*y + t^2"], &["x", "y"], &[-0.471, 1.663, 0.0], 1.0),
        (&["-9.81 - 1e-8*v", "v"], &["v", "h"], &[0.0, 100.0], 4.0),
    ] {
        let [closed, other] = ends(field, states, start, time);
        for axis in 0..states.len() {
            let (a, b) = (closed[axis], other[axis]);
            assert!((a - b).abs() < 1e-10 * (1.0 + b.abs()), "{field:?}: {a} {b}");
        }
    }
}

/// What has no value has none in closed form: the derivative of `0*sqrt(x)` is zero, its value below zero is not.
#[test]
fn no_closed_form_leaves_the_domain() {
    let model = Equations::new(&["x"], &[]).mode_text("m", &["1 + 0*sqrt(x)"]);
    let model = model.model::<State<1>>().unwrap();
    let failed = model.start("m", [-1.0], 3.0).unwrap().find_map(Result::err);
    assert!(failed.unwrap().to_string().contains("sqrt(x)"));
    // A power of a high degree takes no time.
    let high = Equations::new(&["x"], &[]).mode_text("m", &["t^100000"]);
    let arc = high.model::<State<2>>().unwrap().start("m", [0.0, 0.0], 0.5).unwrap().next();
    assert!(arc.unwrap().is_ok());
}

/// The fields and guards of random linear models.
const RATES: [&str; 8] = ["0", "-0.5", "-1", "-0.1", "0.2", "-2", "1e-9", "-1e-5"];
const FORCING: [&str; 8] =
    ["0", "1", "cos(t)", "sin(1.3*t)", "0.3*t", "exp(-0.5*t)", "t*exp(-t)", "cos(t)^2"];
const GUARDS: [&str; 6] = ["x - 0.3", "x*y - 0.1", "y", "x - cos(t)", "z - 0.2*x", "x*x - 0.5"];

proptest::proptest! {
    #![proptest_config(proptest::prelude::ProptestConfig::with_cases(64))]

    /// A chain of three components, or an oscillator that the third one drives: in closed form and integrated.
    #[test]
    fn random_linear_models_have_the_events_of_their_integration(
        own in proptest::array::uniform3(proptest::sample::select(&RATES[..])),
        forcing in proptest::array::uniform3(proptest::sample::select(&FORCING[..])),
        guard in proptest::sample::select(&GUARDS[..]),
        oscillates: bool,
        start in proptest::array::uniform3(-1.0..1.0f64),
        time in proptest::sample::select(vec![0.0, 3.7]),
    ) {
        let [first, second] = match oscillates {
            true => ["y".to_owned(), format!("-1.69*x + ({})*y + 0.1*z + {}", own[1], forcing[1])],
            false => [
                format!("({})*x + y + {}", own[0], forcing[0]),
                format!("({})*y + z + {}", own[1], forcing[1]),
            ],
        };
        // The time is a component, also where no forcing needs it.
        let third = format!("({})*z + {} + 0*t", own[2], forcing[2]);
        let closed = Equations::new(&["x", "y", "z"], &[])
            .mode_text("m", &[&first, &second, &third])
            .either_text("g", guard);
        let integrated = Equations::new(&["x", "y", "z", "w"], &[])
            .mode_text("m", &[&first, &second, &third, "w^2"])
            .either_text("g", guard);
        let [x, y, z] = start;
        let a = events(&closed, ("m", [x, y, z, time], 12.0));
        let b = events(&integrated, ("m", [x, y, z, 0.0, time], 12.0));
        proptest::prop_assert_eq!(a.len(), b.len(), "{:?} {:?}", a, b);
        for ((a, _), (b, _)) in a.iter().zip(&b) {
            proptest::prop_assert!((a - b).abs() < 1e-7, "{} {}", a, b);
        }
    }
}
