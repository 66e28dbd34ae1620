//! Motions with known answers by diffsol (`tsit45`): the answer and the time of a run, at many tolerances.
//!
//! The starts and ends stand in the file of the motions; the fields are those of its texts.

use crate::least_seconds;
use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use serde_json::{Value, json};
use std::time::Duration;

#[path = "../../src/motions/fields.rs"]
mod fields;

/// Time for the runs of one motion at one tolerance.
const SHARE: Duration = Duration::from_millis(100);

/// The most steps of a run: one that needs more has no answer.
const STEPS: usize = 3_000_000;

macro_rules! run {
    ($problem:expr, ($end:expr, $count:expr), $has_events:expr, $has_reset:expr) => {{
        let problem = $problem.build().unwrap();
        Box::new(move || {
            let mut solver = problem.tsit45().ok()?;
            solver.set_stop_time($end).ok()?;
            let mut last = None;
            for _ in 0..STEPS {
                match solver.step().ok()? {
                    OdeSolverStopReason::RootFound(time, _) => {
                        solver.state_mut_back(time).ok()?;
                        if $has_reset {
                            solver.apply_reset().ok()?;
                        }
                        last = Some(time);
                    }
                    OdeSolverStopReason::TstopReached if $has_events => return Some(vec![last?]),
                    OdeSolverStopReason::TstopReached => {
                        let state = solver.state();
                        return Some((0..$count).map(|k| state.y[k]).collect());
                    }
                    OdeSolverStopReason::InternalTimestep => {}
                }
            }
            None
        }) as Box<dyn Fn() -> Option<Vec<f64>>>
    }};
}

fn run(scene: &Value, tolerance: f64) -> Box<dyn Fn() -> Option<Vec<f64>>> {
    let number = |text: &Value| text.as_str().unwrap().parse::<f64>().unwrap();
    let start: Vec<f64> = scene["start"].as_array().unwrap().iter().map(number).collect();
    let (end, count) = (number(&scene["end"]), start.len());
    let builder = || OdeBuilder::<NalgebraMat<f64>>::new().rtol(tolerance).atol([tolerance]);
    macro_rules! flow {
        ($field:expr) => {{
            let field = $field;
            run!(
                builder()
                    .rhs(move |x, _, _, dx| {
                        let rates = field(&std::array::from_fn(|k| x[k]));
                        rates.iter().enumerate().for_each(|(k, rate)| dx[k] = *rate);
                    })
                    .init(move |_, _, x| (0..count).for_each(|k| x[k] = start[k]), count),
                (end, count),
                false,
                false
            )
        }};
    }
    match scene["scene"].as_str().unwrap() {
        "pendulum section" => run!(
            builder()
                .rhs(|x, _, _, dx| (dx[0], dx[1]) = (x[1], -x[0].sin()))
                .init(move |_, _, x| (0..count).for_each(|k| x[k] = start[k]), count)
                .root(|x, _, _, g| g[0] = x[0], 1),
            (end, count),
            true,
            false
        ),
        "impact oscillator" => run!(
            builder()
                .rhs(|x, _, t, dx| (dx[0], dx[1]) = (x[1], (1.3 * t).cos() - 0.1 * x[1] - x[0]))
                .init(move |_, _, x| (0..count).for_each(|k| x[k] = start[k]), count)
                .root(|x, _, _, g| g[0] = x[0] - 0.5, 1)
                // Below the stop, as in diffsol's own example of a ball: a root at zero is not a change of sign.
                .reset(|x, _, _, y| (y[0], y[1]) = (x[0].min(0.5 - f64::EPSILON), -0.8 * x[1])),
            (end, count),
            true,
            true
        ),
        "van der Pol" => flow!(fields::van_der_pol(5.0)),
        "van der Pol, μ = 100" => flow!(fields::van_der_pol(100.0)),
        "Arenstorf" => flow!(fields::arenstorf),
        "Lorenz" | "Lorenz to t = 50" => flow!(fields::lorenz),
        "outer planets" => flow!(fields::planets),
        _ => flow!(fields::kepler),
    }
}

/// All motions of a file.
pub fn measure(scenes: &str) -> Vec<Value> {
    let mut found = Vec::new();
    for scene in scenes.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()) {
        for exponent in 3..16 {
            let tolerance = 10f64.powi(-exponent);
            let run = run(&scene, tolerance);
            let (Some(answer), smallest) = least_seconds(SHARE, run) else { continue };
            found.push(json!({
                "scene": scene["scene"], "program": "diffsol 0.18.0, tsit45", "tolerance": tolerance,
                "seconds": smallest, "answer": answer
            }));
        }
    }
    found
}
