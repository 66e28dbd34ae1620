//! The map at one mass ratio: pieces of its graph, fixed points, traps and crises.

use crate::json::{Json, numbers, objects};
use crate::point::trap_json;
use crate::refusal::Refusal;
use hopper_basin::{Crisis, HopperFate, Trap, crisis, grounding};
use hopper_figures::{Graph, cuts_between, fate_colors};
use passive_hopper::{LiftOffMap, MassRatio, index_below};

/// Fixed points whose traps and crises are listed. More are no longer told apart in the panel.
const MOST_FIXED_POINTS: usize = 16;

/// Most points of a piece.
const MOST_POINTS: usize = 2000;

/// The map between two speeds, each piece with `points` + 1 points, as JSON.
///
/// # Errors
/// The refusals of the libraries for numbers outside the model, and for windows of more than 200 humps.
pub fn map(mass_ratio: f64, from: f64, to: f64, points: usize) -> Result<String, Refusal> {
    Ok(map_json(mass_ratio, from, to, points)?.finish())
}

pub(crate) fn map_json(
    mass_ratio: f64,
    from: f64,
    to: f64,
    points: usize,
) -> Result<Json, Refusal> {
    let ratio = MassRatio::new(mass_ratio)?;
    let map = LiftOffMap::new(ratio);
    let graph = Graph::drawn(&map, &cuts_between(from, to)?, points.clamp(1, MOST_POINTS));
    let piece = |piece: &Vec<(f64, f64)>| {
        let both = piece.iter().flat_map(|&(alpha, next)| [alpha, next]);
        Json::object().json("points", numbers(both))
    };
    let inside = index_below(from)?..=index_below(to)?;
    let stars = inside.take(MOST_FIXED_POINTS).map(|n| star_json(n, ratio));
    Ok(Json::object()
        .json("pieces", objects(graph.pieces.iter().map(piece)))
        .integer("undecided", graph.undecided.len() as u64)
        .json("stars", objects(stars.collect::<Result<Vec<_>, Refusal>>()?)))
}

/// A fixed point with its trap; from the first on, with the mass ratios of its crisis and of grounding.
fn star_json(n: u64, ratio: MassRatio) -> Result<Json, Refusal> {
    let label = HopperFate::label_of_fixed_point(n);
    let star = Json::object()
        .integer("n", n)
        .text("color", fate_colors::css(label))
        .text("light", fate_colors::light_css(label))
        .json("trap", trap_json(&Trap::new(n, ratio)?));
    // Orbits of hump 0 cannot fall below 0; they come to the ground.
    let star = if n == 0 { star } else { star.json("crisis", at(&crisis(n)?)) };
    Ok(star.json("grounding", at(&grounding(n)?)))
}

fn at(crisis: &Crisis) -> Json {
    Json::object().number("massRatio", crisis.mass_ratio).number("alpha", crisis.alpha)
}
