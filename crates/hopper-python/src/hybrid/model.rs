//! A hybrid system as a user gives it.

use super::execution::Execution;
use super::guards::{After, Clock, Guard, callable};
use super::names::{Mode, Modes, Surface};
use super::vectors::numbers;
use crate::errors::{UndecidedError, value_error};
use hybrid_system::{Error, Limits, Tolerances};
use nalgebra::DVector;
use pyo3::exceptions::{PyArithmeticError, PyTypeError, PyValueError};
use pyo3::prelude::*;
use std::sync::Arc;

/// A guard or a clock.
#[derive(Debug)]
pub(crate) enum Watched {
    Guard(Py<Guard>),
    Clock(Py<Clock>),
}

impl Watched {
    pub(crate) fn name(&self) -> &str {
        match self {
            Watched::Guard(guard) => guard.get().name(),
            Watched::Clock(clock) => clock.get().name(),
        }
    }

    pub(crate) fn after(&self) -> &After {
        match self {
            Watched::Guard(guard) => &guard.get().after,
            Watched::Clock(clock) => &clock.get().after,
        }
    }

    fn modes(&self) -> Option<&[Py<PyAny>]> {
        match self {
            Watched::Guard(guard) => guard.get().modes.as_deref(),
            Watched::Clock(clock) => clock.get().modes.as_deref(),
        }
    }

    fn guard(&self, surface: Surface) -> hybrid_system::Guard<Surface> {
        match self {
            Watched::Guard(guard) => {
                let Guard { direction, role, touch, .. } = *guard.get();
                hybrid_system::Guard { surface, direction, role, touch }
            }
            Watched::Clock(_) => hybrid_system::Guard::clock(surface),
        }
    }
}

/// The functions of a model.
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) flow: Option<Py<PyAny>>,
    pub(crate) field: Option<Py<PyAny>>,
    pub(crate) rest: Option<Py<PyAny>>,
    pub(crate) slide: Option<Py<PyAny>>,
    pub(crate) tolerances: Tolerances,
    pub(crate) watched: Vec<Watched>,
    pub(crate) modes: Modes,
    /// The guards of each mode that some guard names.
    lists: Vec<Vec<hybrid_system::Guard<Surface>>>,
    /// The guards of all other modes.
    everywhere: Vec<hybrid_system::Guard<Surface>>,
}

impl Model {
    /// The guards of a mode.
    pub(crate) fn guards(&self, mode: Mode) -> &[hybrid_system::Guard<Surface>] {
        self.lists.get(mode.0).unwrap_or(&self.everywhere)
    }

    /// The exception of an error: UndecidedError where rounding hides what happens, ArithmeticError where a computation cannot go on,
    /// ValueError for wrong input. Modes and guards have their names in the message.
    pub(crate) fn exception(&self, py: Python<'_>, error: &Error) -> PyErr {
        let mut text = error.to_string();
        for number in 0..self.modes.count() {
            let name = self.modes.name(py, Mode(number));
            let shown = name.bind(py).repr().map_or_else(|_| "?".into(), |shown| shown.to_string());
            text = text.replace(&format!("{:?}", Mode(number)), &shown);
        }
        for (number, watched) in self.watched.iter().enumerate() {
            let shown = format!("{:?}", watched.name());
            text = text.replace(&format!("{:?}", Surface(number)), &shown);
        }
        match error {
            Error::Grazing { .. } | Error::UndecidedStart { .. } | Error::UndecidedSign { .. } => {
                UndecidedError::new_err(text)
            }
            Error::StateNotFinite { .. }
            | Error::FieldNotFinite { .. }
            | Error::NotFinite { .. }
            | Error::Integration { .. }
            | Error::NoConvergence { .. }
            | Error::TimelessChain { .. }
            | Error::SlidingNotUnique { .. } => PyArithmeticError::new_err(text),
            _ => PyValueError::new_err(text),
        }
    }
}

/// A hybrid system: a flow that is interrupted by events.
///
/// The motion is either flow(mode, x, t), the state after the time t ≥ 0 from x in closed form, or field(mode, x), the right-hand side of
/// ẋ = f(x), which is integrated with this tolerance. (A flow may have a field as well, which sliding needs.) x is an array; a function returns a
/// list, a tuple or an array. A mode is any hashable object. guards is a list of Guard and Clock.
///
/// rest(mode, x) returns the mode and the state after infinitely many events in finite time (Zeno), or None; slide(sliding) those on a
/// surface at which the fields on both sides point. Without them the execution ends there.
///
/// sampled is the interval at which guards of a flow in closed form are looked at, unless they have a signal or an enclosure.
/// longest_step and check_interval bound the steps of an integration, and the distance of two looks at its guards.
///
/// >>> from passive_hopper.hybrid import Guard, HybridSystem
/// >>> ball = HybridSystem(
/// ...     flow=lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t],
/// ...     guards=[Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0, -x[1] / 2]))],
/// ...     sampled=0.01,
/// ... )
/// >>> [round(arc.event.time, 12) for arc in ball.run([0.5, 0], time=2.8) if arc.event]
/// [1.0, 2.0, 2.5, 2.75]
///
/// An exception in a function ends the call with this exception.
#[pyclass(frozen, module = "passive_hopper.hybrid")]
#[derive(Debug)]
pub(crate) struct HybridSystem {
    model: Arc<Model>,
    sampled: Option<f64>,
}

#[pymethods]
impl HybridSystem {
    #[new]
    #[pyo3(signature = (*, flow = None, field = None, guards = Vec::new(), rest = None, slide = None, tolerance = 1e-10,
                        longest_step = f64::INFINITY, check_interval = f64::INFINITY, sampled = None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        py: Python<'_>,
        flow: Option<Py<PyAny>>,
        field: Option<Py<PyAny>>,
        guards: Vec<Bound<'_, PyAny>>,
        rest: Option<Py<PyAny>>,
        slide: Option<Py<PyAny>>,
        tolerance: f64,
        longest_step: f64,
        check_interval: f64,
        sampled: Option<f64>,
    ) -> PyResult<Self> {
        for (what, object) in
            [("flow", &flow), ("field", &field), ("rest", &rest), ("slide", &slide)]
        {
            callable(py, what, object.as_ref())?;
        }
        if flow.is_none() && field.is_none() {
            return Err(PyValueError::new_err("a hybrid system needs flow= or field="));
        }
        let mut watched: Vec<Watched> = Vec::new();
        for object in &guards {
            let own = if let Ok(guard) = object.cast::<Guard>() {
                Watched::Guard(guard.clone().unbind())
            } else if let Ok(clock) = object.cast::<Clock>() {
                Watched::Clock(clock.clone().unbind())
            } else {
                let found = object.get_type().name()?;
                let text = format!("guards are of Guard and Clock, not {found}");
                return Err(PyTypeError::new_err(text));
            };
            if watched.iter().any(|other| other.name() == own.name()) {
                let text =
                    format!("two guards are named {:?}: an event could not be told", own.name());
                return Err(PyValueError::new_err(text));
            }
            watched.push(own);
        }
        let modes = Modes::new(py);
        for mode in watched.iter().filter_map(Watched::modes).flatten() {
            modes.number(mode.bind(py))?;
        }
        let mut lists = vec![Vec::new(); modes.count()];
        let mut everywhere = Vec::new();
        for (number, own) in watched.iter().enumerate() {
            let guard = own.guard(Surface(number));
            match own.modes() {
                None => {
                    everywhere.push(guard);
                    lists.iter_mut().for_each(|list| list.push(guard));
                }
                Some(named) => {
                    for mode in named {
                        let at = modes.number(mode.bind(py))?.0;
                        // A mode that is named twice has the guard once.
                        if lists[at].last().is_none_or(|last| last.surface != guard.surface) {
                            lists[at].push(guard);
                        }
                    }
                }
            }
        }
        let tolerances =
            Tolerances::both(tolerance).longest_step(longest_step).check_interval(check_interval);
        let model =
            Model { flow, field, rest, slide, tolerances, watched, modes, lists, everywhere };
        Ok(HybridSystem { model: Arc::new(model), sampled })
    }

    /// The execution from a state in a mode, up to a time and to a number of events: an iterator over its arcs.
    #[pyo3(signature = (start, *, time, mode = None, events = 1_000_000, start_time = 0.0))]
    fn run(
        &self,
        py: Python<'_>,
        start: &Bound<'_, PyAny>,
        time: f64,
        mode: Option<Bound<'_, PyAny>>,
        events: usize,
        start_time: f64,
    ) -> PyResult<Execution> {
        let state = DVector::from_vec(numbers(start)?);
        if state.is_empty() {
            return Err(PyValueError::new_err("a state has at least one number"));
        }
        if !start_time.is_finite() {
            return Err(value_error(Error::BadLimit { what: "the start time", value: start_time }));
        }
        let mode = mode.unwrap_or_else(|| py.None().into_bound(py));
        let mode = self.model.modes.number(&mode)?;
        let limits = Limits { sampling_interval: self.sampled, ..Limits::new(time, events) };
        Ok(Execution::new(py, Arc::clone(&self.model), mode, state, (start_time, limits)))
    }

    fn __repr__(&self) -> String {
        let names: Vec<&str> = self.model.watched.iter().map(Watched::name).collect();
        format!("HybridSystem(guards={names:?})")
    }
}
