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
