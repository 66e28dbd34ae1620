//! Models of equations: their events, files and derivatives, against known answers.

#![cfg(feature = "ode")]

use hybrid_system::*;
use nalgebra::DVector;
use std::f64::consts::{PI, TAU};

/// Times of the events of a run, with their surfaces.
fn events<X: StateVector + Start<X>>(
    equations: &Equations,
    tolerance: f64,
    (mode, start, time): (&str, X, f64),
) -> Vec<(String, f64)> {
    let model = equations.model::<X>().unwrap().tolerance(tolerance);
    let arcs = model.start(mode, start, time).unwrap().map(Result::unwrap);
    arcs.filter_map(|arc| arc.event().map(|event| (event.surface.to_string(), event.time)))
        .collect()
}

fn pendulum() -> Equations {
    Equations::new(&["angle", "speed"], &[])
        .mode("swing", |_, x, _| [x[1], -x[0].sin()])
        .falling("top", |_, x, _| x[1])
}

/// From rest at 1 rad: 4 K(sin ½) (mpmath).
#[test]
fn a_pendulum_comes_back_after_its_periods() {
    for tolerance in [1e-6, 1e-9, 1e-12, 1e-14] {
        let found = events(&pendulum(), tolerance, ("swing", State::from([1.0, 0.0]), 70.0));
        assert_eq!(found.len(), 10);
        for (k, (_, time)) in found.iter().enumerate() {
            let off = time - 6.699_975_664_370_453 * (k + 1) as f64;
            assert!(off.abs() < 200.0 * tolerance + 1e-13, "{tolerance:e} {k}: {off:e}");
        }
    }
}

/// ẍ + 0.1ẋ + x = cos 1.3t with a stop at ½, restitution 0.8: the last of 83 impacts up to t = 400 comes at
/// 396.4881294366 by two other programs.
#[test]
fn a_forced_oscillator_meets_its_stop() {
    let oscillator = Equations::new(&["x", "v"], &[("forcing", "1.3"), ("restitution", "0.8")])
        .mode("free", |t, x, p| [x[1], (p["forcing"] * t).cos() - x[0] - 0.1 * x[1]])
        .rising("stop", |_, x, _| x[0] - 0.5)
        .resets(|_, x, p| [x[0], -p["restitution"] * x[1]]);
    for tolerance in [1e-10, 1e-12, 1e-14] {
        let found = events(&oscillator, tolerance, ("free", State::from([0.0, 1.0, 0.0]), 400.0));
        assert_eq!(found.len(), 83);
        let off = found[82].1 - 396.488_129_436_6;
        assert!(off.abs() < 1e-10 + 1e3 * tolerance, "{tolerance:e}: {off:e}");
    }
}

/// Dips inside one step of any length: the step is as long as the motion, which is a line.
#[test]
fn no_dip_inside_a_step_is_missed() {
    for depth in [1.0, 1e-3, 1e-6, 1e-9] {
        let line = Equations::new(&["x"], &[])
            .mode("line", |_, x, _| [x[0].number(1.0)])
            .falling("in", move |_, x, _| (x[0] - 3.37).powi(2) - depth)
            .rising("out", move |_, x, _| (x[0] - 3.37).powi(2) - depth);
        let found = events(&line, 1e-9, ("line", State::from([0.0]), 1000.0));
        let half = f64::sqrt(depth);
        assert_eq!(found.len(), 2, "{depth:e}");
        for ((surface, time), (name, exact)) in
            found.iter().zip([("in", 3.37 - half), ("out", 3.37 + half)])
        {
            assert_eq!(surface, name);
            assert!((time - exact).abs() < 1e-14 / half + 1e-15, "{depth:e}: {time}");
        }
    }
}

/// A guard that bends where the state does not: sin x along x = t, to t = 100. Also as a closure.
#[test]
fn guards_may_bend_more_than_the_state() {
    let line = Equations::new(&["x"], &[])
        .mode("line", |_, x, _| [x[0].number(1.0)])
        .either("sine", |_, x, _| (3.0 * x[0] + 1.0).sin());
    let found = events(&line, 1e-12, ("line", State::from([0.0]), 100.0));
    assert_eq!(found.len(), 95);
    for (k, (_, time)) in found.iter().enumerate() {
        let off = 3.0 * time + 1.0 - PI * (k + 1) as f64;
        assert!(off.abs() < 1e-11, "{k} {off:e}");
    }
    let closure = Equations::new(&["x", "v"], &[])
        .mode("turn", |_, x, _| [x[1], -x[0]])
        .model::<State<2>>()
        .unwrap()
        .guard(
            Label::new("turn").unwrap(),
            Guard::either(Label::new("up").unwrap()),
            |x| x[0],
            |x| (Label::new("turn").unwrap(), *x),
        );
    let times = closure.start("turn", [0.5, 0.5], 100.0).unwrap().map(Result::unwrap);
    let times: Vec<f64> = times.filter_map(|arc| Some(arc.event()?.time)).collect();
    assert_eq!(times.len(), 32);
    for (k, time) in times.iter().enumerate() {
        assert!((time - 0.75 * PI - PI * k as f64).abs() < 1e-10, "{k}: {time}");
    }
}

/// Kepler's orbit with e = 0.6: at its apocentres.
#[test]
fn a_planet_passes_its_apocentres() {
    let names = ["x", "y", "u", "v"];
    let kepler = Equations::new(&names, &[])
        .mode_text("orbit", &["u", "v", "-x/(x^2 + y^2)^1.5", "-y/(x^2 + y^2)^1.5"])
        .falling_text("apocentre", "x*u + y*v");
    let found =
        events(&kepler, 1e-13, ("orbit", DVector::from_vec(vec![0.4, 0.0, 0.0, 2.0]), 40.0));
    assert_eq!(found.len(), 6);
    for (k, (_, time)) in found.iter().enumerate() {
        assert!((time - PI * (2 * k + 1) as f64).abs() < 1e-11, "{k}: {time}");
    }
}

/// A ball on a floor, with its Zeno limit at 3 times the fall, and rest behind it.
#[test]
fn a_ball_comes_to_rest() {
    let ball = Equations::new(&["height", "speed"], &[("restitution", "0.5")])
        .mode("flight", |_, x, _| [x[1], x[0].number(-1.0)])
        .falling("floor", |_, x, _| x[0])
        .resets(|_, x, p| [x[0], -p["restitution"] * x[1]])
        .rests("floor")
        .mode("floor", |_, x, _| [x[0].number(0.0), x[0].number(0.0)]);
    let model = ball.model::<State<2>>().unwrap();
    let mut arcs = model.start("flight", [0.5, 0.0], 9.0).unwrap();
    let arcs: Vec<_> = arcs.by_ref().collect::<Result<_, _>>().unwrap();
    let limit = arcs.iter().find_map(|arc| match &arc.end {
        ArcEnd::Zeno { limit, .. } => Some(limit.time),
        _ => None,
    });
    assert!((limit.unwrap() - 3.0).abs() < 1e-9, "{limit:?}");
    assert_eq!(arcs.last().unwrap().mode, "floor");
}

/// A ball comes to rest on a belt of the speed 2, which takes it away. A file says the same. A root of a negative number
/// is an error.
#[test]
fn a_rest_may_have_a_state_of_its_own() {
    let belt = |root: f64| {
        Equations::new(&["height", "speed", "place", "along"], &[])
            .mode("flight", |t, x, _| [x[1], t.number(-1.0), x[3], t.number(0.0)])
            .falling("floor", |_, x, _| x[0])
            .resets(|t, x, _| [t.number(0.0), -0.5 * x[1], x[2], x[3]])
            .rests_at("belt", move |t, x, _| {
                [t.number(0.0), t.number(0.0), x[2], t.number(root).sqrt()]
            })
            .mode("belt", |t, x, _| [t.number(0.0), t.number(0.0), x[3], t.number(0.0)])
    };
    let read = Equations::from_json(&belt(4.0).to_json().unwrap()).unwrap();
    assert_eq!(read, belt(4.0));
    let model = read.model::<State<4>>().unwrap();
    let last = model.start("flight", [0.5, 0.0, 0.0, 1.0], 9.0).unwrap().last().unwrap().unwrap();
    // Three units of time at the speed 1, six at 2.
    assert_eq!(last.mode, "belt");
    let end = last.state(&model, last.duration).unwrap();
    assert!((end[2] - 15.0).abs() < 1e-9, "{end:?}");
    let refused = belt(-4.0).model::<State<4>>();
    let error = match refused {
        Err(error) => Some(error),
        Ok(model) => {
            model.start("flight", [0.5, 0.0, 0.0, 1.0], 9.0).unwrap().find_map(Result::err)
        }
    };
    let message = error.unwrap().to_string();
    assert!(message.contains("sqrt"), "{message}");
}

/// The limits on time of models in which the time is a component, and a motion backward.
#[test]
fn motions_go_back() {
    let forced = Equations::new(&["x"], &[]).mode("m", |t, x, _| [t.sin() * x[0]]);
    let model = forced.model::<State<2>>().unwrap().tolerance(1e-14);
    let mode = Label::new("m").unwrap();
    let exact = |x: f64, from: f64, to: f64| x * (from.cos() - to.cos()).exp();
    for (from, time) in [(0.0, 5.0), (2.0, -7.0), (1e6, 3.0)] {
        let there = model.flow(mode, &State::from([2.0, from]), time);
        assert_eq!(there[1], from + time);
        let tolerance = 1e-13 + 1e-15 * f64::abs(from);
        assert!((there[0] - exact(2.0, from, from + time)).abs() < tolerance, "{from} {there}");
        let back = model.flow(mode, &there, -time);
        assert!((back[0] - 2.0).abs() < 2.0 * tolerance, "{back}");
    }
    let states = model.flow_at(mode, &State::from([1.0, 0.0]), &[0.0, 1.0, 1.0, 4.0]).unwrap();
    for (state, time) in states.iter().zip([0.0, 1.0, 1.0, 4.0]) {
        assert!((state[0] - exact(1.0, 0.0, time)).abs() < 1e-13);
    }
}

/// Text, closures and files are the same equations. A parameter is changed by its name.
#[test]
fn texts_closures_and_files_are_equal() {
    let parameters = [("mu", "5"), ("level", "0.2")];
    let closures = Equations::new(&["x", "v"], &parameters)
        .either("observed", |_, x, _| x[1])
        .mode("slow", |_, x, p| [x[1], p["mu"] * (1.0 - x[0] * x[0]) * x[1] - x[0]])
        .rising("level", |_, x, p| x[0] - p["level"])
        .touch(Touch::Ignore)
        .to("fast")
        .resets(|t, x, _| [x[0], x[1] + t])
        .mode("fast", |_, x, _| [x[1], -x[0]])
        .falling("end", |_, x, _| x[0] + 1.0)
        .contact()
        .stops();
    let texts = Equations::new(&["x", "v"], &parameters)
        .either_text("observed", "v")
        .mode_text("slow", &["v", "mu*(1 - x*x)*v - x"])
        .rising_text("level", "x - level")
        .touch(Touch::Ignore)
        .to("fast")
        .resets_text(&["x", "v + t"])
        .mode_text("fast", &["v", "-x"])
        .falling_text("end", "x + 1")
        .contact()
        .stops();
    // Numbers of closures are doubles, those of texts decimals.
    let read = Equations::from_json(&texts.to_json().unwrap()).unwrap();
    assert_eq!(read, texts);
    let start = ("slow", State::from([0.0, 1.0, 0.5]), 9.0);
    let [a, b, c] = [&closures, &texts, &read].map(|equations| events(equations, 1e-12, start));
    assert_eq!(a, b);
    assert_eq!(b, c);
    assert_eq!(a.first().unwrap().0, "level");
    assert_eq!(a.last().unwrap().0, "end");
    let other = read.with_parameters(&[("level", "0.3")]);
    assert!(events(&other, 1e-12, start)[0].1 > a[0].1);
}

/// The name of the variable by which the second process finds the file.
const FILE: &str = "EQUATIONS_OF_ANOTHER_PROCESS";

fn run_bits(equations: &Equations) -> String {
    let found = events(equations, 1e-12, ("swing", State::from([1.0, 0.3]), 40.0));
    found.iter().map(|(_, time)| format!("{:016x}", time.to_bits())).collect()
}

/// Writes a model, and runs this test program again: it reads the model and prints the bits of its events.
#[test]
fn another_process_runs_the_same_bits() {
    if let Ok(file) = std::env::var(FILE) {
        println!("bits {}", run_bits(&Equations::from_json(&file).unwrap()));
        return;
    }
    let model = pendulum();
    let program = std::env::current_exe().unwrap();
    let name = "equation_models::another_process_runs_the_same_bits";
    let output = std::process::Command::new(program)
        .args(["--exact", name, "--nocapture"])
        .env(FILE, model.to_json().unwrap())
        .output()
        .unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let bits = text.lines().find_map(|line| line.split("bits ").nth(1)).unwrap();
    assert_eq!(bits, run_bits(&model));
    assert_eq!(bits.len() % 16, 0);
}

/// A bump of a guard that shows neither in its series nor where the series is tested: a look often enough finds it.
#[test]
fn looks_at_guards_find_what_their_series_hide() {
    let bumps =
        ["1 - 2*exp(-((x - 2.4734)/0.05616)^2)", "tanh((x - 2.98)/0.06)*tanh((x - 3.17)/0.06)"];
    for bump in bumps {
        let model = Equations::new(&["x", "y"], &[]).mode_text("m", &["1", "y*y*0"]);
        let model = model.either_text("bump", bump).model::<State<2>>().unwrap();
        let looked = Tolerances::both(1e-12).check_interval(0.02);
        let model = model.tolerances(looked);
        let arcs = model.start("m", [0.0, 0.0], 10.0).unwrap();
        assert_eq!(arcs.filter(|arc| arc.as_ref().unwrap().event().is_some()).count(), 2, "{bump}");
    }
}

#[test]
fn files_of_any_bytes_are_safe() {
    let good = pendulum().to_json().unwrap();
    for cut in (0..good.len()).step_by(7) {
        assert!(Equations::from_json(&good[..cut]).is_err());
    }
    for (from, to) in [
        ("\"version\":1", "\"version\":2"),
        ("hybrid equations", "equations"),
        ("\"falling\"", "\"down\""),
        ("\"name\":\"swing\"", "\"name\":7"),
        ("\"guards\":[", "\"guards\":[null,"),
        ("\"jump\":{}", "\"jump\":{\"mode\":\"none\"}"),
        ("\"outputs\":[", "\"outputs\":[99,"),
        ("\"states\":[\"angle\"", "\"states\":[\"t\""),
    ] {
        assert!(good.contains(from), "{from} {good}");
        let found = Equations::from_json(&good.replacen(from, to, 1));
        assert!(found.is_err(), "{from} {found:?}");
    }
    // The error names the part.
    let wrong = good.replacen("\"outputs\":[", "\"outputs\":[99,", 1);
    let error = Equations::from_json(&wrong).unwrap_err().to_string();
    assert!(error.contains("the field of mode swing, outputs[0]"), "{error}");
}

/// Steps at ends: an event at the horizon, at the start of time, on every step, and at a time of 10⁹.
#[test]
fn events_at_ends_and_far_away() {
    let circle = Equations::new(&["x", "v"], &[])
        .mode("turn", |_, x, _| [x[1], -x[0]])
        .falling("zero", |_, x, _| x[0]);
    let start = State::from([1.0, 0.0]);
    let found = events(&circle, 1e-14, ("turn", start, 0.5 * PI));
    assert!(found.len() <= 1);
    assert_eq!(events(&circle, 1e-14, ("turn", start, 0.5 * PI - 1e-9)).len(), 0);
    assert_eq!(events(&circle, 1e-14, ("turn", start, 0.5 * PI + 1e-9)).len(), 1);
    assert_eq!(events(&circle, 1e-9, ("turn", start, TAU * 1000.0)).len(), 1000);
    let clock = Equations::new(&["x"], &[])
        .mode("m", |t, _, _| [t.cos()])
        .rising("noon", |t, _, _| (TAU * t).sin());
    let found = events(&clock, 1e-12, ("m", State::from([0.0, 1e9 + 0.25]), 5.0));
    assert_eq!(found.len(), 5);
    for (k, (_, time)) in found.iter().enumerate() {
        assert!((time - 0.75 - k as f64).abs() < 1e-6, "{time}");
    }
}

/// A start may leave the time out where the formulas use it, and nothing else.
#[test]
fn a_start_may_leave_the_time_out() {
    let ramp = Equations::new(&["x"], &[]).mode("m", |t, _, _| [t]);
    let model = ramp.model::<State<2>>().unwrap();
    // x = (9 − t₀²)/2 at 3.
    for (run, exact) in [
        (model.start("m", [0.0], 3.0), 4.5),
        (model.start("m", [0.0, 0.0], 3.0), 4.5),
        (model.start("m", State::from([0.0, 1.0]), 2.0), 4.0),
        (model.start_at("m", [0.0], (1.0, 3.0)), 4.0),
        (model.start_at("m", State::from([0.0, 7.0]), (1.0, 3.0)), 4.0),
        (model.start_at("m", [0.0], (-1.0, 3.0)), 4.0),
    ] {
        let end = run.unwrap().fate().state;
        assert!((end[0] - exact).abs() < 1e-12, "{end} {exact}");
    }
    let dynamic = ramp.model::<DVector<f64>>().unwrap();
    let end = dynamic.start("m", vec![0.0], 3.0).unwrap().fate().state;
    assert!((end[0] - 4.5).abs() < 1e-12);
    for wrong in [vec![], vec![0.0; 3]] {
        let refused = dynamic.start("m", wrong, 3.0).map(drop);
        assert!(matches!(refused, Err(Error::Dimension { expected: 2, .. })));
    }
    // Without the time nothing is added.
    let two = Equations::new(&["x", "y"], &[]).mode_text("m", &["y", "x"]);
    let model = two.model::<State<2>>().unwrap();
    assert!(matches!(model.start("m", [1.0], 3.0).map(drop), Err(Error::Dimension { .. })));
    let clock = model.start_at("m", [1.0, 0.0], (5.0, 6.0)).unwrap().fate();
    assert!((clock.time - 6.0).abs() < 1e-15 && (clock.state[0] - 1f64.cosh()).abs() < 1e-12);
}
