//! Points between the basins of attractors, edge states, and the smallest shocks that are fatal.

use super::search::Attractors;
use super::state_map::on_map;
use crate::errors::value_error;
use crate::whole::whole;
use basin_of_attraction::{
    BoundaryBracket, EdgeEnd, EdgeLimits, Error, Label, ShockSearch, StateMap,
};
use pyo3::prelude::*;
use std::sync::Arc;

/// A state and the code of its label.
type Labelled = (Vec<f64>, u16);

/// The two states of a bracket, and one between them that is undecided.
type Bracket = (Labelled, Labelled, Option<Labelled>);

fn bracket(found: BoundaryBracket) -> Bracket {
    let own = |(state, label): (Vec<f64>, Label)| (state, label.code());
    (own(found.first), own(found.second), found.undecided.map(own))
}

impl Attractors {
    /// What `work` finds with the map and the labels of states.
    pub(super) fn with_labels<T: Send + 'static>(
        &self,
        py: Python<'_>,
        threads: Option<usize>,
        work: impl FnOnce(&dyn StateMap, &(dyn Fn(&[f64]) -> Label + Sync)) -> Result<T, Error>
        + Send
        + 'static,
    ) -> PyResult<T> {
        let kind = Arc::clone(&self.kind);
        let found = on_map(py, &self.map, threads, move |map| {
            work(map, &|state: &[f64]| kind.label(map, state))
        })?;
        self.kind.unless_raised(found)?.map_err(value_error)
    }
}

/// As nonsmooth.boundary_between.
#[pyfunction]
pub(crate) fn _boundary_between(
    py: Python<'_>,
    attractors: &Attractors,
    first: Vec<f64>,
    second: Vec<f64>,
    precision: f64,
) -> PyResult<Bracket> {
    attractors.check_dimension(first.len())?;
    let found = attractors.with_labels(py, None, move |_, label| {
        basin_of_attraction::boundary_between(&first, &second, precision, label)
    })?;
    Ok(bracket(found))
}

/// The settings of edge tracking, by the names of Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct EdgeSettings {
    bisect: f64,
    separate: f64,
    still: f64,
    #[pyo3(from_py_with = whole)]
    steps: usize,
    #[pyo3(from_py_with = whole)]
    rounds: usize,
}

/// As nonsmooth.track_edge.
#[pyfunction]
pub(crate) fn _track_edge(
    py: Python<'_>,
    attractors: &Attractors,
    first: Vec<f64>,
    second: Vec<f64>,
    settings: EdgeSettings,
) -> PyResult<(Vec<Vec<f64>>, Bracket, String)> {
    attractors.check_dimension(first.len())?;
    let EdgeSettings { bisect, separate, still, steps, rounds } = settings;
    let limits = EdgeLimits { bisect, separate, steps, rounds, still };
    let found = attractors.with_labels(py, None, move |map, label| {
        basin_of_attraction::track_edge(&first, &second, map, label, limits)
    })?;
    let end = match found.end {
        EdgeEnd::Settled => "settled".to_owned(),
        EdgeEnd::Rounds => "rounds".to_owned(),
        EdgeEnd::Together => "together".to_owned(),
        EdgeEnd::Undecided => "undecided".to_owned(),
        EdgeEnd::SameLabel(label) => format!("both in {}", label.code()),
        EdgeEnd::Stopped => "stopped".to_owned(),
    };
    Ok((found.points, bracket(found.bracket), end))
}

/// The settings of a search for shocks, by the names of Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct ShockSettings {
    farthest: f64,
    precision: f64,
    #[pyo3(from_py_with = whole)]
    directions: usize,
    #[pyo3(from_py_with = whole)]
    along: usize,
    #[pyo3(from_py_with = whole)]
    improved: usize,
    #[pyo3(from_py_with = whole)]
    changes: usize,
    #[pyo3(from_py_with = whole)]
    seed: u64,
}

/// A shock, its size, the code of the label behind it, and how many states were undecided.
type ShockRow = (Vec<f64>, f64, u16, usize);

/// As nonsmooth.minimal_fatal_shock.
#[pyfunction]
pub(crate) fn _minimal_fatal_shock(
    py: Python<'_>,
    attractors: &Attractors,
    state: Vec<f64>,
    settings: ShockSettings,
    threads: Option<usize>,
) -> PyResult<Option<ShockRow>> {
    attractors.check_dimension(state.len())?;
    let ShockSettings { farthest, precision, directions, along, improved, changes, seed } =
        settings;
    let search = ShockSearch { farthest, directions, along, improved, changes, precision, seed };
    let found = attractors.with_labels(py, threads, move |_, label| {
        basin_of_attraction::minimal_fatal_shock(&state, search, label)
    })?;
    Ok(found.map(|own| (own.shock, own.size, own.label.code(), own.undecided)))
}
