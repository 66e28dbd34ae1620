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
/// Random starts of Hénon's map, and its cells. Numba's loops also have four times as many, which our search comes to as the tests refuse coarser ones.
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
/// Starts of a search.
const STARTS: usize = 30;

/// One measurement.
#[derive(Debug, Clone, PartialEq, serde::Deserialize)]
pub(crate) struct BasinTime {
    scene: String,
    program: String,
    /// Whether it is of this repository, and whether it tests attractors.
    #[serde(default)]
    ours: bool,
    tested: bool,
    /// The time of the search alone, where there is one, and of all.
    search: Option<f64>,
    seconds: f64,
    /// Attractors, for numba's pendulum none is sought; and those that failed the tests.
    attractors: Option<usize>,
    refused: usize,
    /// The share of the largest basin.
    share: f64,
    /// The share of labels that are undecided, or whose start ends elsewhere than most starts with this label.
    wrong: f64,
}

#[derive(serde::Deserialize)]
struct Found {
    rows: Vec<BasinTime>,
    /// For each scene where each start ends, as a number, by many plain steps or by a small tolerance.
    ends: BTreeMap<String, Vec<u8>>,
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
        "Newton": { "first": columns(&some(&newton)), "starts": columns(&newton), "half": 1.5, "cells": [NEWTON], "escape": 1e30 },
        "Hénon": { "first": columns(&some(&henon)), "starts": columns(&henon), "half": 2.0, "cells": [HENON.1, 4 * HENON.1 + 3], "escape": 100.0 },
        "pendulum": { "side": PENDULUM, "end": END, "reference": REFERENCE, "tolerances": TOLERANCES },
    });
    let [input, output] = ["basins.json", "basins-results.json"].map(|name| folder.join(name));
    write_atomically(&input, job.to_string().as_bytes())?;
    python.run(include_str!("basins.py"), &[&input, &output])?;
    let Found { rows: mut times, ends } = results(&output)?;
    bar.set(1);
    let of = |scene: &str| ends.get(scene).map_or(&[][..], Vec::as_slice);
    let newton_maps: (&dyn StateMap, &dyn StateMap) = (&newton_array(), &newton_formulas()?);
    times.extend(maps("Newton", newton_maps, (1.5, NEWTON, None), &newton, of("Newton"))?);
    let henon_maps: (&dyn StateMap, &dyn StateMap) = (&henon_array(), &henon_formulas()?);
    times.extend(maps("Hénon", henon_maps, (2.0, HENON.1, Some(100.0)), &henon, of("Hénon"))?);
    for tolerance in TOLERANCES {
        times.push(pendulum(tolerance, of("pendulum"))?);
    }
    times.sort_by_key(|time| {
        ["Newton", "Hénon", "pendulum"].iter().position(|name| *name == time.scene)
    });
    bar.finish();
    Ok(times)
}

/// The most wrong labels of a program to which others are compared.
const MOST_WRONG: f64 = 1e-4;

/// The times as a table. Ratios are to the fastest of numba in the scene that has few wrong labels: of all to those that test attractors, and of the labels
/// without the search to all of them.
pub(crate) fn basins_markdown(times: &[BasinTime]) -> String {
    let all = |time: &BasinTime| time.seconds;
    let labels = |time: &BasinTime| time.seconds - time.search.unwrap_or(0.0);
    let least = |scene: &str, of: &dyn Fn(&BasinTime) -> f64, untested: bool| {
        let theirs = times.iter().filter(|time| {
            !time.ours
                && time.scene == scene
                && (untested || time.tested)
                && time.wrong <= MOST_WRONG
        });
        theirs.map(of).min_by(f64::total_cmp)
    };
    let row = |time: &BasinTime| {
        let ratio = |of: &dyn Fn(&BasinTime) -> f64, untested| {
            let own = least(&time.scene, of, untested);
            own.map_or("–".to_owned(), |own| format!("{:.2}", of(time) / own))
        };
        let (all, alone) = (ratio(&all, false), ratio(&labels, true));
        let BasinTime { scene, program, search, seconds, share, wrong, .. } = time;
        let search = search.map_or("–".to_owned(), |search| format!("{:.1} ms", 1e3 * search));
        let attractors = match (time.attractors, time.refused) {
            (None, _) => "–".to_owned(),
            (Some(count), 0) => count.to_string(),
            (Some(count), refused) => format!("{count}, {refused} fail"),
        };
        format!(
            "{scene} | {program} | {search} | {:.1} ms | {all} | {alone} | {attractors} | {share:.4} | {wrong:.1e}",
            1e3 * seconds
        )
    };
    let heads = "scene | program | search: | all: | ratio of all: | of labels: | attractors: | largest basin: | wrong labels:";
    markdown_table(heads, times.iter().map(row))
}

/// The share of labels that are undecided, or whose start ends elsewhere than most starts with this label.
fn wrong(labels: &[Label], ends: &[u8]) -> f64 {
    let mut counts: BTreeMap<Label, BTreeMap<u8, usize>> = BTreeMap::new();
    for (label, end) in labels.iter().zip(ends).filter(|(label, _)| label.is_decided()) {
        *counts.entry(*label).or_default().entry(*end).or_default() += 1;
    }
    let right: usize = counts.values().filter_map(|own| own.values().max()).sum();
    1.0 - right as f64 / labels.len() as f64
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
    ends: &[u8],
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
                let labels: Vec<Label> = all.iter().map(|(label, _)| *label).collect();
                let times = (Some(search), seconds);
                best = Some(measured(scene, program.to_owned(), times, &found, &labels, ends));
            }
        }
        times.extend(best);
    }
    Ok(times)
}

/// A measurement of ours.
fn measured(
    scene: &str,
    program: String,
    (search, seconds): (Option<f64>, f64),
    found: &Attractors,
    labels: &[Label],
    ends: &[u8],
) -> BasinTime {
    BasinTime {
        scene: scene.to_owned(),
        program,
        ours: true,
        tested: true,
        search,
        seconds,
        attractors: Some(found.attractors().len()),
        refused: 0,
        share: largest_share(labels),
        wrong: wrong(labels, ends),
    }
}

/// The share of the largest basin.
fn largest_share(labels: &[Label]) -> f64 {
    let mut counts = BTreeMap::new();
    for number in labels.iter().filter_map(|label| label.basin_number()) {
        *counts.entry(number).or_insert(0usize) += 1;
    }
    counts.into_values().max().unwrap_or(0) as f64 / labels.len() as f64
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
    let labels: Vec<Label> = all.into_iter().map(|(label, _)| label).collect();
    let program = format!("ours, Taylor series, {tolerance:e}");
    Ok(measured("pendulum", program, (search, seconds), &found, &labels, rotates))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The ratio is to the fastest right one, of all to the fastest that tests attractors.
    #[test]
    fn the_ratio_is_to_the_fastest_that_is_right() {
        let time = |program: &str, seconds, wrong, (ours, tested)| BasinTime {
            scene: "pendulum".to_owned(),
            program: program.to_owned(),
            ours,
            tested,
            search: Some(0.5),
            seconds,
            attractors: Some(3),
            refused: usize::from(seconds == 2.5),
            share: 0.5,
            wrong,
        };
        let times = [
            time("a", 1.0, 1e-3, (false, true)),
            time("b", 2.5, 1e-5, (false, true)),
            time("c", 2.0, 0.0, (false, false)),
            time("ours", 1.5, 0.0, (true, true)),
        ];
        let text = basins_markdown(&times);
        let last =
            "| pendulum | ours | 500.0 ms | 1500.0 ms | 0.60 | 0.67 | 3 | 0.5000 | 0.0e0 |\n";
        assert!(text.ends_with(last) && text.contains("| 3, 1 fail |"), "{text}");
    }

    /// A label is what most of its starts are.
    #[test]
    fn a_label_is_wrong_where_most_others_end_elsewhere() {
        let labels = [1, 1, 1, 2, 2].map(Label::from);
        assert_eq!(wrong(&labels, &[7, 7, 8, 9, 9]), 1.0 - 4.0 / 5.0);
        assert_eq!(wrong(&labels, &[0, 0, 0, 1, 1]), 0.0);
        assert_eq!(wrong(&[Label::UNDECIDED, Label::from(1)], &[0, 1]), 0.5);
    }
}
