//! Attractors and the fractions of their basins along a parameter.

use super::search::grid;
use crate::arrays::shaped;
use crate::errors::{of_callback, value_error};
use crate::formulas::Steps;
use crate::interruptible::{Watch, in_background, progress_function, with_threads};
use crate::labelling::region_of;
use crate::whole::{room_for, whole};
use basin_of_attraction::{
    AlongProgress, AlongSearch, AttractorsAlong, CurveLimits, Label, Matching, RecurrenceLimits,
    StateMap, UnresolvedReason, attractors_along_watched,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::ControlFlow;
use std::sync::{Arc, Mutex, PoisonError};

/// The steps at a parameter, or none after an exception.
struct StepsAt(Option<Arc<dyn StateMap + Send + Sync>>);

impl StateMap for StepsAt {
    fn dimension(&self) -> Option<usize> {
        self.0.as_ref()?.dimension()
    }
    fn image(&self, state: &[f64], image: &mut [f64]) -> bool {
        self.0.as_ref().is_some_and(|map| map.image(state, image))
    }
    fn label_of_end(&self, state: &[f64]) -> Label {
        self.0.as_ref().map_or(Label::UNDECIDED_MAP, |map| map.label_of_end(state))
    }
    fn images(&self, states: &mut [Vec<f64>], has_image: &mut [bool]) {
        match &self.0 {
            Some(map) => map.images(states, has_image),
            None => has_image.fill(false),
        }
    }
    fn advance(&self, states: &mut [Vec<f64>], has_image: &mut [bool], steps: usize) -> usize {
        match &self.0 {
            Some(map) => map.advance(states, has_image, steps),
            None => {
                has_image.fill(false);
                steps.min(1)
            }
        }
    }
    fn together(&self) -> usize {
        self.0.as_ref().map_or(1, |map| map.together())
    }
}

/// A function of Python from a parameter to the steps there, and its first exception.
struct Family {
    function: Py<PyAny>,
    exception: Mutex<Option<PyErr>>,
}

impl Family {
    fn at(&self, parameter: f64) -> StepsAt {
        let made = Python::attach(|py| {
            let found = self.function.bind(py).call1((parameter,));
            let found = found.map_err(|error| of_callback(py, "steps_at", error))?;
            match found.cast::<Steps>() {
                Ok(steps) => Ok(Arc::clone(&steps.get().map)),
                Err(_) => Err(PyTypeError::new_err(format!(
                    "steps_at({parameter:?}) must return Steps, such as system.steps(…) or map_steps(…), not {found}"
                ))),
            }
        });
        let stored = |error: PyErr| {
            self.exception.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        };
        StepsAt(made.map_err(stored).ok())
    }

    fn raised(&self) -> Option<PyErr> {
        self.exception.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

/// The settings of a search, by the names of Python.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub(crate) struct Settings {
    /// The ends of the parameter, and values at which something is known to happen.
    range: [f64; 2],
    known: Vec<f64>,
    region: Vec<[f64; 2]>,
    #[pyo3(from_py_with = whole)]
    cells: usize,
    periodic: Vec<usize>,
    basins: Vec<[f64; 2]>,
    #[pyo3(from_py_with = whole)]
    starts: usize,
    #[pyo3(from_py_with = whole)]
    points: usize,
    #[pyo3(from_py_with = whole)]
    seed: u64,
    #[pyo3(from_py_with = whole)]
    recurrences: usize,
    #[pyo3(from_py_with = whole)]
    locate: usize,
    #[pyo3(from_py_with = whole)]
    budget: usize,
    #[pyo3(from_py_with = whole)]
    lost: usize,
    #[pyo3(from_py_with = whole)]
    tests: usize,
    escape: Option<f64>,
    #[pyo3(from_py_with = whole)]
    first_steps: usize,
    difference: f64,
    shortest: f64,
    #[pyo3(from_py_with = whole)]
    parameters: usize,
    within: Option<f64>,
    overlap: Option<f64>,
}

impl Settings {
    fn search(&self) -> PyResult<AlongSearch> {
        // A point, its label and its steps; all starts are made before the first one is followed.
        let coordinates = size_of::<f64>() * self.basins.len();
        room_for(self.points, size_of::<(Label, usize)>() + size_of::<Label>())?;
        room_for(self.starts, size_of::<Vec<f64>>() + coordinates)?;
        let grid = grid(&self.region, self.cells, self.periodic.clone())?;
        let limits = RecurrenceLimits {
            recurrences: self.recurrences,
            locate: self.locate,
            budget: self.budget,
            lost: self.lost,
            tests: self.tests,
            escape: self.escape,
        };
        let region = region_of(&self.basins)?;
        Ok(AlongSearch {
            grid,
            limits,
            region,
            starts: self.starts,
            points: self.points,
            seed: self.seed,
        })
    }

    fn curve(&self) -> CurveLimits {
        CurveLimits {
            first_steps: self.first_steps,
            difference: self.difference,
            relative: 0.0,
            shortest: self.shortest,
            budget: self.parameters,
        }
    }

    /// `None` is the flow.
    fn matching(&self) -> Option<Matching<'static>> {
        let nearest = self.within.map(|within| Matching::Nearest { within });
        nearest.or_else(|| self.overlap.map(|least| Matching::Overlap { least }))
    }
}

/// As nonsmooth.attractors_along: a dictionary.
#[pyfunction]
pub(crate) fn _attractors_along<'py>(
    py: Python<'py>,
    steps_at: Py<PyAny>,
    settings: Settings,
    threads: Option<usize>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let progress = progress_function(py, progress)?;
    let [from, to] = settings.range;
    let range = basin_of_attraction::Interval::new(from, to).map_err(value_error)?;
    let search = settings.search()?;
    let family = Arc::new(Family { function: steps_at, exception: Mutex::new(None) });
    let own = Arc::clone(&family);
    let all = settings.parameters;
    let run = move |watch: &Watch| {
        let is_over = || {
            let raised = own.exception.lock().unwrap_or_else(PoisonError::into_inner).is_some();
            watch.is_stopped() || raised
        };
        let go_on = |_: f64, done: AlongProgress<'_>| {
            if matches!(done, AlongProgress::Found(_)) {
                watch.finished(1);
            }
            if is_over() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let at = |parameter: f64| own.at(parameter);
        let (curve, matching) = (settings.curve(), settings.matching());
        let work = || {
            attractors_along_watched(range, &settings.known, curve, matching, &search, at, go_on)
        };
        with_threads(threads, work)
    };
    let report = |done: usize| match &progress {
        Some(progress) => progress.call1((done, all)).map(drop),
        None => Ok(()),
    };
    let found = in_background(py, run, value_error, report)?;
    if let Some(error) = family.raised() {
        return Err(error);
    }
    let found = found.map_err(value_error)?;
    if let Some(progress) = &progress {
        // So many parameters were enough.
        let done = found.found.len();
        progress.call1((done, done)).map_err(|error| of_callback(py, "progress", error))?;
    }
    as_dictionary(py, &found)
}

/// All that was found, as lists and arrays.
fn as_dictionary<'py>(py: Python<'py>, found: &AttractorsAlong) -> PyResult<Bound<'py, PyDict>> {
    let along = &found.fractions;
    let points = along.points();
    let labels: std::collections::BTreeSet<Label> =
        points.iter().flat_map(|(_, own)| own.found.keys().copied()).collect();
    let parameters: Vec<f64> = points.iter().map(|(parameter, _)| *parameter).collect();
    let fractions = PyDict::new(py);
    for label in labels {
        let column = |of: fn(basin_of_attraction::FractionRange) -> f64| {
            let all: Vec<f64> = points.iter().map(|(_, own)| of(own.of(label))).collect();
            let count = all.len();
            shaped(py, all, &[count])
        };
        let own = (column(|own| own.value)?, column(|own| own.lower)?, column(|own| own.upper)?);
        fractions.set_item(label.code(), own)?;
    }
    let attractors = points.iter().map(|(_, own)| {
        let all = PyDict::new(py);
        for (label, points) in &own.attractors {
            let shape = [points.len(), points.first().map_or(0, Vec::len)];
            all.set_item(label.code(), shaped(py, points.concat(), &shape)?)?;
        }
        Ok(all)
    });
    let changes: Vec<(f64, f64, u16, bool)> = along
        .unmatched()
        .iter()
        .map(|own| (own.from, own.to, own.label.code(), own.appears))
        .collect();
    let unresolved = along.unresolved().iter().map(|own| {
        let reason = match own.reason {
            UnresolvedReason::Jump => "jump",
            UnresolvedReason::Uncertain => "uncertain",
            UnresolvedReason::Budget => "budget",
        };
        (own.from, own.to, own.label.code(), reason)
    });
    let unseen: Vec<f64> = points.iter().map(|(_, own)| own.unseen).collect();
    let count = parameters.len();
    let all = PyDict::new(py);
    all.set_item("parameter", shaped(py, parameters, &[count])?)?;
    all.set_item("fractions", fractions)?;
    all.set_item("unseen", shaped(py, unseen, &[count])?)?;
    all.set_item("attractors", attractors.collect::<PyResult<Vec<_>>>()?)?;
    all.set_item("changes", changes)?;
    all.set_item("unresolved", unresolved.collect::<Vec<_>>())?;
    Ok(all)
}
