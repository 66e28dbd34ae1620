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
        .text("color", fate_colors::css(label))
}
