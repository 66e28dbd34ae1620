//! The scenes by this repository. The lines between `begin` and `end` are the lines of the model.

use hybrid_system::{Error, Guard, Model, State};

/// This file: the lines of its models are counted.
pub(super) const SOURCE: &str = include_str!("ours.rs");

/// A run through the events of a scene: their times, and the first component of the state at the end.
pub(super) type Run = Box<dyn Fn() -> Result<(Vec<f64>, f64), Error>>;

/// The same for all programs that have a choice.
const TOLERANCE: f64 = 1e-12;

// begin ball
fn ball() -> Run {
    let ball = Model::integrated(|mode, x: &State<2>| match mode {
        "air" => [x[1], -9.81],
        _ => [0.0, 0.0],
    })
    .tolerance(TOLERANCE)
    .guard("air", Guard::falling("floor"), |x| x[0], |x| ("air", [0.0, -0.8 * x[1]]))
    .rest(|_, _| Some(("rest", [0.0, 0.0])));
    Box::new(move || {
        let (mut run, mut times) = (ball.run("air", [1.0, 0.0], 5.0), Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    })
}
// end
// begin pendulum
fn pendulum() -> Run {
    let pendulum = Model::integrated(|(), x: &State<2>| [x[1], -pxfm::f_sin(x[0])])
        .tolerance(TOLERANCE)
        .observer(Guard::either("section"), |x| x[0]);
    Box::new(move || {
        let (mut run, mut times) = (pendulum.run((), [2.0, 0.0], 400.0), Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    })
}
// end
// begin turning points
fn turning_points() -> Run {
    let pendulum = Model::integrated(|(), x: &State<2>| [x[1], -pxfm::f_sin(x[0])])
        .tolerance(TOLERANCE)
        .observer(Guard::either("section"), |x| x[0] - 1.9999);
    Box::new(move || {
        let (mut run, mut times) = (pendulum.run((), [2.0, 0.0], 400.0), Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    })
}
// end
// begin van der Pol
fn van_der_pol() -> Run {
    let oscillator =
        Model::integrated(|(), x: &State<2>| [x[1], 5.0 * (1.0 - x[0] * x[0]) * x[1] - x[0]])
            .tolerance(TOLERANCE)
            .observer(Guard::either("section"), |x| x[0]);
    Box::new(move || {
        let (mut run, mut times) = (oscillator.run((), [2.0, 0.0], 300.0), Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    })
}
// end
// begin relay with hysteresis
fn hysteresis() -> Run {
    let relay = Model::integrated(|up, _: &State<1>| [if up { 1.3 } else { -0.7 }])
        .tolerance(TOLERANCE)
        .guard(true, Guard::rising("above"), |x| x[0] - 0.01, |x| (false, *x))
        .guard(false, Guard::falling("below"), |x| x[0] + 0.01, |x| (true, *x));
    Box::new(move || {
        let (mut run, mut times) = (relay.run(false, [1.0], 5.0), Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    })
}
// end
// begin relay
fn relay() -> Run {
    let relay = Model::integrated(|mode, _: &State<1>| match mode {
        "up" => [1.3],
        "down" => [-0.7],
        _ => [0.0],
    })
    .tolerance(TOLERANCE)
    .guard("up", Guard::rising("zero"), |x| x[0], |x| ("down", *x))
    .guard("down", Guard::falling("zero"), |x| x[0], |x| ("up", *x))
    .slide(|point| Some(("on", point.state)));
    Box::new(move || {
        let (mut run, mut times) = (relay.run("down", [1.0], 5.0), Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    })
}
// end

/// All scenes.
pub(super) fn scenes() -> [(&'static str, Run); 6] {
    [
        ("ball", ball()),
        ("pendulum", pendulum()),
        ("turning points", turning_points()),
        ("van der Pol", van_der_pol()),
        ("relay with hysteresis", hysteresis()),
        ("relay", relay()),
    ]
}
