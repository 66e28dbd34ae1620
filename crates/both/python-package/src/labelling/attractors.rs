//! The attractors of a map: of a function of Python, or of steps that need none.

use crate::arrays::{Numbers, shaped};
use crate::errors::{ComputationError, of_callback, value_error};
use crate::formulas::Steps;
use crate::interruptible::{Watch, in_background, with_threads};
use crate::pickling::refused;
use crate::whole::whole;
use basin_of_attraction::{
    Error, Hyperrectangle, Interval, Label, RecurrenceLimits, StateGrid, StateMap, watched_map,
};
use numpy::PyArray1;
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

/// A map of Python in a thread of its own. After an exception, or Ctrl-C, it has no more values.
struct PythonMap {
    function: Py<PyAny>,
    exception: Mutex<Option<PyErr>>,
    calls: AtomicUsize,
}

/// Calls between two moments at which other threads can have the interpreter's lock: less than a millisecond.
const CALLS: usize = 256;

impl PythonMap {
    fn new(function: Py<PyAny>) -> Arc<Self> {
        Arc::new(PythonMap { function, exception: Mutex::new(None), calls: AtomicUsize::new(0) })
    }

    fn image(&self, state: &[f64], watch: &Watch) -> Option<Vec<f64>> {
        if watch.is_stopped() || self.lock().is_some() {
            return None;
        }
        let call = |py: Python<'_>| {
            // A function that is written in C never gives the lock away, and Ctrl-C would wait for it.
            if self.calls.fetch_add(1, Ordering::Relaxed).is_multiple_of(CALLS) {
                py.detach(std::thread::yield_now);
            }
            let found = self.function.bind(py).call1((PyArray1::from_slice(py, state),))?;
            if found.is_none() {
                return Ok(None);
            }
            let next = crate::hybrid::vector(&found, state.len(), "the map")?;
            // An infinite state has escaped; NaN is a mistake, or no value.
            if next.iter().any(|number| number.is_nan()) {
                let text = format!(
                    "the map returned {found} from {state:?}; return None where it has no value"
                );
                return Err(ComputationError::new_err(text));
            }
            Ok(Some(next.as_slice().to_vec()))
        };
        let found: PyResult<Option<Vec<f64>>> = Python::attach(call);
        found.unwrap_or_else(|error| {
            let error = Python::attach(|py| of_callback(py, "map", error));
            self.lock().get_or_insert(error);
            None
        })
    }

    /// What was found, unless the map has raised an exception.
    fn unless_raised<T>(&self, found: T) -> PyResult<T> {
        self.lock().take().map_or(Ok(found), Err)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Option<PyErr>> {
        self.exception.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// What `work` finds of a map in the background: of steps on all threads, or on so many; of a function of Python on one.
fn on_map<T: Send + 'static>(
    py: Python<'_>,
    map: &Py<PyAny>,
    threads: Option<usize>,
    work: impl FnOnce(&dyn StateMap) -> T + Send + 'static,
) -> PyResult<T> {
    if let Ok(steps) = map.bind(py).cast::<Steps>() {
        let map = Arc::clone(&steps.get().map);
        let run = move |watch: &Watch| {
            let go_on = |_| match watch.is_stopped() {
                true => ControlFlow::Break(()),
                false => ControlFlow::Continue(()),
            };
            let map: &dyn StateMap = &*map;
            with_threads(threads, || work(&watched_map(map, go_on)))
        };
        return in_background(py, run, value_error, |_| Ok(()));
    }
    let own = PythonMap::new(map.clone_ref(py));
    let step = Arc::clone(&own);
    // Only one thread can call Python at a time. More of them would wait for each other at every step.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(value_error)?;
    let run = move |watch: &Watch| {
        let image = |state: &[f64]| step.image(state, watch);
        // The thread keeps the interpreter's lock from step to step: to take it anew takes longer than a step.
        Ok::<_, Error>(pool.install(|| Python::attach(|_| work(&image))))
    };
    let found = in_background(py, run, value_error, |_| Ok(()))?;
    own.unless_raised(found)
}

/// The attractors of a map of several variables, found by recurrences to cells of a grid and tested as traps.
///
/// map(x) is a step: a map, a return map, or a flow over some time. Steps of a System need no Python, and run on all processors. A function takes an array, and returns a list, a tuple
/// or an array, or None where it has no value. region has the ends of each coordinate; starts is an array with one
/// start a row. The basins have the labels 1, 2, … in the order in which the attractors are found; ESCAPED is the
/// label of an orbit that passes the distance `escape` from the origin.
///
/// periodic has the coordinates, from 0, whose side of the region is one period, such as angles.
///
/// cells along every side of the region locate an attractor; an orbit of `recurrences` steps within visited cells
/// is a candidate, which is followed ten times as long as it took to be found, and which `tests` random orbits
/// test. No orbit takes more than `budget` steps to a candidate. Attractors closer than three cells of the finest
/// grid tried, of 16 times as many cells, may be found as one. If no attractor is found, `remedy` says what would
/// help.
///
/// >>> from nonsmooth.labelling import Attractors
/// >>> newton = lambda x: (x - (x ** 2 - 2) / (2 * x)) if x[0] else None
/// >>> found = Attractors(newton, region=[(-3.1, 3)], starts=[[1.0], [-1.0]], tests=20)
/// >>> [round(float(points[0, 0]), 6) for points in found.points.values()]
/// [1.414214, -1.414214]
/// >>> found.labels([[0.3], [-7.0]]).tolist()
/// [1, 2]
#[pyclass(frozen, module = "nonsmooth.labelling")]
pub(crate) struct Attractors {
    function: Py<PyAny>,
    dimension: usize,
    found: Arc<basin_of_attraction::Attractors>,
}

#[pymethods]
impl Attractors {
    #[new]
    #[pyo3(signature = (map, *, region, starts, cells = 100, recurrences = 100, locate = 1000, budget = 100_000, lost = 1000, tests = 200,
                        escape = None, periodic = Vec::new()),
           text_signature = "(map, *, region, starts, cells=100, recurrences=100, locate=1000, budget=100000, lost=1000, tests=200, escape=None, periodic=())")]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        py: Python<'_>,
        map: Py<PyAny>,
        region: Vec<[f64; 2]>,
        starts: Vec<Vec<f64>>,
        #[pyo3(from_py_with = whole)] cells: usize,
        #[pyo3(from_py_with = whole)] recurrences: usize,
        #[pyo3(from_py_with = whole)] locate: usize,
        #[pyo3(from_py_with = whole)] budget: usize,
        #[pyo3(from_py_with = whole)] lost: usize,
        #[pyo3(from_py_with = whole)] tests: usize,
        escape: Option<f64>,
        periodic: Vec<usize>,
    ) -> PyResult<Self> {
        let limits = RecurrenceLimits { recurrences, locate, budget, lost, tests, escape };
        let side = |&[left, right]: &[f64; 2]| Interval::new(left, right);
        let sides = region.iter().map(side).collect::<Result<_, Error>>().map_err(value_error)?;
        let region = Hyperrectangle::new(sides).map_err(value_error)?;
        let grid = StateGrid::uniform(region, cells).map_err(value_error)?;
        let grid = periodic.into_iter().try_fold(grid, StateGrid::periodic).map_err(value_error)?;
        let dimension = grid.dimension();
        let search = move |map: &dyn StateMap| {
            basin_of_attraction::Attractors::search(map, grid, &starts, limits)
        };
        let found = on_map(py, &map, None, search)?.map_err(value_error)?;
        Ok(Attractors { function: map, dimension, found: Arc::new(found) })
    }

    /// The successive points of an orbit on each attractor, by label: arrays with one point a row.
    #[getter]
    fn points<'py>(&self, py: Python<'py>) -> PyResult<BTreeMap<u16, Bound<'py, PyAny>>> {
        let rows = |(label, points): (Label, Vec<Vec<f64>>)| {
            let shape = [points.len(), points.first().map_or(0, Vec::len)];
            Ok((label.code(), shaped(py, points.concat(), &shape)?))
        };
        self.found.positions().into_iter().map(rows).collect()
    }

    /// The starts whose orbits belong to no attractor, each with the reason: "left the region: …", "cut by the
    /// region: …", "stopped", "not settled: …" with the drift a step, or "no trap".
    #[getter]
    fn unmatched(&self) -> Vec<(Vec<f64>, String)> {
        let own = self.found.unmatched().iter();
        own.map(|own| (own.start.clone(), own.reason.to_string())).collect()
    }

    /// What would help if no attractor was found: a larger region, more cells, or a larger budget; None if one was
    /// found.
    #[getter]
    fn remedy(&self) -> Option<String> {
        self.found.remedy().map(|remedy| remedy.to_string())
    }

    /// The number of steps after which each attractor repeats itself, by label; None for one that does not.
    #[getter]
    fn periods(&self) -> BTreeMap<u16, Option<usize>> {
        let all = self.found.attractors().iter();
        all.map(|attractor| (attractor.label.code(), attractor.period)).collect()
    }

    /// The labels of starts, one a row: an array of uint16. A start that comes to no attractor is undecided.
    #[pyo3(signature = (starts, threads = None))]
    fn labels<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        threads: Option<usize>,
    ) -> PyResult<Bound<'py, PyAny>> {
        Ok(self.convergences(py, starts, threads)?.0)
    }

    /// The labels of starts, and the numbers of steps after which each is at its attractor.
    #[pyo3(signature = (starts, threads = None))]
    fn convergences<'py>(
        &self,
        py: Python<'py>,
        starts: &Bound<'py, PyAny>,
        threads: Option<usize>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>)> {
        let Numbers { values, shape } = starts.extract()?;
        let (count, expected) = (shape.first().copied().unwrap_or(0), self.dimension);
        match shape[..] {
            [_, dimension] if dimension == expected => {}
            [0] => {}
            _ => {
                let dimension = shape.last().copied().unwrap_or(0);
                return Err(value_error(Error::WrongDimension { dimension, expected }));
            }
        }
        let found = Arc::clone(&self.found);
        let start = move |k: usize, state: &mut [f64]| {
            state.copy_from_slice(&values[expected * k..expected * (k + 1)]);
        };
        let all = move |map: &dyn StateMap| found.convergences(map, count, start);
        let all = on_map(py, &self.function, threads, all)?.map_err(value_error)?;
        let labels = all.iter().map(|(label, _)| label.code()).collect();
        let steps = all.iter().map(|(_, steps)| *steps as u64).collect();
        Ok((shaped(py, labels, &[count])?, shaped(py, steps, &[count])?))
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<()> {
        Err(refused(py, "Attractors", &[("map".to_owned(), &self.function)]))
    }

    /// It never changes.
    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: Py<PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let (count, unmatched) = (self.found.attractors().len(), self.found.unmatched().len());
        match self.found.remedy() {
            Some(remedy) => {
                format!("Attractors(none found, {unmatched} starts unmatched; try {remedy})")
            }
            None => format!("Attractors({count} found, {unmatched} starts unmatched)"),
        }
    }
}

/// The codes of labels that are no basins, by name.
#[pyfunction]
pub(crate) fn label_codes() -> BTreeMap<&'static str, u16> {
    let codes = [
        ("UNDECIDED", Label::UNDECIDED),
        ("UNDECIDED_PRECISION", Label::UNDECIDED_PRECISION),
        ("UNDECIDED_MAP", Label::UNDECIDED_MAP),
        ("OUTSIDE", Label::OUTSIDE),
        ("ESCAPED", Label::ESCAPED),
    ];
    codes.into_iter().map(|(name, label)| (name, label.code())).collect()
}
