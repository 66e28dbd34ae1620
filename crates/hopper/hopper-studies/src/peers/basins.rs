//! Basins of three systems, by compiled loops of numba and by this repository, in one run.

use super::python::{Python, results};
use crate::error::Error;
use crate::repository::Progress;
use crate::text::markdown_table;
use basin_of_attraction::{
    Attractors, Hyperrectangle, Interval, Label, RecurrenceLimits, SplitMix64, StateGrid, StateMap,
    array_map,
};
use equations::{Formulas, Names};
use resumable_job::write_atomically;
use return_map::{FlowSteps, FormulaSteps};
use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};
use std::path::Path;
use std::time::Instant;

/// Pixels a side of Newton's method, and its cells.
const NEWTON: usize = 300;
/// Random starts of Hénon's map, and its cells.
const HENON: (usize, usize) = (100_000, 100);
/// Pixels a side of the driven pendulum.
const PENDULUM: usize = 512;
/// How long its motions are followed by numba, and the tolerances.
const END: f64 = 100.0;
const TOLERANCES: [f64; 3] = [1e-4, 1e-5, 1e-6];
const REFERENCE: f64 = 1e-13;
/// Time step and cells of the pendulum's attractors.
const STEP: f64 = 0.5;
const CELLS: usize = 50;
/// Runs of the maps: the least time counts.
const REPEATS: usize = 9;
/// The name of the loops that test no attractor.
const UNTESTED: &str = "numba, no tests";
/// Starts of a search.
const STARTS: usize = 30;

/// One measurement.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BasinTime {
    scene: &'static str,
    program: String,
    /// The time of the search alone, where there is one, and of all.
    search: Option<f64>,
    seconds: f64,
    /// Attractors, for numba's pendulum none is sought.
    attractors: Option<usize>,
    /// The share of the largest basin.
    share: f64,
    /// The share of labels that are not those of the reference.
    wrong: Option<f64>,
}

#[derive(serde::Deserialize)]
struct Theirs {
    search: Option<f64>,
    seconds: f64,
    attractors: Option<usize>,
    wrong: Option<f64>,
    share: f64,
}

#[derive(serde::Deserialize)]
struct Found {
    rows: Vec<Theirs>,
    /// For each pixel of the pendulum 1 if it rotates, by the reference.
    rotates: Vec<u8>,
}

/// The times of both.
pub(crate) fn basin_times(
    python: &Python,
    folder: &Path,
    progress: &Progress,
) -> Result<Vec<BasinTime>, Error> {
    let bar = progress.bar("basins", 2);
    let (newton, henon) = (newton_starts(), henon_starts());
    let columns =
        |starts: &[[f64; 2]]| [0, 1].map(|k| starts.iter().map(|at| at[k]).collect::<Vec<_>>());
    let job = serde_json::json!({
        "repeats": REPEATS,
        "tests": RecurrenceLimits::default().tests,
        "newton": { "first": columns(&some(&newton)), "starts": columns(&newton), "half": 1.5, "cells": NEWTON, "escape": 1e30 },
        "henon": { "first": columns(&some(&henon)), "starts": columns(&henon), "half": 2.0, "cells": HENON.1, "escape": 100.0 },
        "pendulum": { "side": PENDULUM, "end": END, "reference": REFERENCE, "tolerances": TOLERANCES },
    });
    let [input, output] = ["basins.json", "basins-results.json"].map(|name| folder.join(name));
    write_atomically(&input, job.to_string().as_bytes())?;
    python.run(include_str!("basins.py"), &[&input, &output])?;
    let Found { rows, rotates } = results(&output)?;
    bar.set(1);
    let scenes = ["Newton", "Newton", "Hénon", "Hénon"].into_iter();
    let scenes = scenes.chain(TOLERANCES.map(|_| "pendulum"));
    let names = [UNTESTED, "numba, tests", UNTESTED, "numba, tests"].map(str::to_owned).into_iter();
    let names = names.chain(TOLERANCES.map(|tolerance| format!("numba, DOP853, {tolerance:e}")));
    let mut times: Vec<BasinTime> =
        rows.into_iter()
            .zip(scenes.zip(names))
            .map(|(Theirs { search, seconds, attractors, wrong, share }, (scene, program))| {
                BasinTime { scene, search, program, seconds, attractors, share, wrong }
            })
            .collect();
    times.extend(maps(
        "Newton",
        (&newton_array(), &newton_formulas()?),
        (1.5, NEWTON, None),
        &newton,
    )?);
    let escape = Some(100.0);
    times.extend(maps(
        "Hénon",
        (&henon_array(), &henon_formulas()?),
        (2.0, HENON.1, escape),
        &henon,
    )?);
    for tolerance in TOLERANCES {
        times.push(pendulum(tolerance, &rotates)?);
    }
    times.sort_by_key(|time| {
        ["Newton", "Hénon", "pendulum"].iter().position(|name| *name == time.scene)
    });
    bar.finish();
    Ok(times)
}

/// The times as a table. Ratios are to the fastest of numba in the scene that has at most 10⁻⁴ wrong labels where they are known: of all to those that test
/// attractors, and of the labels without the search.
pub(crate) fn basins_markdown(times: &[BasinTime]) -> String {
    let all = |time: &BasinTime| time.seconds;
    let labels = |time: &BasinTime| time.seconds - time.search.unwrap_or(0.0);
    let least = |scene: &str, of: &dyn Fn(&BasinTime) -> f64, untested: bool| {
        let theirs = times.iter().filter(|time| {
            time.scene == scene
                && time.program.starts_with("numba")
                && (untested || time.program != UNTESTED)
                && time.wrong.is_none_or(|wrong| wrong <= 1e-4)
        });
        theirs.map(of).min_by(f64::total_cmp)
    };
    let row = |time: &BasinTime| {
        let BasinTime { scene, program, search, seconds, attractors, share, wrong } = time;
        let ratio = |of: &dyn Fn(&BasinTime) -> f64, untested| {
            let own = least(scene, of, untested);
            own.map_or("–".to_owned(), |own| format!("{:.2}", of(time) / own))
        };
        let (all, alone) = (ratio(&all, false), ratio(&labels, true));
        let attractors = attractors.map_or("–".to_owned(), |count| count.to_string());
        let wrong = wrong.map_or("–".to_owned(), |wrong| format!("{wrong:.1e}"));
        let search = search.map_or("–".to_owned(), |search| format!("{:.1} ms", 1e3 * search));
        format!(
            "{scene} | {program} | {search} | {:.1} ms | {all} | {alone} | {attractors} | {share:.4} | {wrong}",
            1e3 * seconds
        )
    };
    let heads = "scene | program | search: | all: | ratio of all: | of labels: | attractors: | largest basin: | wrong labels:";
    markdown_table(heads, times.iter().map(row))
}

fn newton_array() -> impl StateMap {
    array_map(|[x, y]| {
        let (a, b) = (x * x - y * y, 2.0 * x * y);
        let d = 3.0 * (a * a + b * b);
        let (u, v) = (2.0 * (a * x - b * y) + 1.0, 2.0 * (a * y + b * x));
        (d > 0.0).then(|| [(u * a + v * b) / d, (v * a - u * b) / d])
    })
}

fn newton_formulas() -> Result<FormulaSteps, Error> {
    let formulas = Formulas::new(Names::new(&["x", "y"], &[])?, |_, z, _| {
        let (x, y) = (z[0], z[1]);
        let (a, b) = (x * x - y * y, 2.0 * x * y);
        let d = 3.0 * (a * a + b * b);
        let (u, v) = (2.0 * (a * x - b * y) + 1.0, 2.0 * (a * y + b * x));
        [(u * a + v * b) / d, (v * a - u * b) / d]
    })?;
    Ok(FormulaSteps::new(&formulas)?)
}

fn henon_array() -> impl StateMap {
    array_map(|[x, y]| Some([1.0 - 1.4 * x * x + y, 0.3 * x]))
}

fn henon_formulas() -> Result<FormulaSteps, Error> {
    let formulas =
        Formulas::from_text(Names::new(&["x", "y"], &[])?, &["1 - 1.4*x^2 + y", "0.3*x"])?;
    Ok(FormulaSteps::new(&formulas)?)
}

fn newton_starts() -> Vec<[f64; 2]> {
    let at = |k: usize| 3.0 * (k as f64 + 0.5) / NEWTON as f64 - 1.5;
    (0..NEWTON * NEWTON).map(|k| [at(k % NEWTON), at(k / NEWTON)]).collect()
}

fn henon_starts() -> Vec<[f64; 2]> {
    let random = SplitMix64::from_seed(3);
    let at = |k: u64| 4.0 * random.uniform(k) - 2.0;
    (0..HENON.0 as u64).map(|k| [at(2 * k), at(2 * k + 1)]).collect()
}

/// Random ones of the starts, from which attractors are searched.
fn some(starts: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let random = SplitMix64::from_seed(2);
    let any = |k: usize| (random.uniform(k as u64) * starts.len() as f64) as usize;
    (0..STARTS).map(|k| starts[any(k)]).collect()
}

/// A map of the plane by a closure and by formulas: the search with its tests, and the labels of all starts.
fn maps(
    scene: &'static str,
    (array, formulas): (&dyn StateMap, &dyn StateMap),
    (half, cells, escape): (f64, usize, Option<f64>),
    starts: &[[f64; 2]],
) -> Result<Vec<BasinTime>, Error> {
    let region = Hyperrectangle::new(vec![Interval::new(-half, half)?; 2])?;
    let limits = RecurrenceLimits { escape, ..RecurrenceLimits::default() };
    let first: Vec<Vec<f64>> = some(starts).iter().map(|start| start.to_vec()).collect();
    let mut times = Vec::new();
    for (program, map) in [("ours, a closure", array), ("ours, formulas", formulas)] {
        let mut best: Option<BasinTime> = None;
        for _ in 0..REPEATS {
            let begin = Instant::now();
            let grid = StateGrid::uniform(region.clone(), cells)?;
            let found = Attractors::search(map, grid, &first, limits)?;
            let search = begin.elapsed().as_secs_f64();
            let at = |k: usize, state: &mut [f64]| state.copy_from_slice(&starts[k]);
            let all = found.convergences(map, starts.len(), at)?;
            let seconds = begin.elapsed().as_secs_f64();
            if best.as_ref().is_none_or(|best| seconds < best.seconds) {
                best = Some(BasinTime {
                    scene,
                    program: program.to_owned(),
                    search: Some(search),
                    seconds,
                    attractors: Some(found.attractors().len()),
                    share: largest_share(all.iter().map(|(label, _)| *label)),
                    wrong: None,
                });
            }
        }
        times.extend(best);
    }
    Ok(times)
}

/// The share of the largest basin.
fn largest_share(labels: impl ExactSizeIterator<Item = Label>) -> f64 {
    let all = labels.len() as f64;
    let mut counts = BTreeMap::new();
    for number in labels.filter_map(Label::basin_number) {
        *counts.entry(number).or_insert(0usize) += 1;
    }
    counts.into_values().max().unwrap_or(0) as f64 / all
}

/// The driven pendulum at a tolerance: attractors by recurrences of the motion over a time step, and the labels of all pixels.
fn pendulum(tolerance: f64, rotates: &[u8]) -> Result<BasinTime, Error> {
    let field = Formulas::from_text(Names::new(&["x", "v"], &[])?, &["v", "0.5 - 0.1*v - sin(x)"])?;
    let sides = vec![Interval::new(-PI, PI)?, Interval::new(-10.0, 10.0)?];
    let region = Hyperrectangle::new(sides)?;
    let limits = RecurrenceLimits { locate: 50, ..RecurrenceLimits::default() };
    let random = SplitMix64::from_seed(1);
    let starts: Vec<Vec<f64>> = (0..10).map(|k| region.random_point(&random, k)).collect();
    let begin = Instant::now();
    let flow = FlowSteps::new(&field, (0.0, STEP), tolerance)?;
    let grid = StateGrid::uniform(region, CELLS)?.periodic(0)?;
    let found = Attractors::search(&flow, grid, &starts, limits)?;
    let search = Some(begin.elapsed().as_secs_f64());
    let side = PENDULUM as f64;
    let all = found.convergences(&flow, PENDULUM * PENDULUM, |k, state| {
        state[0] = TAU * ((k % PENDULUM) as f64 + 0.5) / side - PI;
        state[1] = 20.0 * ((k / PENDULUM) as f64 + 0.5) / side - 10.0;
    })?;
    let seconds = begin.elapsed().as_secs_f64();
    let rotation = found.label(&flow, &[0.0, 5.0]);
    let count = all.len() as f64;
    let wrong =
        all.iter().zip(rotates).filter(|((label, _), own)| (*label == rotation) != (**own == 1));
    Ok(BasinTime {
        scene: "pendulum",
        program: format!("ours, Taylor series, {tolerance:e}"),
        search,
        seconds,
        attractors: Some(found.attractors().len()),
        share: all.iter().filter(|(label, _)| *label == rotation).count() as f64 / count,
        wrong: Some(wrong.count() as f64 / count),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ratio is to the fastest right one, of all to the fastest that tests attractors.
    #[test]
    fn the_ratio_is_to_the_fastest_that_is_right() {
        let time = |program: &str, seconds, wrong| BasinTime {
            scene: "pendulum",
            program: program.to_owned(),
            search: Some(0.5),
            seconds,
            attractors: None,
            share: 0.5,
            wrong: Some(wrong),
        };
        let times = [
            time("numba, a", 1.0, 1e-3),
            time("numba, b", 2.5, 1e-5),
            time(UNTESTED, 2.0, 0.0),
            time("ours", 1.5, 0.0),
        ];
        let text = basins_markdown(&times);
        let last =
            "| pendulum | ours | 500.0 ms | 1500.0 ms | 0.60 | 0.67 | – | 0.5000 | 0.0e0 |\n";
        assert!(text.ends_with(last), "{text}");
    }
}
