//! A run of a model of formulas.

use super::equations::{Equations, Model, OwnArc};
use crate::errors::{of_hybrid, value_error};
use crate::hybrid::{Event, numbers, state_rows, stop_name, trajectory_arrays};
use crate::pickling::Reduced;
use hybrid_system::{Error, Label, Solution as LibrarySolution, StateVector, Stop};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

/// A run of a model of formulas: its arcs and events, and the states at all times.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct Solution {
    /// The equations, which pickle stores with the arcs.
    equations: Py<Equations>,
    arcs: Vec<OwnArc>,
    stop: Stop,
    error: Option<Error>,
}

impl Solution {
    pub(super) fn new(
        equations: Py<Equations>,
        (arcs, stop, error): (Vec<OwnArc>, Option<Stop>, Option<Error>),
    ) -> PyResult<Self> {
        if arcs.is_empty()
            && let Some(error) = &error
        {
            return Err(of_hybrid(error));
        }
        Ok(Solution { equations, arcs, stop: stop.unwrap_or(Stop::Failed), error })
    }

    /// What `see` finds in the run as a function of time.
    fn seen<T>(
        &self,
        see: impl FnOnce(&LibrarySolution<'_, Model>) -> Result<T, Error>,
    ) -> PyResult<T> {
        LibrarySolution::new(&*self.equations.get().model, self.arcs.clone())
            .and_then(|solution| see(&solution))
            .map_err(|error| of_hybrid(&error))
    }
}

#[pymethods]
impl Solution {
    /// Why the run ended, as Execution.stop has it.
    #[getter]
    fn stop(&self) -> &'static str {
        stop_name(self.stop)
    }

    /// The exception of a run that failed after its first arc; None if it did not.
    #[getter]
    fn error(&self, py: Python<'_>) -> Option<Py<PyAny>> {
        self.error.as_ref().map(|error| of_hybrid(error).into_value(py).into_any())
    }

    /// The number of arcs.
    fn __len__(&self) -> usize {
        self.arcs.len()
    }

    /// The times of the start and of the end.
    #[getter]
    fn times(&self) -> PyResult<(f64, f64)> {
        self.seen(|solution| Ok(solution.times()))
    }

    /// The events.
    #[getter]
    fn events(&self, py: Python<'_>) -> PyResult<Vec<Event>> {
        let name = |label: &Label| Ok(PyString::new(py, label.as_str()).into_any().unbind());
        let surface = |surface: &Label| surface.as_str().to_owned();
        let events = self.arcs.iter().filter_map(|arc| arc.event());
        events.map(|event| Event::of(py, event, surface, name)).collect()
    }

    /// The modes in which the arcs are.
    #[getter]
    fn modes(&self) -> Vec<String> {
        self.arcs.iter().map(|arc| arc.mode.to_string()).collect()
    }

    /// The states at rising times, one row for each: after all events at each of them.
    fn states<'py>(
        &self,
        py: Python<'py>,
        times: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let times = numbers(times)?;
        let states = self.seen(|solution| solution.states(&times))?;
        let dimension = self.arcs.first().map_or(0, |arc| arc.start.dimension());
        state_rows(py, &states, dimension)
    }

    /// As Execution.trajectory, of the whole run.
    fn trajectory<'py>(
        &self,
        py: Python<'py>,
        grid: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let grid = numbers(grid)?;
        let found = self.seen(|solution| solution.trajectory(&grid))?;
        let name = |label: &Label| Ok(PyString::new(py, label.as_str()).into_any().unbind());
        trajectory_arrays(py, found, name, |surface| surface.as_str().to_owned())
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Reduced<'py>> {
        if let Some(error) = &self.error {
            let text = format!("cannot pickle a run that failed: {error}");
            return Err(PyTypeError::new_err(text));
        }
        let stored = serde_json::to_string(&(&self.arcs, self.stop)).map_err(value_error)?;
        let make = py.import("nonsmooth._native")?.getattr("_solution")?;
        let arguments = (self.equations.clone_ref(py), stored).into_pyobject(py)?;
        Ok((make, arguments))
    }

    fn __repr__(&self) -> PyResult<String> {
        let (from, to) = self.times()?;
        let (arcs, stop) = (self.arcs.len(), self.stop());
        Ok(format!("Solution(times=({from:?}, {to:?}), arcs={arcs}, stop={stop:?})"))
    }
}

/// A run that pickle has stored.
#[pyfunction]
pub(crate) fn _solution(equations: Py<Equations>, stored: &str) -> PyResult<Solution> {
    let (arcs, stop) = serde_json::from_str(stored)
        .map_err(|error| value_error(format!("the stored run is wrong: {error}")))?;
    Ok(Solution { equations, arcs, stop, error: None })
}
