//! A system whose functions are all of C: it runs without the interpreter, and many of its runs on all processors.

use super::arcs::HybridArc;
use super::c_function::{CFunction, Pointer};
use super::guards::Times;
use super::model::{Model, Watched};
use super::names::{ExecutionMode, ExecutionSurface, Mode, Surface};
use super::system::HybridSystem;
use super::trajectory::stop_name;
use super::vectors::State;
use crate::arrays::shaped;
use crate::errors::value_error;
use crate::interruptible::{Watch, in_background, progress_function, with_threads};
use crate::whole::whole;
use hybrid_system::{
    End, Error, Execution, FateOf, Filippov, FilippovMode, Guard, Limits, NextEvent, Reset, Search,
    StateVector, Tolerances, integrated_crossing, integrated_states, many,
};
use nalgebra::DVector;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::ops::ControlFlow;
use std::sync::Arc;

/// What follows an event.
enum Next {
    Nothing,
    End,
    Jump { reset: Option<Pointer>, mode: Option<Mode> },
}

/// The functions of a system, and what keeps them alive.
struct Parts {
    model: Arc<Model>,
    /// By the numbers of the modes.
    fields: Vec<Pointer>,
    /// The value of each guard, and what follows its event. A clock has no value.
    surfaces: Vec<(Option<Pointer>, Next)>,
    _owners: Vec<Py<CFunction>>,
}

/// A system whose functions are all of C. The last component of a state is the time.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct CSystem {
    functions: Arc<Parts>,
}

/// A guard or a clock: its value, its reset, the next mode, whether its event ends the run, and whether it only observes.
type GivenSurface<'py> =
    (Option<Py<CFunction>>, Option<Py<CFunction>>, Option<Bound<'py, PyAny>>, bool, bool);

/// A run: a mode, a start whose last component is the time, and all parameters.
type GivenRun<'py> = (Bound<'py, PyAny>, Vec<f64>, Vec<f64>);

/// What a run gives: its arcs, why it stopped, when, and its error.
type Arcs = (
    Vec<hybrid_system::Arc<ExecutionMode, ExecutionSurface, State>>,
    Option<hybrid_system::Stop>,
    f64,
    Option<Error>,
);

/// The same as objects of Python.
type Ran = (Vec<HybridArc>, Option<&'static str>, f64, Option<Py<PyAny>>);

#[pymethods]
impl CSystem {
    /// `system` has the guards and tolerances, `fields` the function of each mode.
    #[new]
    fn new(
        system: &HybridSystem,
        fields: Vec<(Bound<'_, PyAny>, Py<CFunction>)>,
        surfaces: Vec<GivenSurface<'_>>,
    ) -> PyResult<Self> {
        let model = Arc::clone(system.model());
        let mut owners = Vec::new();
        let mut kept = |own: Py<CFunction>| {
            let function = own.get().pointer();
            owners.push(own);
            function
        };
        let mut by_mode = Vec::new();
        for (mode, field) in fields {
            by_mode.push((model.modes.number(&mode)?.0, kept(field)));
        }
        by_mode.sort_by_key(|(mode, _)| *mode);
        let mut own = Vec::new();
        for (value, reset, to, ends, observes) in surfaces {
            let mode = to.map(|to| model.modes.number(&to)).transpose()?;
            let after = match (ends, observes) {
                (true, _) => Next::End,
                (_, true) => Next::Nothing,
                _ => Next::Jump { reset: reset.map(&mut kept), mode },
            };
            own.push((value.map(&mut kept), after));
        }
        let fields = by_mode.into_iter().map(|(_, field)| field).collect();
        Ok(CSystem { functions: Arc::new(Parts { model, fields, surfaces: own, _owners: owners }) })
    }

    /// The arcs of a run between two times, why and when it ended, and its exception if it failed.
    fn arcs(
        &self,
        py: Python<'_>,
        run: GivenRun<'_>,
        times: (f64, f64),
        #[pyo3(from_py_with = whole)] events: usize,
    ) -> PyResult<Ran> {
        let (mode, start, parameters) = run;
        let functions = Arc::clone(&self.functions);
        let mode = FilippovMode::Free(functions.model.modes.number(&mode)?);
        let work = move |watch: &Watch| {
            let run = Run { functions: &functions, parameters: &parameters, watch };
            let system = Filippov::new(run, functions.model.tolerances);
            let limits = Limits::new(times.1, events);
            let execution = Execution::new(&system, mode, DVector::from_vec(start), limits);
            let mut execution = execution.starting_at(times.0);
            let (mut arcs, mut error) = (Vec::new(), None);
            for arc in execution.by_ref() {
                match arc {
                    Ok(arc) => arcs.push(arc),
                    Err(found) => error = Some(found),
                }
            }
            let (stop, time) = (execution.stop(), execution.checkpoint().time());
            Ok::<Arcs, String>((arcs, stop, time, error))
        };
        let (arcs, stop, time, error) = in_background(py, work, value_error, |_| Ok(()))?;
        let model = &self.functions.model;
        let arcs = arcs.into_iter().map(|arc| HybridArc::new(Arc::clone(model), arc)).collect();
        let error = error.map(|error| model.exception(py, &error, None).into_value(py).into_any());
        Ok((arcs, stop.map(stop_name), time, error))
    }

    /// How each of many runs ends: a dictionary of lists and arrays.
    fn fates<'py>(
        &self,
        py: Python<'py>,
        runs: Vec<GivenRun<'py>>,
        times: (f64, f64),
        #[pyo3(from_py_with = whole)] events: usize,
        threads: Option<usize>,
        progress: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let progress = progress_function(py, progress)?;
        let functions = Arc::clone(&self.functions);
        let number = |(mode, start, parameters): GivenRun<'_>| {
            Ok((functions.model.modes.number(&mode)?, DVector::from_vec(start), parameters))
        };
        let runs: Vec<(Mode, State, Vec<f64>)> =
            runs.into_iter().map(number).collect::<PyResult<_>>()?;
        let count = runs.len();
        let work = move |watch: &Watch| {
            let one = |k: usize| {
                let (mode, start, parameters) = &runs[k];
                let run = Run { functions: &functions, parameters, watch };
                let system = Filippov::new(run, functions.model.tolerances);
                let limits = Limits::new(times.1, events);
                let mode = FilippovMode::Free(*mode);
                Row::of(
                    Execution::new(&system, mode, start.clone(), limits)
                        .starting_at(times.0)
                        .fate(),
                )
            };
            let told = |_: usize| {
                watch.finished(1);
                if watch.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            with_threads(threads, || many(count, one, told)).map_err(|error| error.to_string())
        };
        let report = |done| match &progress {
            Some(progress) => progress.call1((done, count)).map(drop),
            None => Ok(()),
        };
        let found: Vec<Row> =
            in_background(py, work, value_error, report)?.into_iter().flatten().collect();
        self.columns(py, found)
    }
}

impl CSystem {
    fn columns<'py>(&self, py: Python<'py>, rows: Vec<Row>) -> PyResult<Bound<'py, PyDict>> {
        let model = &self.functions.model;
        let (count, dimension) = (rows.len(), rows.first().map_or(0, |row| row.state.len()));
        let reason = |row: &Row| match &row.end {
            End::Terminal(_) => "terminal".to_owned(),
            End::Stopped(stop) => stop_name(*stop).to_owned(),
            End::Failed(error) => format!("failed: {}", model.exception(py, error, None).value(py)),
        };
        let surface = |row: &Row| match &row.end {
            End::Terminal(surface) => model.event_name(*surface),
            _ => String::new(),
        };
        let mode = |row: &Row| model.mode_object(py, row.mode);
        let found = PyDict::new(py);
        found.set_item("reason", rows.iter().map(reason).collect::<Vec<_>>())?;
        found.set_item("surface", rows.iter().map(surface).collect::<Vec<_>>())?;
        found.set_item("mode", rows.iter().map(mode).collect::<PyResult<Vec<_>>>()?)?;
        let times = rows.iter().map(|row| row.time).collect();
        found.set_item("time", shaped::<f64>(py, times, &[count])?)?;
        let events = rows.iter().map(|row| row.events as u64).collect();
        found.set_item("events", shaped::<u64>(py, events, &[count])?)?;
        let states = rows.iter().flat_map(|row| row.state.iter().copied()).collect();
        found.set_item("state", shaped::<f64>(py, states, &[count, dimension])?)?;
        Ok(found)
    }
}

/// How a run ended.
struct Row {
    end: End<ExecutionSurface>,
    mode: ExecutionMode,
    state: State,
    time: f64,
    events: usize,
}

impl Row {
    fn of(fate: FateOf<Filippov<Run<'_>>>) -> Row {
        let FateOf::<Filippov<Run<'_>>> { end, mode, state, time, events } = fate;
        Row { end, mode, state, time, events }
    }
}

/// A system of C during one run. Next Ctrl-C its field has no value, so that the run ends.
struct Run<'r> {
    functions: &'r Parts,
    parameters: &'r [f64],
    watch: &'r Watch,
}

impl Run<'_> {
    /// Writes the results of a function of the time, the other components and the parameters.
    fn write(&self, function: Pointer, state: &State, results: &mut [f64]) {
        if let Some((time, components)) = state.as_slice().split_last() {
            function.write(*time, components, self.parameters, results);
        }
    }

    fn tolerances(&self) -> Tolerances {
        self.functions.model.tolerances
    }
}

impl hybrid_system::HybridSystem for Run<'_> {
    type State = State;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, start: &State, time: f64) -> State {
        let states = self.flow_at(mode, start, &[time]);
        let end = states.ok().and_then(|mut states| states.pop());
        end.unwrap_or_else(|| start.filled(|_| f64::NAN))
    }

    fn flow_at(&self, mode: Mode, start: &State, times: &[f64]) -> Result<Vec<State>, Error> {
        integrated_states(self, mode, start, times, self.tolerances())
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        self.functions.model.guards(mode)
    }

    fn guard_value(&self, surface: Surface, state: &State) -> f64 {
        let mut value = [f64::NAN];
        if let Some((Some(function), _)) = self.functions.surfaces.get(surface.0) {
            self.write(*function, state, &mut value);
        }
        value[0]
    }

    fn reset(&self, mode: Mode, surface: Surface, before: &State) -> Reset<Mode, State> {
        match self.functions.surfaces.get(surface.0) {
            None | Some((_, Next::End)) => Reset::Stop,
            Some((_, Next::Nothing)) => Reset::Jump { mode, state: before.clone() },
            Some((_, Next::Jump { reset, mode: to })) => {
                let mut state = before.clone();
                if let Some(reset) = reset
                    && let Some((_, components)) = state.as_mut_slice().split_last_mut()
                {
                    self.write(*reset, before, components);
                }
                Reset::Jump { mode: to.unwrap_or(mode), state }
            }
        }
    }

    fn vector_field(&self, mode: Mode, state: &State) -> Option<State> {
        let field = *self.functions.fields.get(mode.0)?;
        let mut rates = state.filled(|_| f64::NAN);
        if !self.watch.is_stopped()
            && let Some((of_time, others)) = rates.as_mut_slice().split_last_mut()
        {
            self.write(field, state, others);
            *of_time = 1.0;
        }
        Some(rates)
    }

    fn next_time(&self, _: Mode, surface: Surface, after: f64) -> Option<f64> {
        let Watched::Clock(clock) = self.functions.model.watched.get(surface.0)? else {
            return None;
        };
        match &clock.get().times {
            Times::Preset(times) => times.next_after(after),
            Times::Periodic(times) => times.next_after(after),
            // A function of Python is none of C.
            Times::Function(_) => None,
        }
    }

    fn first_crossing(
        &self,
        mode: Mode,
        start: &State,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State>, Error> {
        integrated_crossing(self, mode, start, search, self.tolerances())
    }
}
