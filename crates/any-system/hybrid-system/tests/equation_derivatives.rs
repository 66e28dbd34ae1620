//! Derivatives of models of equations: of flows, events, jumps and whole executions.

#![cfg(feature = "ode")]

use hybrid_system::*;

fn pendulum() -> Equations {
    Equations::new(&["angle", "speed"], &[])
        .mode("swing", |_, x, _| [x[1], -x[0].sin()])
        .falling("top", |_, x, _| x[1])
}

#[test]
fn the_first_periodic_orbit_of_roessler() {
    let roessler = Equations::new(&["x", "y", "z"], &[("a", "0.2"), ("b", "0.2"), ("c", "5.7")])
        .mode("flow", |_, x, p| {
            [-x[1] - x[2], x[0] + p["a"] * x[1], p["b"] + x[2] * (x[0] - p["c"])]
        })
        .rising("section", |_, x, _| x[0])
        .model::<State<3>>()
        .unwrap()
        .tolerance(1e-14);
    let mut point = [-8.4, 0.03];
    for _ in 0..6 {
        let start = State::from([0.0, point[0], point[1]]);
        let arc = roessler.start("flow", start, 20.0).unwrap().next().unwrap().unwrap();
        let columns = [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|along| {
            let jet = roessler.jet::<2>(&[arc], &Along::start(&along)).unwrap();
            [jet.state[1].0[1], jet.state[2].0[1]]
        });
        let end = arc.event().unwrap().before;
        let off = [end[1] - point[0], end[2] - point[1]];
        let [a, c] = [columns[0][0] - 1.0, columns[0][1]];
        let [b, d] = [columns[1][0], columns[1][1] - 1.0];
        let det = a * d - b * c;
        point[0] -= (d * off[0] - b * off[1]) / det;
        point[1] -= (a * off[1] - c * off[0]) / det;
    }
    assert!((point[0] + 8.380_941_742_829_8).abs() < 1e-11, "{point:?}");
    assert!((point[1] - 0.029_590_060_630_665).abs() < 1e-12, "{point:?}");
}

/// The period 4 K(sin(a/2)) at a = 1: its Taylor coefficients by the amplitude (mpmath).
#[test]
fn derivatives_of_a_period_to_the_third_order() {
    let exact = [
        6.699_975_664_370_453,
        0.885_206_953_111_523_8,
        0.553_304_533_962_988_2,
        0.126_819_815_694_152_7,
    ];
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let model = pendulum().model::<State<2>>().unwrap().tolerance(tolerance);
        let arc = model.start("swing", [1.0, 0.0], 9.0).unwrap().next().unwrap().unwrap();
        let jet = model.jet::<4>(&[arc], &Along::start(&[1.0, 0.0])).unwrap();
        for (k, exact) in exact.iter().enumerate() {
            let off = (jet.time.0[k] - exact).abs() / exact;
            assert!(off < 100.0 * tolerance + 1e-13, "{tolerance:e} {k}: {off:e}");
        }
    }
}

/// Along an impacting orbit: the chain of saltation matrices, the derivative along one direction, and the difference of
/// two runs.
#[test]
fn derivatives_through_impacts_agree() {
    let oscillator = Equations::new(&["x", "v"], &[("damping", "0.1")])
        .mode("free", |t, x, p| [x[1], (1.3 * t).cos() - x[0] - p["damping"] * x[1]])
        .rising("stop", |_, x, _| x[0] - 0.5)
        .resets(|_, x, _| [x[0], -0.8 * x[1]]);
    let model = oscillator.model::<State<3>>().unwrap().tolerance(1e-13);
    let start = State::from([0.0, 1.0, 0.0]);
    let arcs: Vec<_> = model.start("free", start, 12.0).unwrap().map(Result::unwrap).collect();
    assert!(arcs.len() > 3);
    let matrix = sensitivity(&model, &arcs).unwrap();
    for (axis, along) in [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].iter().enumerate() {
        let jet = model.jet::<3>(&arcs, &Along::start(along)).unwrap();
        let column = [0, 1].map(|row| jet.state[row].0[1]);
        for row in 0..2 {
            let off = (column[row] - matrix[(row, axis)]).abs();
            assert!(off < 1e-10 * matrix.amax(), "{row} {axis}: {off:e}");
        }
        // Half of the second difference.
        let end = |step: f64| {
            let start = start + State::from(*along) * step;
            let arcs = model.start("free", start, 12.0).unwrap().map(Result::unwrap);
            let last = arcs.last().unwrap();
            last.state(&model, last.duration).unwrap()
        };
        let step = 1e-4;
        let second = (end(step) + end(-step) - 2.0 * end(0.0)) / (2.0 * step * step);
        for row in 0..2 {
            let found = jet.state[row].0[2];
            assert!(
                (second[row] - found).abs() < 1e-4 * (1.0 + found.abs()),
                "{row} {axis} {found}"
            );
        }
    }
    // By a parameter, against two runs.
    let jet = model.jet::<2>(&arcs, &Along::parameter("damping")).unwrap();
    let end = |damping: &str| {
        let model = oscillator.clone().with_parameters(&[("damping", damping)]);
        let model = model.model::<State<3>>().unwrap().tolerance(1e-13);
        let last = model.start("free", start, 12.0).unwrap().map(Result::unwrap).last().unwrap();
        last.state(&model, last.duration).unwrap()
    };
    let difference = (end("0.10001") - end("0.09999")) / 2e-5;
    for row in 0..2 {
        assert!(
            (difference[row] - jet.state[row].0[1]).abs() < 1e-5 * (1.0 + difference[row].abs())
        );
    }
    assert!(model.jet::<2>(&arcs, &Along::parameter("mass")).is_err());
    assert!(model.jet::<2>(&arcs, &Along::start(&[1.0])).is_err());
}

/// x = sin t touches 1, and passes 1 − δ slowly: the derivative of the time is −tan of the phase, and infinite at last.
#[test]
fn derivatives_are_refused_at_a_grazing() {
    let circle = |level: f64| {
        Equations::new(&["x", "v"], &[])
            .mode("turn", |_, x, _| [x[1], -x[0]])
            .rising("level", move |_, x, _| x[0] - level)
            .touch(Touch::Event)
            .stops()
            .model::<State<2>>()
            .unwrap()
            .tolerance(1e-14)
    };
    for level in [0.5, 0.99, 1.0 - 1e-6] {
        let model = circle(level);
        let arc = model.start("turn", [0.0, 1.0], 9.0).unwrap().next().unwrap().unwrap();
        let jet = model.jet::<2>(&[arc], &Along::start(&[0.0, 1.0])).unwrap();
        // (1 + ε) sin τ = level.
        let exact = -level / (1.0 - level * level).sqrt();
        assert!((jet.time.0[1] / exact - 1.0).abs() < 1e-8, "{level}");
    }
    let model = circle(1.0);
    let arc = model.start("turn", [0.0, 1.0], 9.0).unwrap().next().unwrap().unwrap();
    assert_eq!(arc.event().unwrap().kind, EventKind::Touch);
    let refused = model.jet::<2>(&[arc], &Along::start(&[0.0, 1.0]));
    assert!(matches!(refused, Err(Error::GrazingSensitivity { .. })), "{refused:?}");
}

/// A rotor that is kicked by K sin θ after each period is the standard map. By start, kick and period: the derivatives of
/// the map, by hand.
#[test]
fn derivatives_through_ticks_are_those_of_the_standard_map() {
    let (kick, period) = (0.9, 0.75);
    let rotor = Equations::new(&["angle", "speed"], &[("kick", "0.9"), ("period", "0.75")])
        .mode("turns", |_, x, _| [x[1], 0.0 * x[1]])
        .clock_text("kick", "period", "period")
        .resets(|_, x, p| [x[0], x[1] + p["kick"] * x[0].sin()]);
    let again = Equations::from_json(&rotor.to_json().unwrap()).unwrap();
    assert_eq!(again, rotor);
    let rotor = again.model::<State<2>>().unwrap();
    let arcs: Vec<_> = rotor.start("turns", [1.0, 0.3], 2.3).unwrap().map(Result::unwrap).collect();
    assert_eq!(arcs.len(), 4);
    for (start, by_kick, by_period) in [
        ([1.0, 0.0], 0.0, 0.0),
        ([0.0, 1.0], 0.0, 0.0),
        ([0.0, 0.0], 1.0, 0.0),
        ([0.3, -2.0], 0.5, 2.0),
    ] {
        let along = Along::start(&start).and_parameter("kick", by_kick);
        let along = along.and_parameter("period", by_period);
        let jet = rotor.jet::<2>(&arcs[..3], &along).unwrap();
        let (mut x, mut v, mut dx, mut dv) = (1.0f64, 0.3, start[0], start[1]);
        for _ in 0..3 {
            (x, dx) = (x + period * v, dx + period * dv + by_period * v);
            (v, dv) = (v + kick * x.sin(), dv + by_kick * x.sin() + kick * x.cos() * dx);
        }
        for (jet, (value, change)) in jet.state.iter().zip([(x, dx), (v, dv)]) {
            assert!((jet.0[0] - value).abs() < 1e-14, "{jet:?} {value}");
            assert!((jet.0[1] - change).abs() < 1e-13 * (1.0 + change.abs()), "{jet:?} {change}");
        }
        assert!((jet.time.0[1] - 3.0 * by_period).abs() < 1e-14);
    }
    // Up to a limit on time the ticks come earlier or later, and the end does not.
    let jet = rotor.jet::<2>(&arcs, &Along::parameter("period")).unwrap();
    assert_eq!(jet.time.0[1], 0.0);
    // Up to the time of a tick, a longer period leaves out the kick: there is no derivative by it, but by the kick.
    let arcs: Vec<_> = rotor.start("turns", [1.0, 0.3], 1.5).unwrap().map(Result::unwrap).collect();
    assert_eq!((arcs.len(), arcs[2].duration), (3, 0.0));
    let error = rotor.jet::<2>(&arcs, &Along::parameter("period")).unwrap_err();
    assert!(matches!(error, Error::CornerSensitivity { time: 1.5, .. }), "{error}");
    let up_to_tick = rotor.jet::<2>(&arcs[..2], &Along::parameter("kick")).unwrap();
    let jet = rotor.jet::<2>(&arcs, &Along::parameter("kick")).unwrap();
    assert_eq!(jet.state, up_to_tick.state);
}

/// A limit on time at the very time of a bounce: a higher start lands later. An observer there changes nothing.
#[test]
fn an_event_at_the_limit_has_no_derivative_there() {
    let ball = |jump: bool| {
        let ball = Equations::new(&["height", "speed"], &[])
            .mode_text("flight", &["speed", "-2"])
            .falling_text("floor", "height");
        if jump { ball.resets_text(&["height", "-speed/2"]) } else { ball }
    };
    for jump in [true, false] {
        let ball = ball(jump).model::<State<2>>().unwrap();
        let arcs: Vec<_> =
            ball.start("flight", [1.0, 0.0], 1.0).unwrap().map(Result::unwrap).collect();
        assert_eq!(arcs.len(), 2, "{arcs:?}");
        let jet = ball.jet::<2>(&arcs, &Along::start(&[1.0, 0.0]));
        match jump {
            true => assert!(matches!(jet, Err(Error::CornerSensitivity { .. })), "{jet:?}"),
            false => {
                let off = jet.unwrap().state;
                let off = [off[0].0[1] - 1.0, off[1].0[1]];
                assert!(off.iter().all(|off| off.abs() < 1e-13), "{off:?}");
            }
        }
    }
}

/// The error of derivatives is no larger than ten times that of the state: over twelve impacts of a nonlinear oscillator, in
/// which errors grow, against the run at the smallest tolerance.
#[test]
fn derivatives_have_the_error_of_the_state() {
    let oscillator = Equations::new(&["x", "v", "phase"], &[("damping", "0.1"), ("stop", "0.5")])
        .mode("free", |_, x, p| {
            [x[1], x[2].cos() - p["damping"] * x[1] - x[0] - x[0].powi(3), x[0].number(1.3)]
        })
        .rising("stop", |_, x, p| x[0] - p["stop"])
        .resets(|_, x, _| [x[0], -0.8 * x[1], x[2]])
        .model::<State<3>>()
        .unwrap();
    let along = Along::start(&[0.0, 1.0, 0.0]).and_parameter("stop", 0.3);
    let run = |tolerance: f64| {
        let model = oscillator.clone().tolerance(tolerance);
        let arcs = model.start("free", [0.0, 1.0, 0.0], 80.0).unwrap().take(12);
        let arcs: Vec<_> = arcs.map(Result::unwrap).collect();
        model.jet::<4>(&arcs, &along).unwrap()
    };
    let exact = run(1e-16);
    for tolerance in [1e-6, 1e-8, 1e-10, 1e-12, 1e-14] {
        let found = run(tolerance);
        // Relative to the largest component of each order. The phase is the time, and has no error.
        let errors: [f64; 4] = std::array::from_fn(|order| {
            let pairs = || found.state.iter().zip(&exact.state).take(2);
            let off = pairs().map(|(a, b)| (a.0[order] - b.0[order]).abs()).fold(0.0, f64::max);
            off / pairs().map(|(_, b)| b.0[order].abs()).fold(0.0, f64::max)
        });
        // Below 5e-14 rounding adds up, over a hundred steps and twelve quotients by the rate of the guard.
        let of_state = errors[0].max(5e-14);
        assert!(
            errors[1..].iter().all(|error| *error <= 10.0 * of_state),
            "{tolerance:e}: {errors:?}"
        );
    }
}

/// A ball falls from h = 1 under g = 2 for √(2h/g): its second derivatives are −1/4, −1/8 and 3/16. The mixed one is a third of three
/// directions.
#[test]
fn second_derivatives_by_start_and_parameter_are_the_known_ones() {
    let ball = Equations::new(&["height", "speed"], &[("gravity", "2")])
        .mode("flight", |_, x, p| [x[1], -p["gravity"]])
        .falling("floor", |_, x, _| x[0])
        .model::<State<2>>()
        .unwrap();
    let arc = ball.start("flight", [1.0, 0.0], 9.0).unwrap().next().unwrap().unwrap();
    let second = |along: &Along| 2.0 * ball.jet::<3>(&[arc], along).unwrap().time.0[2];
    let by_height = second(&Along::start(&[1.0, 0.0]));
    let by_gravity = second(&Along::parameter("gravity"));
    let by_both = second(&Along::start(&[1.0, 0.0]).and_parameter("gravity", 1.0));
    let mixed = 0.5 * (by_both - by_height - by_gravity);
    for (found, known) in [(by_height, -0.25), (mixed, -0.125), (by_gravity, 0.1875)] {
        assert!((found - known).abs() < 1e-14, "{found} {known}");
    }
}

/// ẋ = cos t from x = 0 at t₀ meets x = ½ where sin t = ½ + sin t₀. The time since the start has at t₀ = 0 the derivatives 2/√3 − 1 and
/// 4/(3√3) by t₀.
#[test]
fn derivatives_by_the_start_time_are_the_known_ones() {
    let model = Equations::new(&["x"], &[])
        .mode("moves", |t, _, _| [t.cos()])
        .rising("half", |_, x, _| x[0] - 0.5)
        .model::<State<2>>()
        .unwrap();
    let arc = model.start("moves", [0.0, 0.0], 3.0).unwrap().next().unwrap().unwrap();
    let found = model.jet::<3>(&[arc], &Along::start(&[0.0, 1.0])).unwrap().time;
    let root = 3f64.sqrt();
    for (k, known) in
        [std::f64::consts::FRAC_PI_6, 2.0 / root - 1.0, 2.0 / (3.0 * root)].iter().enumerate()
    {
        assert!((found.0[k] - known).abs() < 1e-13, "{k}: {found:?} {known}");
    }
}

/// Where a guard is crossed at 10⁻¹³ of the size of its terms, three digits of a derivative would be left: refused.
#[test]
fn a_slow_crossing_has_no_derivative() {
    let model = Equations::new(&["x", "y"], &[])
        .mode("moves", |_, x, _| [x[0].number(1.0 + 1e-13), x[0].number(1.0)])
        .rising("meets", |_, x, _| x[0] - x[1])
        .model::<State<2>>()
        .unwrap();
    let arc = model.start("moves", [0.0, 1e-13], 9.0).unwrap().next().unwrap().unwrap();
    assert!(arc.event().is_some());
    let found = model.jet::<2>(&[arc], &Along::start(&[1.0, 0.0]));
    assert!(matches!(found, Err(Error::GrazingSensitivity { .. })), "{found:?}");
}
