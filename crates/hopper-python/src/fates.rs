//! Fates and their labels.

use basin_of_attraction::Label;
use hopper_basin::{Fates, HOP_BUDGET, HopperFate};
use pyo3::prelude::*;

/// The long-term behaviour of a hopper.
#[pyclass(frozen, get_all, eq, module = "passive_hopper")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Fate {
    /// The label: n for convergence to α*_n, 0 for decaying; label_name(label) names the others.
    label: u16,
    /// The label in words.
    name: String,
    /// The number of hops after which the fate was known.
    hops: usize,
}

impl Fate {
    pub(crate) fn of(fates: &Fates, alpha: f64) -> Result<Self, hopper_basin::Error> {
        let (fate, hops) = fates.fate_within(alpha, HOP_BUDGET)?;
        let label = fate.label();
        Ok(Fate { label: label.code(), name: HopperFate::label_name(label), hops })
    }
}

#[pymethods]
impl Fate {
    fn __repr__(&self) -> String {
        format!("Fate(label={}, name={:?}, hops={})", self.label, self.name, self.hops)
    }
}

/// The name of a label of fates and basins.
///
/// >>> from passive_hopper import label_name
/// >>> label_name(0)
/// 'decaying'
#[pyfunction]
pub(crate) fn label_name(label: u16) -> String {
    HopperFate::label_name(Label::from_code(label))
}

/// The colour of a label in the figures, as CSS.
#[pyfunction]
pub(crate) fn label_colour(label: u16) -> &'static str {
    hopper_figures::fate_colors::css(Label::from_code(label))
}
