//! Runs as arrays, and the names of their ends.

use super::arcs::{certainty, kind};
use crate::arrays::shaped;
use hybrid_system::{Stop, Trajectory};
use nalgebra::DMatrix;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Why a run ended, as users see it.
pub(crate) fn stop_name(stop: Stop) -> &'static str {
    match stop {
        Stop::TimeLimit => "time limit",
        Stop::EventLimit => "event limit",
        Stop::Terminal => "terminal",
        Stop::NoFurtherEvent => "no further event",
        Stop::Zeno => "zeno",
        Stop::Sliding => "sliding",
        Stop::Unfinished => "unfinished",
        Stop::Failed => "failed",
    }
}

/// A run as a dictionary of arrays: of its rows, and of its events.
pub(crate) fn trajectory_arrays<'py, M, S>(
    py: Python<'py>,
    found: Trajectory<M, S>,
    mode: impl Fn(&M) -> PyResult<Py<PyAny>>,
    surface: impl Fn(&S) -> String,
) -> PyResult<Bound<'py, PyDict>> {
    let modes = |modes: &[M]| modes.iter().map(&mode).collect::<PyResult<Vec<_>>>();
    let rows = |matrix: &DMatrix<f64>| {
        shaped(py, matrix.transpose().as_slice().to_vec(), &[matrix.nrows(), matrix.ncols()])
    };
    let (count, all) = (found.times.len(), PyDict::new(py));
    all.set_item("times", shaped(py, found.times, &[count])?)?;
    let jumps: Vec<u64> = found.jumps.iter().map(|&jump| jump as u64).collect();
    all.set_item("jumps", shaped(py, jumps, &[count])?)?;
    all.set_item("modes", modes(&found.modes)?)?;
    all.set_item("states", rows(&found.states)?)?;
    all.set_item("on_grid", shaped(py, found.on_grid, &[count])?)?;
    let events = found.events;
    let number = events.times.len();
    all.set_item("event_times", shaped(py, events.times, &[number])?)?;
    all.set_item("event_surfaces", events.surfaces.iter().map(surface).collect::<Vec<_>>())?;
    all.set_item("event_modes", modes(&events.modes)?)?;
    let next = events.next_modes.iter().map(|next| next.as_ref().map(&mode).transpose());
    all.set_item("event_next_modes", next.collect::<PyResult<Vec<_>>>()?)?;
    all.set_item("event_before", rows(&events.before)?)?;
    all.set_item("event_after", rows(&events.after)?)?;
    let kinds: Vec<_> = events.kinds.iter().map(|&of| kind(of)).collect();
    all.set_item("event_kinds", kinds)?;
    let certainties: Vec<_> = events.certainties.iter().map(|&of| certainty(of)).collect();
    all.set_item("event_certainties", certainties)?;
    Ok(all)
}
