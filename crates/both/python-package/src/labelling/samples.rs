//! Random points of a region, labelled by a vectorised function.
//!
//! The library asks for one label at a time, on several threads. A function of Python is fast for many points at
//! once. So the sampling is repeated: a run notes the points whose labels are not known, Python labels all of them
//! in one call, and the last run meets none. The points depend on the seed alone, so that every run has the same
//! ones.

use super::interval::Interval;
use crate::errors::{InputError, of_callback, value_error};
use crate::interruptible::{Watch, in_background};
use crate::pickling::{Reduced, plain, reduced};
use crate::whole::{room_for, whole};
use basin_of_attraction::{Error, Hyperrectangle, Label};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::collections::{BTreeMap, HashMap};
use std::sync::{Arc, Mutex, PoisonError};

/// The labels of points, by the bits of their coordinates.
type Known = HashMap<Vec<u64>, Label>;

/// What one run of a sampling gives.
struct Run<T> {
    found: Result<T, Error>,
    known: Known,
    /// The points without a known label, and the same as one array for each coordinate.
    points: Vec<Vec<f64>>,
    columns: Vec<Vec<f64>>,
}

/// What `sample` finds with the labels of a function. Ctrl-C ends a call at once, also where there are millions of
/// points.
fn labelled<T: Send + 'static>(
    py: Python<'_>,
    function: &Bound<'_, PyAny>,
    dimension: usize,
    sample: impl Fn(&(dyn Fn(&[f64]) -> Label + Sync)) -> Result<T, Error> + Send + Sync + 'static,
) -> PyResult<T> {
    let sample = Arc::new(sample);
    let (mut known, mut labels) = (Known::new(), Vec::<(Vec<f64>, u16)>::new());
    // Each run but the last adds points: a sampling stops early at a label that it cannot use, and then goes on to
    // the next points.
    loop {
        let sample = Arc::clone(&sample);
        let work = move |watch: &Watch| {
            let new = labels.into_iter().take_while(|_| !watch.is_stopped());
            known.extend(new.map(|(point, code)| (bits(&point), Label::from_code(code))));
            let unknown: Mutex<Vec<Vec<f64>>> = Mutex::default();
            let read = |point: &[f64]| match known.get(&bits(point)) {
                Some(&label) => label,
                None if watch.is_stopped() => Label::UNDECIDED,
                None => {
                    unknown.lock().unwrap_or_else(PoisonError::into_inner).push(point.to_vec());
                    Label::UNDECIDED
                }
            };
            let found = sample(&read);
            let points = unknown.into_inner().unwrap_or_else(PoisonError::into_inner);
            let column = |k: usize| points.iter().map(|point| point[k]).collect();
            let columns = (0..dimension).map(column).collect();
            Ok::<_, Error>(Run { found, known, points, columns })
        };
        let run = in_background(py, work, value_error, |_| Ok(()))?;
        if run.points.is_empty() {
            return run.found.map_err(value_error);
        }
        let columns = run.columns.into_iter().map(|column| PyArray1::from_vec(py, column));
        let codes = function
            .call1(PyTuple::new(py, columns.collect::<Vec<_>>())?)
            .map_err(|error| of_callback(py, "label", error))?;
        let codes: PyReadonlyArray1<'_, u16> = codes.extract()?;
        let codes = codes.as_array();
        if codes.len() != run.points.len() {
            let (found, all) = (codes.len(), run.points.len());
            let text = format!("the labelling returned {found} labels for {all} points");
            return Err(InputError::new_err(text));
        }
        known = run.known;
        labels = run.points.into_iter().zip(codes.iter().copied()).collect();
    }
}

/// Bytes for each coordinate of a point: its bits as a key, in the list of the unknown, and in a column for Python.
const COORDINATE: usize = 3 * size_of::<f64>();

/// Bytes for each point beside its coordinates: two lists and an entry of a table, which is half empty.
const POINT: usize = 2 * size_of::<Vec<f64>>() + 2 * size_of::<(Vec<u64>, Label)>();

/// The bits of the coordinates of a point.
fn bits(point: &[f64]) -> Vec<u64> {
    point.iter().map(|x| x.to_bits()).collect()
}

/// The region of a window: one pair of ends for each coordinate.
pub(crate) fn region_of(window: &[[f64; 2]]) -> PyResult<Hyperrectangle> {
    let side = |&[left, right]: &[f64; 2]| basin_of_attraction::Interval::new(left, right);
    let sides = window.iter().map(side).collect::<Result<_, Error>>().map_err(value_error)?;
    Hyperrectangle::new(sides).map_err(value_error)
}

/// As nonsmooth.labelling.region_fractions, for a function that returns an array of uint16.
#[pyfunction]
pub(crate) fn region_fractions(
    py: Python<'_>,
    label: &Bound<'_, PyAny>,
    window: Vec<[f64; 2]>,
    #[pyo3(from_py_with = whole)] count: usize,
    #[pyo3(from_py_with = whole)] seed: u64,
) -> PyResult<BTreeMap<u16, Interval>> {
    let region = region_of(&window)?;
    room_for(count, POINT + window.len() * COORDINATE)?;
    let counts = labelled(py, label, window.len(), move |label| {
        basin_of_attraction::region_fractions(&region, count, seed, label)
    })?;
    let fraction = |label: Label| Ok((label.code(), counts.fraction(label)?.into()));
    counts.basins().map(fraction).collect::<Result<_, Error>>().map_err(value_error)
}

/// The uncertainty exponent of a labelling: the fraction of pairs of points at a distance ε whose labels differ is
/// ∝ ε^exponent.
#[pyclass(frozen, get_all, eq, module = "nonsmooth.labelling")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct UncertaintyExponent {
    /// The exponent, with a 95 % interval. It means nothing unless follows_a_power_law.
    exponent: Interval,
    /// Whether chance explains the deviations from the power law.
    follows_a_power_law: bool,
    /// For each ε, in increasing order: ε and the fraction of uncertain pairs.
    fractions: Vec<(f64, Interval)>,
}

plain!(UncertaintyExponent { exponent, follows_a_power_law, fractions });

#[pymethods]
impl UncertaintyExponent {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __repr__(&self) -> String {
        let law = if self.follows_a_power_law { "True" } else { "False" };
        format!("UncertaintyExponent({}, follows_a_power_law={law})", self.exponent.__repr__())
    }
}

/// As nonsmooth.labelling.uncertainty_exponent, for a function that returns an array of uint16.
#[pyfunction]
pub(crate) fn uncertainty_exponent(
    py: Python<'_>,
    label: &Bound<'_, PyAny>,
    window: Vec<[f64; 2]>,
    epsilons: Vec<f64>,
    #[pyo3(from_py_with = whole)] count: usize,
    #[pyo3(from_py_with = whole)] seed: u64,
) -> PyResult<UncertaintyExponent> {
    let region = region_of(&window)?;
    let pairs = count.saturating_mul(epsilons.len());
    room_for(pairs, 2 * (POINT + window.len() * COORDINATE))?;
    let found = labelled(py, label, window.len(), move |label| {
        basin_of_attraction::uncertainty_exponent(&region, &epsilons, count, seed, label)
    })?;
    let fractions = found.counts.iter().map(|pairs| Ok((pairs.epsilon, pairs.fraction()?.into())));
    Ok(UncertaintyExponent {
        exponent: found.exponent.into(),
        follows_a_power_law: found.follows_a_power_law(),
        fractions: fractions.collect::<Result<_, Error>>().map_err(value_error)?,
    })
}
