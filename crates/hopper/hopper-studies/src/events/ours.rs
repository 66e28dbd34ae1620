//! The scenes by this repository. The lines between `begin` and `end` are the lines of the model.

use hybrid_system::{Equations, Error, Label, State};

/// This file: the lines of its models are counted.
pub(super) const SOURCE: &str = include_str!("ours.rs");

/// A run through the events of a scene: their times, and the first component of the state at the end.
pub(super) type Run = Box<dyn Fn() -> Result<(Vec<f64>, f64), Error>>;

/// The same for all programs that have a choice.
const TOLERANCE: f64 = 1e-12;

// begin ball
fn ball() -> Result<Run, Error> {
    let ball = Equations::new(&["height", "speed"], &[("gravity", "9.81"), ("restitution", "0.8")])
        .mode("air", |_, x, p| [x[1], -p["gravity"]])
        .falling("floor", |_, x, _| x[0])
        .resets(|_, x, p| [x[0], -p["restitution"] * x[1]])
        .rests("floor")
        .mode_text("floor", &["0", "0"])
        .model::<State<2>>()?
        .tolerance(TOLERANCE);
    Ok(Box::new(move || {
        let (mut run, mut times) = (ball.start("air", [1.0, 0.0], 5.0)?, Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    }))
}
// end
// begin pendulum
fn pendulum() -> Result<Run, Error> {
    let pendulum = Equations::new(&["angle", "speed"], &[])
        .mode("swing", |_, x, _| [x[1], -x[0].sin()])
        .either("section", |_, x, _| x[0])
        .model::<State<2>>()?
        .tolerance(TOLERANCE);
    Ok(Box::new(move || {
        let (mut run, mut times) = (pendulum.start("swing", [2.0, 0.0], 400.0)?, Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    }))
}
// end
// begin turning points
fn turning_points() -> Result<Run, Error> {
    let pendulum = Equations::new(&["angle", "speed"], &[])
        .mode("swing", |_, x, _| [x[1], -x[0].sin()])
        .either("section", |_, x, _| x[0] - 1.9999)
        .model::<State<2>>()?
        .tolerance(TOLERANCE);
    Ok(Box::new(move || {
        let (mut run, mut times) = (pendulum.start("swing", [2.0, 0.0], 400.0)?, Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    }))
}
// end
// begin van der Pol
fn van_der_pol() -> Result<Run, Error> {
    let oscillator = Equations::new(&["x", "v"], &[])
        .mode("m", |_, x, _| [x[1], 5.0 * (1.0 - x[0] * x[0]) * x[1] - x[0]])
        .either("section", |_, x, _| x[0])
        .model::<State<2>>()?
        .tolerance(TOLERANCE);
    Ok(Box::new(move || {
        let (mut run, mut times) = (oscillator.start("m", [2.0, 0.0], 300.0)?, Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    }))
}
// end
// begin relay with hysteresis
fn hysteresis() -> Result<Run, Error> {
    let relay = Equations::new(&["x"], &[])
        .mode_text("up", &["1.3"])
        .rising_text("above", "x - 0.01")
        .to("down")
        .mode_text("down", &["-0.7"])
        .falling_text("below", "x + 0.01")
        .to("up")
        .model::<State<1>>()?
        .tolerance(TOLERANCE);
    Ok(Box::new(move || {
        let (mut run, mut times) = (relay.start("down", [1.0], 5.0)?, Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    }))
}
// end
// begin relay
fn relay() -> Result<Run, Error> {
    let on = Label::new("on")?;
    let relay = Equations::new(&["x"], &[])
        .mode_text("up", &["1.3"])
        .rising_text("zero", "x")
        .to("down")
        .mode_text("down", &["-0.7"])
        .falling_text("zero", "x")
        .to("up")
        .mode_text("on", &["0"])
        .model::<State<1>>()?
        .slide(move |point| Some((on, point.state)));
    Ok(Box::new(move || {
        let (mut run, mut times) = (relay.start("down", [1.0], 5.0)?, Vec::new());
        for arc in run.by_ref() {
            times.extend(arc?.event().map(|event| event.time));
        }
        Ok((times, run.state()[0]))
    }))
}
// end

/// All scenes.
pub(super) fn scenes() -> Result<[(&'static str, Run); 6], Error> {
    Ok([
        ("ball", ball()?),
        ("pendulum", pendulum()?),
        ("turning points", turning_points()?),
        ("van der Pol", van_der_pol()?),
        ("relay with hysteresis", hysteresis()?),
        ("relay", relay()?),
    ])
}
