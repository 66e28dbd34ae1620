//! Executions: iterators over arcs, which stay usable after an exception.

use super::arcs::HybridArc;
use super::callables::Callables;
use super::model::Model;
use super::names::{ExecutionMode, ExecutionSurface, Mode};
use super::trajectory::{stop_name, trajectory_arrays};
use super::vectors::{State, copied, numbers};
use crate::pickling::refused;
use hybrid_system::{
    Checkpoint, Error, Execution as LibraryExecution, Filippov, FilippovMode, Limits,
};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::sync::{Arc, Mutex, PoisonError};

/// The point that an execution has reached, and its limits.
type At = (Reached, Limits);
type Reached = Checkpoint<ExecutionMode, ExecutionSurface, State>;

/// An execution of a hybrid system: an iterator over its arcs.
///
/// After an exception of a function, or Ctrl-C, it is where it was before the call: next() tries the same arc again.
#[pyclass(frozen, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct Execution {
    model: Arc<Model>,
    /// `None` while a call is at work.
    at: Mutex<Option<At>>,
}

impl Execution {
    pub(crate) fn new(
        py: Python<'_>,
        model: Arc<Model>,
        mode: Mode,
        state: State,
        (start_time, limits): (f64, Limits),
    ) -> Self {
        let system = Callables::with_sliding(py, &model);
        let execution = LibraryExecution::new(&system, FilippovMode::Free(mode), state, limits);
        let checkpoint = execution.starting_at(start_time).checkpoint();
        drop(system);
        Execution { at: Mutex::new(Some((checkpoint, limits))), model }
    }

    /// The result of some steps of the execution. An exception leaves it where it was.
    fn steps<T>(
        &self,
        py: Python<'_>,
        limits: impl FnOnce(Limits) -> Limits,
        steps: impl FnOnce(&mut LibraryExecution<'_, Filippov<Callables<'_, '_>>>) -> Result<T, Error>,
    ) -> PyResult<T> {
        let taken = self.at.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some((checkpoint, before)) = taken else {
            let text =
                "the execution is at work: one of its own functions, or another thread, called it";
            return Err(PyRuntimeError::new_err(text));
        };
        let limits = limits(before);
        let system = Callables::with_sliding(py, &self.model);
        let mut execution = LibraryExecution::restore(&system, checkpoint.clone(), limits);
        let found = steps(&mut execution);
        let after = execution.checkpoint();
        let exception = system.system().exception();
        let at = if exception.is_some() { (checkpoint, before) } else { (after, limits) };
        *self.at.lock().unwrap_or_else(PoisonError::into_inner) = Some(at);
        match exception {
            Some(exception) => Err(exception),
            None => found.map_err(|error| system.system().raised(&error)),
        }
    }

    fn seen<T>(&self, see: impl FnOnce(&Reached) -> T) -> PyResult<T> {
        let at = self.at.lock().unwrap_or_else(PoisonError::into_inner);
        match at.as_ref() {
            Some((checkpoint, _)) => Ok(see(checkpoint)),
            None => Err(PyRuntimeError::new_err("the execution is at work")),
        }
    }
}

#[pymethods]
impl Execution {
    fn __iter__(own: Py<Self>) -> Py<Self> {
        own
    }

    fn __next__(&self, py: Python<'_>) -> PyResult<Option<HybridArc>> {
        let arc = self.steps(py, |limits| limits, |execution| execution.next().transpose())?;
        Ok(arc.map(|arc| HybridArc::new(Arc::clone(&self.model), arc)))
    }

    /// Sets the limit on time, also after the execution has stopped at an earlier one. Returns the execution.
    fn run_until(own: Py<Self>, py: Python<'_>, time: f64) -> PyResult<Py<Self>> {
        let later = |limits| Limits { time, ..limits };
        own.get().steps(py, later, |execution| {
            let _ = execution.run_until(time);
            Ok(())
        })?;
        Ok(own)
    }

    /// The rest of the execution as a dictionary of arrays, with states at the times of `grid`, which rises.
    ///
    /// Every arc has a row at its start and at its end: each event has the states before and after it. times,
    /// jumps, modes, states and on_grid have one entry for each row. event_times, event_surfaces, event_modes,
    /// event_next_modes, event_before, event_after, event_kinds and event_certainties have one for each event.
    fn trajectory<'py>(
        &self,
        py: Python<'py>,
        grid: &Bound<'py, PyAny>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let grid = numbers(grid)?;
        let found = self.steps(py, |limits| limits, |execution| execution.trajectory(&grid))?;
        let name = |mode: &ExecutionMode| self.model.mode_object(py, *mode);
        trajectory_arrays(py, found, name, |surface| self.model.event_name(*surface))
    }

    /// The mode in which the execution is; a SlidingMode along a surface.
    #[getter]
    fn mode(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.model.mode_object(py, self.seen(Checkpoint::mode)?)
    }

    /// The state at which it is.
    #[getter]
    fn state(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.seen(|checkpoint| copied(py, checkpoint.state()))
    }

    /// The time at which it is.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        self.seen(Checkpoint::time)
    }

    /// The number of events so far.
    #[getter]
    fn jump(&self) -> PyResult<usize> {
        self.seen(Checkpoint::jump)
    }

    /// Why it ended: "time limit", "event limit", "terminal", "no further event", "zeno", "sliding", "unfinished"
    /// or "failed"; None while it goes on.
    #[getter]
    fn stop(&self) -> PyResult<Option<&'static str>> {
        Ok(self.seen(Checkpoint::stop)?.map(stop_name))
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<()> {
        Err(refused(py, "an Execution", &self.model.functions()))
    }

    fn __repr__(&self) -> PyResult<String> {
        let (time, jump, stop) = (self.time()?, self.jump()?, self.stop()?);
        let stop = stop.map_or("None".into(), |stop| format!("{stop:?}"));
        Ok(format!("Execution(time={time:?}, jump={jump}, stop={stop})"))
    }
}
