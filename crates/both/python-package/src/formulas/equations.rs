//! A model of formulas: its runs need no Python.

use super::fates::Fates;
use super::solution::Solution;
use crate::errors::{InputError, of_hybrid, value_error};
use crate::hybrid::numbers;
use crate::interruptible::{Watch, in_background};
use crate::pickling::Reduced;
use crate::whole::whole;
use hybrid_system::{
    Arc as LibraryArc, EquationsModel, Error, Execution, Label, Limits, Tolerances,
};
use nalgebra::DVector;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

pub(super) type Model = EquationsModel<DVector<f64>>;
pub(super) type OwnArc = LibraryArc<Label, Label, DVector<f64>>;

/// A hybrid system by its equations: what the functions of a System become.
///
/// It is made of JSON, and pickles as such.
#[pyclass(frozen, module = "nonsmooth")]
pub(crate) struct Equations {
    pub(super) model: Arc<Model>,
    tolerances: Tolerances,
}

/// Tolerances for each component live as long as the process: a run in the background may need them. Equal ones are kept once.
fn kept(values: Vec<f64>) -> &'static [f64] {
    static KEPT: Mutex<BTreeMap<Vec<u64>, &'static [f64]>> = Mutex::new(BTreeMap::new());
    let bits = values.iter().map(|value| value.to_bits()).collect();
    let mut kept = KEPT.lock().unwrap_or_else(PoisonError::into_inner);
    kept.entry(bits).or_insert_with(|| Vec::leak(values))
}

/// Lists of tolerances of the components, with one for the time if it is the last component of the state: any one, as the time is exact.
fn with_time(mut tolerances: Tolerances, names: usize, dimension: usize) -> Tolerances {
    let longer = |list: &'static [f64]| match list.len() == names && dimension > names {
        true => kept([list, &[list.iter().copied().fold(0.0, f64::max)]].concat()),
        false => list,
    };
    tolerances.absolute_each = tolerances.absolute_each.map(longer);
    tolerances.relative_each = tolerances.relative_each.map(longer);
    tolerances
}

impl Equations {
    fn of(equations: &hybrid_system::Equations, tolerances: Tolerances) -> PyResult<Self> {
        let model = equations.model::<DVector<f64>>().map_err(|error| of_hybrid(&error))?;
        let tolerances = with_time(tolerances, equations.names().states.len(), model.dimension());
        Ok(Equations { model: Arc::new(model.tolerances(tolerances)), tolerances })
    }

    pub(super) fn tolerances(&self) -> Tolerances {
        self.tolerances
    }

    pub(super) fn equations(&self) -> &hybrid_system::Equations {
        self.model.equations()
    }

    /// The same equations with other values of parameters.
    pub(super) fn with(&self, values: &[(String, f64)]) -> PyResult<Equations> {
        let texts = values.iter().map(|(name, value)| match value.is_finite() {
            true => Ok((name.as_str(), format!("{value:?}"))),
            false => Err(InputError::new_err(format!("the parameter {name} is {value}"))),
        });
        let texts = texts.collect::<PyResult<Vec<_>>>()?;
        let values: Vec<_> = texts.iter().map(|(name, text)| (*name, text.as_str())).collect();
        Equations::of(&self.equations().clone().with_parameters(&values), self.tolerances)
    }
}

/// The execution of a run, with limits that end it within bounds.
pub(super) fn begin<'m>(
    model: &'m Model,
    (mode, start): (&str, &[f64]),
    times: (f64, f64),
    events: usize,
) -> Result<Execution<'m, Model>, Error> {
    let run = model.start_at(mode, start.to_vec(), times)?;
    Ok(Execution::restore(model, run.checkpoint(), Limits::new(times.1, events)))
}

#[pymethods]
impl Equations {
    /// relative and absolute are the tolerances of a step: one number, or one for each component of the state.
    #[new]
    #[pyo3(signature = (json, *, relative = 1e-12, absolute = 1e-12, relative_each = None, absolute_each = None,
                        longest_step = f64::INFINITY, steps = 1_000_000),
           text_signature = "(json, *, relative=1e-12, absolute=1e-12, relative_each=None, absolute_each=None, longest_step=1e999, steps=1000000)")]
    fn new(
        json: &str,
        relative: f64,
        absolute: f64,
        relative_each: Option<Vec<f64>>,
        absolute_each: Option<Vec<f64>>,
        longest_step: f64,
        #[pyo3(from_py_with = whole)] steps: usize,
    ) -> PyResult<Self> {
        let own = hybrid_system::Equations::from_json(json).map_err(|error| of_hybrid(&error))?;
        let tolerances = Tolerances {
            absolute,
            relative_each: relative_each.map(kept),
            absolute_each: absolute_each.map(kept),
            ..Tolerances::both(relative).longest_step(longest_step).steps(steps)
        };
        Equations::of(&own, tolerances)
    }

    /// The equations as JSON, with exact numbers.
    #[getter]
    fn json(&self) -> PyResult<String> {
        self.equations().to_json().map_err(|error| of_hybrid(&error))
    }

    /// A short name of the equations: the SHA-256 of their JSON.
    #[getter]
    fn content_hash(&self) -> PyResult<String> {
        self.equations().content_hash().map_err(|error| of_hybrid(&error))
    }

    /// The same equations with other values of parameters.
    fn with_parameters(&self, values: Vec<(String, f64)>) -> PyResult<Equations> {
        self.with(&values)
    }

    /// The run from a state in a mode between two times. No Python runs meanwhile, and Ctrl-C ends it.
    fn run(
        slf: Py<Self>,
        py: Python<'_>,
        mode: String,
        start: &Bound<'_, PyAny>,
        times: (f64, f64),
        #[pyo3(from_py_with = whole)] events: usize,
    ) -> PyResult<Solution> {
        let (own, start) = (Arc::clone(&slf.get().model), numbers(start)?);
        let work = move |watch: &Watch| {
            let mut run = begin(&own, (&mode, &start), times, events)?;
            let mut arcs: Vec<OwnArc> = Vec::new();
            let mut error = None;
            for arc in run.by_ref() {
                match arc {
                    Ok(arc) => arcs.push(arc),
                    Err(found) => error = Some(found),
                }
                if watch.is_stopped() {
                    break;
                }
            }
            Ok((arcs, run.stop(), error))
        };
        let found = in_background(py, work, |error| of_hybrid(&error), |_| Ok(()))?;
        Solution::new(slf, found)
    }

    /// The ends of many runs: starts has one start a row, and there is one mode for each. values has the values of the parameters with these
    /// names, one row for each start.
    #[pyo3(signature = (modes, starts, times, events, names = Vec::new(), values = Vec::new(), threads = None, progress = None),
           text_signature = "($self, modes, starts, times, events, names=(), values=(), threads=None, progress=None)")]
    #[expect(clippy::too_many_arguments, reason = "the front in Python names them")]
    fn fates(
        &self,
        py: Python<'_>,
        modes: Vec<String>,
        starts: Vec<Vec<f64>>,
        times: (f64, f64),
        #[pyo3(from_py_with = whole)] events: usize,
        names: Vec<String>,
        values: Vec<Vec<f64>>,
        threads: Option<usize>,
        progress: Option<Bound<'_, PyAny>>,
    ) -> PyResult<Fates> {
        let limits = (times, events);
        if names.is_empty() {
            return Fates::of_starts(py, &self.model, (modes, starts), limits, (threads, progress));
        }
        let rows =
            values.iter().map(|row| names.iter().cloned().zip(row.iter().copied()).collect());
        let models = rows.map(|row: Vec<_>| Ok(self.with(&row)?.model));
        let models = models.collect::<PyResult<Vec<_>>>()?;
        Fates::of_models(py, models, (modes, starts), limits, (threads, progress))
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let own = slf.get();
        let py = slf.py();
        let Tolerances {
            relative,
            absolute,
            relative_each,
            absolute_each,
            longest_step,
            steps,
            ..
        } = own.tolerances;
        let make = py.import("nonsmooth._native")?.getattr("_equations")?;
        let each = |values: Option<&'static [f64]>| values.map(<[f64]>::to_vec);
        let values = (
            own.json()?,
            relative,
            absolute,
            each(relative_each),
            each(absolute_each),
            longest_step,
            steps,
        );
        Ok((make, values.into_pyobject(py)?.cast_into::<PyTuple>()?))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Equations>().is_ok_and(|other| {
            let other = other.get();
            other.equations() == self.equations() && other.tolerances == self.tolerances
        })
    }

    fn __repr__(&self) -> String {
        let names = self.equations().names();
        format!("Equations(states={:?}, parameters={:?})", names.states, names.parameters)
    }
}

/// Equations that pickle has stored.
#[pyfunction]
pub(crate) fn _equations(
    json: &str,
    relative: f64,
    absolute: f64,
    relative_each: Option<Vec<f64>>,
    absolute_each: Option<Vec<f64>>,
    longest_step: f64,
    steps: usize,
) -> PyResult<Equations> {
    Equations::new(json, relative, absolute, relative_each, absolute_each, longest_step, steps)
        .map_err(|error| value_error(format!("the stored equations are wrong: {error}")))
}
