//! Motions with known answers by diffsol (`tsit45`): the answer and the time of a run, at many tolerances.
//!
//! The starts and ends stand in the file of the motions; the fields are those of its texts.

use diffsol::{NalgebraMat, OdeBuilder, OdeSolverMethod, OdeSolverStopReason};
use serde_json::{Value, json};
use std::time::{Duration, Instant};

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
        ($field:expr) => {
            run!(
                builder()
                    .rhs($field)
                    .init(move |_, _, x| (0..count).for_each(|k| x[k] = start[k]), count),
                (end, count),
                false,
                false
            )
        };
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
        name @ ("van der Pol" | "van der Pol, μ = 100") => {
            let mu = if name == "van der Pol" { 5.0 } else { 100.0 };
            flow!(
                move |x, _, _, dx| (dx[0], dx[1]) = (x[1], mu * (1.0 - x[0] * x[0]) * x[1] - x[0])
            )
        }
        "Arenstorf" => flow!(|x, _, _, dx| {
            let moon: f64 = 0.012_277_471;
            let (x, y, u, v) = (x[0], x[1], x[2], x[3]);
            let pull = |mass: f64, place: f64| {
                let square = (x - place) * (x - place) + y * y;
                mass / (square * square.sqrt())
            };
            let (earth, by_moon) = (pull(1.0 - moon, -moon), pull(moon, 1.0 - moon));
            (dx[0], dx[1]) = (u, v);
            dx[2] = x + 2.0 * v - earth * (x + moon) - by_moon * (x - (1.0 - moon));
            dx[3] = y - 2.0 * u - (earth + by_moon) * y;
        }),
        "Lorenz" | "Lorenz to t = 50" => flow!(|x, _, _, dx| {
            let [x, y, z] = [x[0], x[1], x[2]];
            (dx[0], dx[1]) = (10.0 * (y - x), x * (28.0 - z) - y);
            dx[2] = x * y - 2.666_666_666_666_666_5 * z;
        }),
        "outer planets" => flow!(|x, _, _, dx| {
            let rates = planets(&std::array::from_fn(|k| x[k]));
            (0..36).for_each(|k| dx[k] = rates[k]);
        }),
        _ => flow!(|x, _, _, dx| {
            let square: f64 = x[0] * x[0] + x[1] * x[1];
            let force = 1.0 / (square * square.sqrt());
            (dx[0], dx[1], dx[2], dx[3]) = (x[2], x[3], -force * x[0], -force * x[1]);
        }),
    }
}

fn planets(x: &[f64; 36]) -> [f64; 36] {
    const GRAVITY: f64 = 2.959_122_082_86e-4;
    const MASSES: [f64; 6] = [
        1.000_005_976_82,
        0.000_954_786_104_043,
        0.000_285_583_733_151,
        0.000_043_727_316_454_6,
        0.000_051_775_913_844_9,
        0.000_000_007_692_307_692_3,
    ];
    let mut rates = [0.0; 36];
    rates[..18].copy_from_slice(&x[18..]);
    for i in 0..6 {
        for j in 0..i {
            let away: [f64; 3] = std::array::from_fn(|axis| x[3 * i + axis] - x[3 * j + axis]);
            let square = away.iter().map(|part| part * part).sum::<f64>();
            let force = GRAVITY / (square * square.sqrt());
            for (axis, part) in away.iter().enumerate() {
                rates[18 + 3 * i + axis] -= MASSES[j] * force * part;
                rates[18 + 3 * j + axis] += MASSES[i] * force * part;
            }
        }
    }
    rates
}

/// All motions of a file.
pub fn measure(scenes: &str) -> Vec<Value> {
    let mut found = Vec::new();
    for scene in scenes.lines().map(|line| serde_json::from_str::<Value>(line).unwrap()) {
        for exponent in 3..16 {
            let tolerance = 10f64.powi(-exponent);
            let run = run(&scene, tolerance);
            let begin = Instant::now();
            let Some(answer) = run() else { continue };
            let mut smallest = begin.elapsed().as_secs_f64();
            while begin.elapsed() < SHARE {
                let start = Instant::now();
                run();
                smallest = smallest.min(start.elapsed().as_secs_f64());
            }
            found.push(json!({
                "scene": scene["scene"], "program": "diffsol 0.18.0, tsit45", "tolerance": tolerance,
                "seconds": smallest, "answer": answer
            }));
        }
    }
    found
}
