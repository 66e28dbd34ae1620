//! Which model answers which question, with the time and the error of each.

use super::methods::Method;
use super::score::Score;
use crate::error::Error;
use crate::reference::WINDOW;
use crate::repository::{number, parse_rows, read, repository};
use crate::text::digit;
use crate::timing::median_time;
use basin_of_attraction::{Grid, Interval};
use hopper_asymptotics::Decay;
use hopper_basin::{Fates, HopperFate, Trap, basin_raster, first_humps};
use hybrid_system::{Execution, Limits};
use passive_hopper::{Hopper, HopperState, LiftOffMap, MassRatio, Phase};
use serde_json::Value;
use std::ops::ControlFlow;
use std::time::Duration;

/// A question and the cheapest model that answers it.
#[derive(Debug, Clone)]
pub(crate) struct Scene {
    pub(crate) question: &'static str,
    pub(crate) model: &'static str,
    pub(crate) call: &'static str,
    pub(crate) time: Duration,
    /// The unit of work that `time` is for.
    pub(crate) per: &'static str,
    pub(crate) error: String,
}

/// All scenes. The scenes about single hops take their numbers from the scores.
pub(crate) fn scenes(scores: &[Score]) -> Result<Vec<Scene>, Error> {
    Ok([
        single_hops(scores),
        vec![slopes()?, orbit()?, decay()?, motion()?, fate()?, raster()?, trap()?],
    ]
    .concat())
}

/// Files of reference values, from the root of the repository.
const ORBITS: &str = "crates/hopper/passive-hopper/tests/data/orbits.jsonl";
const FATES: &str = "crates/hopper/hopper-basin/tests/data/fates.jsonl";
const TRAPS: &str = "crates/hopper/hopper-basin/tests/data/local_basin.json";

fn single_hops(scores: &[Score]) -> Vec<Scene> {
    let known = [
        (
            "where does it lift off next?",
            "landings only, no contact phase",
            "`LiftOffMap::image`",
            "window",
            Method::Stable,
        ),
        (
            "the same, very close to a lossless hop",
            "the hop in (n, δ)",
            "`LiftOffMap::hop_near_fixed_point`",
            "near_fixed_point",
            Method::Local,
        ),
        (
            "the same, within 0.1 of a lossless hop, roughly",
            "five terms of a series",
            "`RightExpansion`, `LeftExpansion`",
            "near_fixed_point",
            Method::Asymptotics,
        ),
        (
            "what does a tiny hop lose?",
            "landings only",
            "`Hop::loss`",
            "tiny_alpha",
            Method::Stable,
        ),
        (
            "a system like it, without closed form",
            "differential equations and guards",
            "`Integration`, 1e-9",
            "window",
            Method::Integrated(9),
        ),
    ];
    let row = |(question, model, call, class, method)| {
        let score = scores.iter().find(|s| s.class == class && s.method == method)?;
        let (median, worst) = score.errors?;
        let time = score.time?;
        let error = spread_of(median, worst);
        Some(Scene { question, model, call, time, per: "a hop", error })
    };
    known.into_iter().filter_map(row).collect()
}

fn mass_ratio(row: &Value) -> Result<MassRatio, Error> {
    Ok(MassRatio::new(field(row, "mass_ratio")?)?)
}

fn field(row: &Value, key: &str) -> Result<f64, Error> {
    number(row, key).map_err(|reason| Error::Reference { reason })
}

fn slopes() -> Result<Scene, Error> {
    let mut inputs = Vec::new();
    for row in parse_rows(&repository().join(WINDOW))? {
        if row.get("dalpha_next_dalpha").is_some() {
            let exact = [field(&row, "dalpha_next_dalpha")?, field(&row, "dalpha_next_dM")?];
            inputs.push((LiftOffMap::new(mass_ratio(&row)?), field(&row, "alpha")?, exact));
        }
    }
    let mut errors = Vec::new();
    for (map, alpha, [by_speed, by_mass_ratio]) in &inputs {
        if let Some(slopes) = map.slopes(*alpha)? {
            // Derivatives pass through zero, where a relative error has no meaning: the scale is at least 1.
            let scale = by_speed.abs().max(by_mass_ratio.abs()).max(1.0);
            let off = (slopes.by_speed - by_speed).abs();
            errors.push(off.max((slopes.by_mass_ratio - by_mass_ratio).abs()) / scale);
        }
    }
    let time = median_time(inputs.len(), |k| inputs[k].0.slopes(inputs[k].1));
    Ok(Scene {
        question: "how sensitive is it?",
        model: "variations along the flights",
        call: "`LiftOffMap::slopes`",
        time,
        per: "a hop",
        error: spread(&mut errors),
    })
}

fn spread(errors: &mut [f64]) -> String {
    errors.sort_by(f64::total_cmp);
    match errors {
        [] => "–".into(),
        [.., worst] => {
            let worst = *worst;
            spread_of(errors[errors.len() / 2], worst)
        }
    }
}

fn spread_of(median: f64, worst: f64) -> String {
    format!("{}, at worst {}", digit(median), digit(worst))
}

fn orbit() -> Result<Scene, Error> {
    let rows = parse_rows(&repository().join(ORBITS))?;
    let mut errors = Vec::new();
    for row in &rows {
        let (n, hops) = (field(row, "n")? as u64, field(row, "hops")? as u64);
        let map = LiftOffMap::new(mass_ratio(row)?);
        let mut delta = field(row, "offset")?;
        for _ in 0..hops {
            let next = map.hop_near_fixed_point(n, delta)?.next;
            delta = next.ok_or_else(|| Error::Reference { reason: "an orbit ended".into() })?;
        }
        errors.push((delta / field(row, "offset_after")? - 1.0).abs());
    }
    let map = LiftOffMap::new(MassRatio::ONE);
    let time = median_time(1000, |k| map.hop_near_fixed_point(1, 1e-5 / (k + 1) as f64));
    Ok(Scene {
        question: "ten thousand hops of the slow approach",
        model: "hops in (n, δ), one after the other",
        call: "`LiftOffMap::hop_near_fixed_point`",
        time,
        per: "a hop",
        error: format!("{} of δ after up to 10⁴ hops", spread(&mut errors)),
    })
}

fn decay() -> Result<Scene, Error> {
    let mut inputs = Vec::new();
    for row in parse_rows(&repository().join(ORBITS))? {
        let law = Decay::new(field(&row, "n")? as u64, mass_ratio(&row)?)?;
        let ends = (field(&row, "offset")?, field(&row, "offset_after")?);
        inputs.push((law, ends, field(&row, "hops")?));
    }
    let mut errors = Vec::new();
    for (law, (start, end), hops) in &inputs {
        errors.push((law.hops(*start, *end)?.value / hops - 1.0).abs());
    }
    let time = median_time(inputs.len(), |k| inputs[k].0.hops(inputs[k].1.0, inputs[k].1.1));
    Ok(Scene {
        question: "how many hops until it is that close?",
        model: "the law of the approach",
        call: "`Decay::hops`",
        time,
        per: "an answer",
        error: format!("{} of the number of hops", spread(&mut errors)),
    })
}

/// A picture of the motion: two arcs with a hundred states along each.
fn motion() -> Result<Scene, Error> {
    const STATES: u32 = 100;
    let mut inputs = Vec::new();
    for row in parse_rows(&repository().join(WINDOW))? {
        let first = row.get("flight_times").and_then(|times| times.get(0));
        let time = first.and_then(Value::as_str).and_then(|text| text.parse::<f64>().ok());
        let time = time.ok_or_else(|| Error::Reference { reason: "no flight time".into() })?;
        inputs.push((Hopper::new(mass_ratio(&row)?), field(&row, "alpha")?, time));
    }
    let arcs = |hopper: &Hopper, alpha: f64, states: u32| {
        let start = HopperState::lift_off(alpha).into();
        let limits = Limits::new(f64::INFINITY, 2);
        let mut time = 0.0;
        let mut highest = 0.0f64;
        for arc in Execution::new(hopper, Phase::Flight, start, limits) {
            let arc = arc?;
            if time == 0.0 {
                time = arc.duration;
            }
            for k in 0..states {
                let part = f64::from(k) / f64::from(states);
                highest = highest.max(arc.state(hopper, part * arc.duration)?[0]);
            }
        }
        Ok::<_, hybrid_system::Error>((time, highest))
    };
    let mut errors = Vec::new();
    for (hopper, alpha, time) in &inputs {
        errors.push((arcs(hopper, *alpha, 0)?.0 / time - 1.0).abs());
    }
    let time = median_time(inputs.len(), |k| arcs(&inputs[k].0, inputs[k].1, STATES));
    Ok(Scene {
        question: "what does the motion look like?",
        model: "arcs of both masses, sampled where they are drawn",
        call: "`Execution`, `Arc::state`",
        time,
        per: "for 2 arcs with 200 states",
        error: format!("{} of the time of flight", spread(&mut errors)),
    })
}

fn fate() -> Result<Scene, Error> {
    let mut inputs = Vec::new();
    for row in parse_rows(&repository().join(FATES))? {
        let fate = match row.get("fate").and_then(Value::as_str) {
            Some("incessant") => HopperFate::Incessant { n: field(&row, "n")? as u64 },
            Some("decaying") => HopperFate::Decaying,
            _ => HopperFate::Grounded,
        };
        inputs.push((Fates::new(mass_ratio(&row)?)?, field(&row, "alpha")?, fate));
    }
    let wrong = inputs.iter().filter(|(fates, alpha, fate)| fates.fate(*alpha) != Ok(*fate));
    let error = format!("{} wrong of {}", wrong.count(), inputs.len());
    let time = median_time(inputs.len(), |k| inputs[k].0.fate(inputs[k].1));
    Ok(Scene {
        question: "where does it end?",
        model: "traps and the map",
        call: "`Fates::fate`",
        time,
        per: "a start",
        error,
    })
}

fn raster() -> Result<Scene, Error> {
    /// Pixels along each side. The number is large enough for the typical cost of a pixel, and a raster takes only some
    /// milliseconds.
    const SIDE: usize = 256;
    let grid = Grid { x: Interval::new(0.1, 1.0)?, y: first_humps(5), columns: SIDE, rows: SIDE };
    let image = || basin_raster(grid, |_| ControlFlow::Continue(()));
    let undecided = image()?.labels.iter().filter(|&&label| label.is_undecided()).count();
    let time = median_time(1, |_| image()).div_f64((SIDE * SIDE) as f64);
    Ok(Scene {
        question: "the basins over (M, α), as in Fig. 6",
        model: "traps once a column, orbits only where fates may part, all cores",
        call: "`basin_raster`",
        time,
        per: "a pixel of 256²",
        error: format!("fates as above, {undecided} undecided"),
    })
}

fn trap() -> Result<Scene, Error> {
    let text = read(&repository().join(TRAPS))?;
    let rows: Vec<Value> =
        serde_json::from_str(&text).map_err(|e| Error::Reference { reason: e.to_string() })?;
    let (mut inputs, mut errors) = (Vec::new(), Vec::new());
    for row in &rows {
        let edge = row.get("edge").and_then(Value::as_str).unwrap_or_default();
        if edge.starts_with("contact") {
            let (n, ratio) = (field(row, "n")? as u64, mass_ratio(row)?);
            errors.push((Trap::new(n, ratio)?.delta / field(row, "delta_exact")? - 1.0).abs());
            inputs.push((n, ratio));
        }
    }
    let time = median_time(inputs.len(), |k| Trap::new(inputs[k].0, inputs[k].1));
    Ok(Scene {
        question: "how far does an attractor reach?",
        model: "the edge of its trap, one equation",
        call: "`Trap::new`",
        time,
        per: "a trap",
        error: format!("{} of Δ", spread(&mut errors)),
    })
}
