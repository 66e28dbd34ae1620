//! Colours and names of the layers, and the windows of the paper.

use crate::json::{Json, numbers, objects};
use crate::labels;
use crate::tile::{DARKEST_HOPS, ONLY_COMPUTED};
use basin_of_attraction::Label;
use hopper_basin::{FIG_8, FIG_9, FigureWindow, HopperFate, RASTER_VERSION, first_humps};
use hopper_figures::{fate_colors, hop_color};
use passive_hopper::alpha_star;

/// Colours of the scale of hops: more are not told apart.
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
    // Equal steps of the scale are equal steps of log(1 + hops).
    let hops_at = |step: u64| {
        let part = step as f64 / STEPS as f64;
        (pxfm::f_exp(part * pxfm::f_log(1.0 + DARKEST_HOPS as f64)) - 1.0).round() as u64
    };
    let scale = (0..=STEPS).map(|step| {
        let hops = hops_at(step);
        let [red, green, blue] = hop_color(hops, DARKEST_HOPS);
        Json::object()
            .integer("hops", hops)
            .text("color", &format!("#{red:02x}{green:02x}{blue:02x}"))
    });
    let [red, green, blue] = ONLY_COMPUTED;
    let only_computed = Json::object()
        .text("name", "computed, not proved")
        .text("color", &format!("#{red:02x}{green:02x}{blue:02x}"));
    let humps = first_humps(5);
    Json::object()
        .integer("rasterVersion", u64::from(RASTER_VERSION))
        .json("fates", objects(fates.into_iter().map(labels::label)))
        .json("onlyComputed", only_computed)
        .json("hops", objects(scale))
        .json("fixedPoints", numbers((0..=FIXED_POINTS).map(alpha_star)))
        .json("home", numbers([0.0, 1.0, humps.left, humps.right]))
        .json("figure8", window(&FIG_8))
        .json("figure9", window(&FIG_9))
}

fn window(of: &FigureWindow) -> Json {
    let ((from, to), (bottom, top)) = *of;
    numbers([from, to, bottom, top])
}
