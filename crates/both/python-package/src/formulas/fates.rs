//! The ends of many runs.

use super::equations::{Model, begin};
use crate::arrays::shaped;
use crate::errors::{InputError, of_hybrid, value_error};
use crate::hybrid::stop_name;
use crate::interruptible::{Watch, in_background, progress_function, with_threads};
use hybrid_system::{End, Error, FateOf, StateVector, many};
use pyo3::prelude::*;
use std::ops::ControlFlow;
use std::sync::Arc;

/// The ends of many runs, in arrays with one entry for each run.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct Fates {
    all: Vec<Result<FateOf<Model>, Error>>,
    dimension: usize,
}

/// Starts of runs: a mode and a state for each.
type Starts = (Vec<String>, Vec<Vec<f64>>);

/// Times, and the most events.
type RunLimits = ((f64, f64), usize);

/// Threads, and a function of the caller for progress.
type Watching<'py> = (Option<usize>, Option<Bound<'py, PyAny>>);

impl Fates {
    /// Of one model.
    pub(super) fn of_starts(
        py: Python<'_>,
        model: &Arc<Model>,
        starts: Starts,
        limits: RunLimits,
        watching: Watching<'_>,
    ) -> PyResult<Fates> {
        let model = Arc::clone(model);
        Fates::find(py, starts, watching, move |count, (modes, starts), progress| {
            let run = |k: usize| begin(&model, (&modes[k], &starts[k]), limits.0, limits.1);
            model.fates(count, run, progress)
        })
    }

    /// Of a model for each run.
    pub(super) fn of_models(
        py: Python<'_>,
        models: Vec<Arc<Model>>,
        starts: Starts,
        limits: RunLimits,
        watching: Watching<'_>,
    ) -> PyResult<Fates> {
        if models.len() != starts.1.len() {
            let (models, starts) = (models.len(), starts.1.len());
            let text = format!("{models} rows of parameters are given for {starts} starts");
            return Err(InputError::new_err(text));
        }
        Fates::find(py, starts, watching, move |count, (modes, starts), progress| {
            let run = |k: usize| {
                Ok(begin(&models[k], (&modes[k], &starts[k]), limits.0, limits.1)?.fate())
            };
            many(count, run, progress)
        })
    }

    fn find(
        py: Python<'_>,
        (modes, starts): Starts,
        (threads, progress): Watching<'_>,
        work: impl FnOnce(
            usize,
            &Starts,
            &(dyn Fn(usize) -> ControlFlow<()> + Sync),
        ) -> Vec<Option<Result<FateOf<Model>, Error>>>
        + Send
        + 'static,
    ) -> PyResult<Fates> {
        let (count, dimension) = (starts.len(), starts.first().map_or(0, Vec::len));
        if modes.len() != count {
            let text = format!("{} modes are given for {count} starts", modes.len());
            return Err(InputError::new_err(text));
        }
        let progress = progress_function(py, progress)?;
        let starts = (modes, starts);
        let run = move |watch: &Watch| {
            let told = |_: usize| {
                watch.finished(1);
                if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            with_threads(threads, || work(count, &starts, &told)).map_err(|error| error.to_string())
        };
        let report = |done| match &progress {
            Some(progress) => progress.call1((done, count)).map(drop),
            None => Ok(()),
        };
        let found = in_background(py, run, value_error, report)?;
        let all: Option<Vec<_>> = found.into_iter().collect();
        let all = all.ok_or_else(|| value_error("the runs were interrupted"))?;
        Ok(Fates { all, dimension })
    }
}

#[pymethods]
impl Fates {
    fn __len__(&self) -> usize {
        self.all.len()
    }

    /// Why each run ended: as Run.reason. A run that failed has the text of its error.
    #[getter]
    fn reasons(&self) -> Vec<String> {
        let reason = |fate: &Result<FateOf<Model>, Error>| match fate {
            Ok(fate) => match &fate.end {
                End::Terminal(_) => "terminal".to_owned(),
                End::Stopped(stop) => stop_name(*stop).to_owned(),
                End::Failed(error) => format!("failed: {error}"),
            },
            Err(error) => format!("failed: {error}"),
        };
        self.all.iter().map(reason).collect()
    }

    /// The surface whose event ended each run; an empty text for others.
    #[getter]
    fn surfaces(&self) -> Vec<String> {
        let surface = |fate: &Result<FateOf<Model>, Error>| match fate {
            Ok(FateOf::<Model> { end: End::Terminal(surface), .. }) => surface.to_string(),
            _ => String::new(),
        };
        self.all.iter().map(surface).collect()
    }

    /// The mode at the end of each run.
    #[getter]
    fn modes(&self) -> Vec<String> {
        let mode = |fate: &Result<FateOf<Model>, Error>| {
            fate.as_ref().map_or_else(|_| String::new(), |fate| fate.mode.to_string())
        };
        self.all.iter().map(mode).collect()
    }

    /// The time at the end of each run; NaN for one that did not begin.
    #[getter]
    fn times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let times = self.all.iter().map(|fate| fate.as_ref().map_or(f64::NAN, |fate| fate.time));
        shaped(py, times.collect(), &[self.all.len()])
    }

    /// The number of events of each run.
    #[getter]
    fn events<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let events = self.all.iter().map(|fate| fate.as_ref().map_or(0, |fate| fate.events as u64));
        shaped(py, events.collect(), &[self.all.len()])
    }

    /// The state at the end of each run, one row for each; NaN for one that did not begin.
    #[getter]
    fn states<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let row = |fate: &Result<FateOf<Model>, Error>| {
            let known = fate.as_ref().ok().map(|fate| fate.state.components());
            let mut row = known.map_or(Vec::new(), <[f64]>::to_vec);
            row.resize(self.dimension, f64::NAN);
            row
        };
        let rows = self.all.iter().flat_map(row).collect();
        shaped(py, rows, &[self.all.len(), self.dimension])
    }

    /// The exception of the first run that failed; None if all ended.
    #[getter]
    fn first_error(&self, py: Python<'_>) -> Option<(usize, Py<PyAny>)> {
        let failed = self.all.iter().enumerate().find_map(|(k, fate)| match fate {
            Err(error) => Some((k, error)),
            Ok(fate) => match &fate.end {
                End::Failed(error) => Some((k, error)),
                _ => None,
            },
        });
        failed.map(|(k, error)| (k, of_hybrid(error).into_value(py).into_any()))
    }
}
