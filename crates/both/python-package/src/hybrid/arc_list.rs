//! Arcs of a run as a function of time.

use super::arcs::{HybridArc, OwnArc};
use super::callables::Callables;
use super::names::{ExecutionMode, ExecutionSurface};
use super::trajectory::trajectory_arrays;
use super::vectors::{numbers, state_rows};
use crate::errors::InputError;
use hybrid_system::{Error, Filippov, Solution, StateVector};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What `see` finds in a run with these arcs.
fn seen<T>(
    py: Python<'_>,
    arcs: &[Py<HybridArc>],
    see: impl FnOnce(&Solution<'_, Filippov<Callables<'_, '_>>>) -> Result<T, Error>,
) -> PyResult<T> {
    let Some(first) = arcs.first() else {
        return Err(InputError::new_err("a run has at least one arc"));
    };
    let system = Callables::with_sliding(py, first.get().model());
    let own: Vec<OwnArc> = arcs.iter().map(|arc| arc.get().own().clone()).collect();
    let found = Solution::new(&system, own).and_then(|solution| see(&solution));
    match system.system().exception() {
        Some(exception) => Err(exception),
        None => found.map_err(|error| system.system().raised(&error)),
    }
}

/// The states of a run with these arcs at rising times, one row for each: after all events at each of them.
#[pyfunction]
pub(crate) fn arc_states<'py>(
    py: Python<'py>,
    arcs: Vec<Py<HybridArc>>,
    times: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let times = numbers(times)?;
    let states = seen(py, &arcs, |solution| solution.states(&times))?;
    let dimension = arcs.first().map_or(0, |arc| arc.get().own().start.dimension());
    state_rows(py, &states, dimension)
}

/// A run with these arcs as arrays, as Execution.trajectory.
#[pyfunction]
pub(crate) fn arc_trajectory<'py>(
    py: Python<'py>,
    arcs: Vec<Py<HybridArc>>,
    grid: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyDict>> {
    let grid = numbers(grid)?;
    let found = seen(py, &arcs, |solution| solution.trajectory(&grid))?;
    let Some(first) = arcs.first() else {
        return Err(InputError::new_err("a run has at least one arc"));
    };
    let model = first.get().model();
    let mode = |mode: &ExecutionMode| model.mode_object(py, *mode);
    trajectory_arrays(py, found, mode, |surface: &ExecutionSurface| model.event_name(*surface))
}
