//! Fates and their labels.

use crate::errors::value_error;
use crate::interruptible::{Watch, in_background};
use crate::pickling::{Reduced, plain, reduced};
use crate::whole::whole;
use basin_of_attraction::Label;
use hopper_basin::{Fates, HOP_BUDGET, HopperFate};
use pyo3::prelude::*;
use std::sync::Arc;

/// Hops that a fate is followed for before it gets a thread of its own: a millisecond at most. Nearly all fates are
/// known by then, and the thread would take longer than they do.
const QUICK: usize = 1000;

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
    /// The fate of a hopper that is on the ground already.
    pub(crate) fn grounded() -> Self {
        let label = HopperFate::GROUNDED;
        Fate { label: label.code(), name: HopperFate::label_name(label), hops: 0 }
    }

    /// The fate of a speed. Ctrl-C ends the call at once, also where the orbit is long.
    pub(crate) fn of(py: Python<'_>, fates: &Arc<Fates>, alpha: f64) -> PyResult<Self> {
        let (fate, hops) = py.detach(|| fates.fate_within(alpha, QUICK)).map_err(value_error)?;
        let (fate, hops) = match fate {
            HopperFate::Undecided(_) => {
                let fates = Arc::clone(fates);
                let work = move |_: &Watch| fates.fate_within(alpha, HOP_BUDGET);
                in_background(py, work, value_error, |_| Ok(()))?
            }
            decided => (decided, hops),
        };
        let label = fate.label();
        Ok(Fate { label: label.code(), name: HopperFate::label_name(label), hops })
    }
}

plain!(Fate { label, name, hops });

#[pymethods]
impl Fate {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

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
pub(crate) fn label_name(#[pyo3(from_py_with = whole)] label: u16) -> String {
    HopperFate::label_name(Label::from_code(label))
}

/// The colour of a label in the figures, as CSS.
#[pyfunction]
pub(crate) fn label_colour(#[pyo3(from_py_with = whole)] label: u16) -> &'static str {
    hopper_figures::fate_colors::css(Label::from_code(label))
}
