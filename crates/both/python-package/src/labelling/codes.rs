//! The codes of labels that are no basins.

use basin_of_attraction::Label;
use pyo3::prelude::*;
use std::collections::BTreeMap;

/// The codes of labels that are no basins, by name.
#[pyfunction]
pub(crate) fn label_codes() -> BTreeMap<&'static str, u16> {
    let codes = [
        ("UNDECIDED", Label::UNDECIDED),
        ("UNDECIDED_PRECISION", Label::UNDECIDED_PRECISION),
        ("UNDECIDED_MAP", Label::UNDECIDED_MAP),
        ("OUTSIDE", Label::OUTSIDE),
        ("ESCAPED", Label::ESCAPED),
    ];
    codes.into_iter().map(|(name, label)| (name, label.code())).collect()
}
