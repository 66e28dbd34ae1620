//! A map of states of a user: a function of Python, or steps that need none.

use crate::arrays::shaped;
use crate::errors::{ComputationError, of_callback, of_result, value_error};
use crate::formulas::Steps;
use crate::interruptible::{Watch, in_background, with_threads};
use basin_of_attraction::{Error, StateMap, watched_map};
use numpy::PyArray1;
use pyo3::prelude::*;
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
pub(super) fn on_map<T: Send + 'static>(
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

/// A feature of Python: a function from the points of a stretch of an orbit, one a row, to some numbers.
pub(super) struct PythonFeature {
    pub(super) function: Py<PyAny>,
    exception: Mutex<Option<PyErr>>,
}

impl PythonFeature {
    pub(super) fn new(function: Py<PyAny>) -> Self {
        PythonFeature { function, exception: Mutex::new(None) }
    }

    /// NaN after an exception: then the orbit has no feature.
    pub(super) fn of(&self, points: &[Vec<f64>]) -> Vec<f64> {
        if self.lock().is_some() {
            return vec![f64::NAN];
        }
        let call = |py: Python<'_>| {
            let shape = [points.len(), points.first().map_or(0, Vec::len)];
            let found = self
                .function
                .bind(py)
                .call1((shaped(py, points.concat(), &shape)?,))
                .map_err(|error| of_callback(py, "features", error))?;
            let number = |error| of_result(py, "features", error);
            found
                .extract::<Vec<f64>>()
                .or_else(|_| Ok(vec![found.extract::<f64>().map_err(number)?]))
        };
        Python::attach(call).unwrap_or_else(|error| {
            self.lock().get_or_insert(error);
            vec![f64::NAN]
        })
    }

    /// What was found, unless the function has raised an exception.
    pub(super) fn unless_raised<T>(&self, found: T) -> PyResult<T> {
        self.lock().take().map_or(Ok(found), Err)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Option<PyErr>> {
        self.exception.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
