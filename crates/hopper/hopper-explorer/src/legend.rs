//! Colours and names of the layers, and the windows of the paper.

use crate::json::{Json, numbers, objects};
use crate::labels;
use basin_of_attraction::Label;
use hopper_basin::{FIG_8, FIG_9, FigureWindow, HopperFate, RASTER_VERSION, first_humps};
use hopper_figures::{
    BesideEdges, Content, LAYERS, Layer, Meaning, Values, WITHOUT_FLAG, fate_colors,
};
use passive_hopper::alpha_star;

/// Colours of a scale of numbers: more are not told apart.
const STEPS: u64 = 32;

/// Fixed points with a name in the legend and a place on the axis.
const FIXED_POINTS: u64 = 64;

/// Colours, names and windows, as JSON.
pub fn legend() -> String {
    legend_json().finish()
}

pub(crate) fn legend_json() -> Json {
    // All fixed points from the last colour on share it.
    let all = (0..=6).map(HopperFate::label_of_fixed_point);
    let mut fates: Vec<Label> = all.collect();
    fates.extend([HopperFate::GROUNDED, HopperFate::UNDECIDED]);
    fates.dedup_by_key(|label| fate_colors::css(*label));
    let humps = first_humps(5);
    Json::object()
        .integer("rasterVersion", u64::from(RASTER_VERSION))
        .json("fates", objects(fates.into_iter().map(labels::label)))
        .json("layers", objects(LAYERS.iter().map(layer)))
        .json("fixedPoints", numbers((0..=FIXED_POINTS).map(alpha_star)))
        .json("home", numbers([0.0, 1.0, humps.left, humps.right]))
        .json("figure8", window(&FIG_8))
        .json("figure9", window(&FIG_9))
}

/// What the page must know of a layer.
fn layer(of: &Layer) -> Json {
    let own = Json::object()
        .text("key", of.key)
        .text("otherKey", of.other_key)
        .text("name", of.name)
        .text("legend", of.legend)
        .text("besideEdges", beside_edges(of))
        .number("cost", of.cost);
    match &of.content {
        Content::Shares(_) => own.text("kind", "shares"),
        Content::Values(values) => {
            let columns = values.table_columns(of.key).join(",");
            let own = own.text("columns", &columns);
            match values.meaning {
                Meaning::Numbers { .. } => {
                    own.text("kind", "numbers").json("scale", objects(scale(values)))
                }
                Meaning::Reals(_) => {
                    own.text("kind", "reals").json("scale", objects(scale(values)))
                }
                Meaning::Fates { flag: None } => own.text("kind", "fates"),
                Meaning::Fates { flag: Some(_) } => {
                    own.text("kind", "fates").text("color", WITHOUT_FLAG.css)
                }
            }
        }
    }
}

/// What it is in the deep view.
fn beside_edges(of: &Layer) -> &'static str {
    match of.beside_edges {
        BesideEdges::Fates => "fates",
        BesideEdges::Phases => "phases",
        BesideEdges::Sides => "sides",
        BesideEdges::Nothing => "nothing",
    }
}

/// The scale of numbers, in equal steps of their places.
fn scale(values: &Values) -> impl Iterator<Item = Json> {
    let steps = (0..=STEPS).map(|step| step as f64 / STEPS as f64);
    values.scale().into_iter().flat_map(move |scale| {
        steps.clone().map(move |place| {
            let number = scale.number(place);
            let [red, green, blue] = scale.color(number);
            Json::object()
                .number("value", number)
                .text("color", &format!("#{red:02x}{green:02x}{blue:02x}"))
        })
    })
}

fn window(of: &FigureWindow) -> Json {
    let ((from, to), (bottom, top)) = *of;
    numbers([from, to, bottom, top])
}
