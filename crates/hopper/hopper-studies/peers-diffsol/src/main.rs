//! Events of six scenes by diffsol: times of the events, state at the end, time of a run.
//!
//! Run with `cargo run --release -- results.json`; with a file of motions behind it, see `motions`. Each scene is a function that builds its model and returns a
//! function that runs it. That function returns the times of the events and the first component of the state at the
//! end. The lines between `begin` and `end` are the lines of the model. A run ends at the limit on time or after
//! `MOST` events.

#![allow(clippy::unwrap_used, clippy::print_stdout, clippy::disallowed_methods)]

mod motions;

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use std::time::{Duration, Instant};

/// A run through the events of a scene.
type Run = Box<dyn Fn() -> (Vec<f64>, f64)>;

const MOST: usize = 1000;
const TOLERANCE: f64 = 1e-12;

// begin ball
fn ball() -> Run {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs(|x, _, _, dx| (dx[0], dx[1]) = (x[1], -9.81))
        .init(|_, _, x| (x[0], x[1]) = (1.0, 0.0), 2)
        .root(|x, _, _, g| g[0] = x[0], 1)
        // Above the floor, as in diffsol's own example of a ball: a root at zero is not a change of sign.
        .reset(|x, _, _, y| (y[0], y[1]) = (x[0].max(f64::EPSILON), -0.8 * x[1]))
        .build()
        .unwrap();
    Box::new(move || {
        let (mut solver, mut times) = (problem.tsit45().unwrap(), Vec::new());
        solver.set_stop_time(5.0).unwrap();
        while times.len() < MOST {
            match solver.step().unwrap() {
                OdeSolverStopReason::RootFound(time, _) => {
                    solver.state_mut_back(time).unwrap();
                    solver.apply_reset().unwrap();
                    times.push(time);
                }
                OdeSolverStopReason::TstopReached => break,
                OdeSolverStopReason::InternalTimestep => {}
            }
        }
        (times, solver.state().y[0])
    })
}
// end
// begin pendulum
fn pendulum() -> Run {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs(|x, _, _, dx| (dx[0], dx[1]) = (x[1], -x[0].sin()))
        .init(|_, _, x| (x[0], x[1]) = (2.0, 0.0), 2)
        .root(|x, _, _, g| g[0] = x[0], 1)
        .build()
        .unwrap();
    Box::new(move || {
        let (mut solver, mut times) = (problem.tsit45().unwrap(), Vec::new());
        solver.set_stop_time(400.0).unwrap();
        while times.len() < MOST {
            match solver.step().unwrap() {
                OdeSolverStopReason::RootFound(time, _) => {
                    solver.state_mut_back(time).unwrap();
                    times.push(time);
                }
                OdeSolverStopReason::TstopReached => break,
                OdeSolverStopReason::InternalTimestep => {}
            }
        }
        (times, solver.state().y[0])
    })
}
// end
// begin turning points
fn turning_points() -> Run {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs(|x, _, _, dx| (dx[0], dx[1]) = (x[1], -x[0].sin()))
        .init(|_, _, x| (x[0], x[1]) = (2.0, 0.0), 2)
        .root(|x, _, _, g| g[0] = x[0] - 1.9999, 1)
        .build()
        .unwrap();
    Box::new(move || {
        let (mut solver, mut times) = (problem.tsit45().unwrap(), Vec::new());
        solver.set_stop_time(400.0).unwrap();
        while times.len() < MOST {
            match solver.step().unwrap() {
                OdeSolverStopReason::RootFound(time, _) => {
                    solver.state_mut_back(time).unwrap();
                    times.push(time);
                }
                OdeSolverStopReason::TstopReached => break,
                OdeSolverStopReason::InternalTimestep => {}
            }
        }
        (times, solver.state().y[0])
    })
}
// end
// begin van der Pol
fn van_der_pol() -> Run {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs(|x, _, _, dx| (dx[0], dx[1]) = (x[1], 5.0 * (1.0 - x[0] * x[0]) * x[1] - x[0]))
        .init(|_, _, x| (x[0], x[1]) = (2.0, 0.0), 2)
        .root(|x, _, _, g| g[0] = x[0], 1)
        .build()
        .unwrap();
    Box::new(move || {
        let (mut solver, mut times) = (problem.tsit45().unwrap(), Vec::new());
        solver.set_stop_time(300.0).unwrap();
        while times.len() < MOST {
            match solver.step().unwrap() {
                OdeSolverStopReason::RootFound(time, _) => {
                    solver.state_mut_back(time).unwrap();
                    times.push(time);
                }
                OdeSolverStopReason::TstopReached => break,
                OdeSolverStopReason::InternalTimestep => {}
            }
        }
        (times, solver.state().y[0])
    })
}
// end
// begin relay with hysteresis
fn hysteresis() -> Run {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs(|x, _, _, dx| (dx[0], dx[1]) = (x[1] + 0.3, 0.0))
        .init(|_, _, x| (x[0], x[1]) = (1.0, -1.0), 2)
        .root(|x, _, _, g| g[0] = x[1] * x[0] - 0.01, 1)
        .reset(|x, _, _, y| (y[0], y[1]) = (x[0], -x[1]))
        .build()
        .unwrap();
    Box::new(move || {
        let (mut solver, mut times) = (problem.tsit45().unwrap(), Vec::new());
        solver.set_stop_time(5.0).unwrap();
        while times.len() < MOST {
            match solver.step().unwrap() {
                OdeSolverStopReason::RootFound(time, _) => {
                    solver.state_mut_back(time).unwrap();
                    solver.apply_reset().unwrap();
                    times.push(time);
                }
                OdeSolverStopReason::TstopReached => break,
                OdeSolverStopReason::InternalTimestep => {}
            }
        }
        (times, solver.state().y[0])
    })
}
// end
// begin relay
fn relay() -> Run {
    let problem = OdeBuilder::<NalgebraMat<f64>>::new()
        .rtol(TOLERANCE)
        .atol([TOLERANCE])
        .rhs(|x, _, _, dx| (dx[0], dx[1]) = (x[1] + 0.3, 0.0))
        .init(|_, _, x| (x[0], x[1]) = (1.0, -1.0), 2)
        .root(|x, _, _, g| g[0] = x[0], 1)
        .reset(|x, _, _, y| (y[0], y[1]) = (x[0], -x[1]))
        .build()
        .unwrap();
    Box::new(move || {
        let (mut solver, mut times) = (problem.tsit45().unwrap(), Vec::new());
        solver.set_stop_time(5.0).unwrap();
        while times.len() < MOST {
            match solver.step().unwrap() {
                OdeSolverStopReason::RootFound(time, _) => {
                    solver.state_mut_back(time).unwrap();
                    solver.apply_reset().unwrap();
                    times.push(time);
                }
                OdeSolverStopReason::TstopReached => break,
                OdeSolverStopReason::InternalTimestep => {}
            }
        }
        (times, solver.state().y[0])
    })
}
// end

/// The result of a run, and the smallest time of some runs in seconds: other processes only make a run longer.
fn least_seconds<T>(share: Duration, run: impl Fn() -> T) -> (T, f64) {
    let begin = Instant::now();
    let found = run();
    let mut least = begin.elapsed();
    while begin.elapsed() < share {
        let start = Instant::now();
        run();
        least = least.min(start.elapsed());
    }
    (found, least.as_secs_f64())
}

/// The run's events and its time.
fn measure(scene: &str, run: Run) -> serde_json::Value {
    let ((times, end), smallest) = least_seconds(Duration::from_secs(1), run);
    serde_json::json!({
        "scene": scene, "name": "diffsol 0.18.0", "seconds": smallest, "times": times, "end": end
    })
}

fn main() {
    let [output, motions] = [1, 2].map(|at| std::env::args().nth(at));
    let write = |results: &[serde_json::Value]| {
        std::fs::write(output.unwrap(), serde_json::to_string(results).unwrap()).unwrap();
    };
    if let Some(motions) = motions {
        return write(&motions::measure(&std::fs::read_to_string(motions).unwrap()));
    }
    let results = [
        measure("ball", ball()),
        measure("pendulum", pendulum()),
        measure("turning points", turning_points()),
        measure("van der Pol", van_der_pol()),
        measure("relay with hysteresis", hysteresis()),
        measure("relay", relay()),
    ];
    write(&results);
}
