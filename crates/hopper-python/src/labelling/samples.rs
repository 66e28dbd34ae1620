//! Random points of a region, labelled by a vectorised function.
//!
//! The library asks for one label at a time, on several threads. A function of Python is fast for many points at once. So the sampling is
//! repeated: a run notes the points whose labels are not known, Python labels all of them in one call, and the last run meets none. The
//! points depend on the seed alone, so that every run has the same ones.

use super::interval::Interval;
use crate::errors::value_error;
use basin_of_attraction::{Error, Hyperrectangle, Label};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Mutex, PoisonError};

/// The labels of points, by the bits of their coordinates.
type Known = HashMap<Vec<u64>, Label>;

/// What `sample` finds with the labels of a function.
fn labelled<T: Send>(
    py: Python<'_>,
    function: &Bound<'_, PyAny>,
    dimension: usize,
    sample: impl Fn(&(dyn Fn(&[f64]) -> Label + Sync)) -> Result<T, Error> + Sync,
) -> PyResult<T> {
    let mut known = Known::new();
    // Each run but the last adds points: a sampling stops early at a label that it cannot use, and then goes on to the next points.
    loop {
        let unknown: Mutex<Vec<Vec<f64>>> = Mutex::default();
        let read = |point: &[f64]| {
            known.get(&bits(point)).copied().unwrap_or_else(|| {
                unknown.lock().unwrap_or_else(PoisonError::into_inner).push(point.to_vec());
                Label::UNDECIDED
            })
        };
        let found = py.detach(|| sample(&read));
        let points = unknown.into_inner().unwrap_or_else(PoisonError::into_inner);
        if points.is_empty() {
            return found.map_err(value_error);
        }
        let columns: Vec<Bound<'_, PyAny>> = (0..dimension)
            .map(|k| PyArray1::from_iter(py, points.iter().map(|point| point[k])).into_any())
            .collect();
        let labels = function.call1(PyTuple::new(py, columns)?)?;
        let labels: PyReadonlyArray1<'_, u16> = labels.extract()?;
        let labels = labels.as_array();
        if labels.len() != points.len() {
            let (found, all) = (labels.len(), points.len());
            let text = format!("the labelling returned {found} labels for {all} points");
            return Err(PyValueError::new_err(text));
        }
        let pairs = points.iter().zip(labels.iter());
        known.extend(pairs.map(|(point, &code)| (bits(point), Label::from_code(code))));
    }
}

/// The bits of the coordinates of a point.
fn bits(point: &[f64]) -> Vec<u64> {
    point.iter().map(|x| x.to_bits()).collect()
}

/// The region of a window: one pair of ends for each coordinate.
fn region_of(window: &[(f64, f64)]) -> PyResult<Hyperrectangle> {
    let side = |&(left, right): &(f64, f64)| basin_of_attraction::Interval::new(left, right);
    let sides = window.iter().map(side).collect::<Result<_, Error>>().map_err(value_error)?;
    Hyperrectangle::new(sides).map_err(value_error)
}

/// As passive_hopper.labelling.region_fractions, for a function that returns an array of uint16.
#[pyfunction]
pub(crate) fn region_fractions(
    py: Python<'_>,
    label: &Bound<'_, PyAny>,
    window: Vec<(f64, f64)>,
    count: usize,
    seed: u64,
) -> PyResult<BTreeMap<u16, Interval>> {
    let region = region_of(&window)?;
    let counts = labelled(py, label, window.len(), |label| {
        basin_of_attraction::region_fractions(&region, count, seed, label)
    })?;
    let fraction = |label: Label| Ok((label.code(), counts.fraction(label)?.into()));
    counts.basins().map(fraction).collect::<Result<_, Error>>().map_err(value_error)
}

/// The uncertainty exponent of a labelling: the fraction of pairs of points at a distance ε whose labels differ is ∝ ε^exponent.
#[pyclass(frozen, get_all, eq, module = "passive_hopper.labelling")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct UncertaintyExponent {
    /// The exponent, with a 95 % interval. It means nothing unless follows_a_power_law.
    exponent: Interval,
    /// Whether chance explains the deviations from the power law.
    follows_a_power_law: bool,
    /// For each ε, in increasing order: ε and the fraction of uncertain pairs.
    fractions: Vec<(f64, Interval)>,
}

#[pymethods]
impl UncertaintyExponent {
    fn __repr__(&self) -> String {
        let law = if self.follows_a_power_law { "True" } else { "False" };
        format!("UncertaintyExponent({}, follows_a_power_law={law})", self.exponent.__repr__())
    }
}

/// As passive_hopper.labelling.uncertainty_exponent, for a function that returns an array of uint16.
#[pyfunction]
pub(crate) fn uncertainty_exponent(
    py: Python<'_>,
    label: &Bound<'_, PyAny>,
    window: Vec<(f64, f64)>,
    epsilons: Vec<f64>,
    count: usize,
    seed: u64,
) -> PyResult<UncertaintyExponent> {
    let region = region_of(&window)?;
    let found = labelled(py, label, window.len(), |label| {
        basin_of_attraction::uncertainty_exponent(&region, &epsilons, count, seed, label)
    })?;
    let fractions = found.counts.iter().map(|pairs| Ok((pairs.epsilon, pairs.fraction()?.into())));
    Ok(UncertaintyExponent {
        exponent: found.exponent.into(),
        follows_a_power_law: found.follows_a_power_law(),
        fractions: fractions.collect::<Result<_, Error>>().map_err(value_error)?,
    })
}
