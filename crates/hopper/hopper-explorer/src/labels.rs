//! Names and colours of labels in answers.

use crate::json::Json;
use basin_of_attraction::Label;
use hopper_basin::HopperFate;
use hopper_figures::fate_colors;

/// A label with its name and its colour.
pub(crate) fn label(label: Label) -> Json {
    Json::object()
        .integer("label", u64::from(label.code()))
        .text("name", &HopperFate::label_name(label))
        .text("plain", &plain(label))
        .text("color", fate_colors::css(label))
}

/// The fate in plain words. The height of a hop grows with the number of its fixed point.
fn plain(label: Label) -> String {
    match label {
        HopperFate::GROUNDED => "comes to rest".into(),
        HopperFate::BEYOND_LABELS => "hops for ever, very high".into(),
        label => match label.basin_number() {
            Some(0) => "ever lower".into(),
            Some(n) => format!("hops for ever, height {n}"),
            None => "undecided".into(),
        },
    }
}
