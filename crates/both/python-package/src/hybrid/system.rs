//! A hybrid system as a user gives it.

use super::execution::Execution;
use super::guards::callable;
use super::model::{Functions, Model, Watched};
use super::sliding_mode::SlidingMode;
use super::vectors::numbers;
use crate::errors::{InputError, value_error};
use crate::pickling::refused;
use crate::whole::whole;
use hybrid_system::{Error, Limits, Tolerances};
use nalgebra::DVector;
use pyo3::prelude::*;
use std::sync::Arc;

/// A hybrid system: a flow that is interrupted by events.
///
/// The motion is either flow(mode, x, t), the state after the time t ≥ 0 from x in closed form, or field(mode, x),
/// the right-hand side of ẋ = f(x), which is integrated with this tolerance. (A flow may have a field as well,
/// which sliding needs.) x is an array; a function returns a list, a tuple or an array. A mode is any hashable
/// object. guards is a list of Guard and Clock.
///
/// rest(mode, x) returns the mode and the state after infinitely many events in finite time (Zeno), or None;
/// slide(sliding) those on a surface at which the fields on both sides point. Without them the execution ends
/// there. With slide="filippov" it goes on along the surface, in a SlidingMode, by the mean of both fields that is
/// tangent to it (Filippov's convention), until the field of one side turns tangent.
///
/// sampled is the interval at which guards of a flow in closed form are looked at, unless they have a signal or an
/// enclosure. longest_step and check_interval bound the steps of an integration, and the distance of two looks at
/// its guards.
///
/// >>> from nonsmooth.hybrid import Guard, HybridSystem
/// >>> ball = HybridSystem(
/// ...     flow=lambda mode, x, t: [x[0] + t * (x[1] - t / 2), x[1] - t],
/// ...     guards=[Guard("floor", lambda x: x[0], "falling", reset=lambda mode, x: (mode, [0, -x[1] / 2]))],
/// ...     sampled=0.01,
/// ... )
/// >>> [round(arc.event.time, 12) for arc in ball.run([0.5, 0], time=2.8) if arc.event]
/// [1.0, 2.0, 2.5, 2.75]
///
/// An exception in a function ends the call with this exception.
#[pyclass(frozen, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct HybridSystem {
    model: Arc<Model>,
    sampled: Option<f64>,
}

impl HybridSystem {
    pub(super) fn model(&self) -> &Arc<Model> {
        &self.model
    }
}

#[pymethods]
impl HybridSystem {
    #[new]
    #[pyo3(signature = (*, flow = None, field = None, guards = Vec::new(), rest = None, slide = None, tolerance = 1e-10,
                        longest_step = f64::INFINITY, check_interval = f64::INFINITY, sampled = None),
           text_signature = "(*, flow=None, field=None, guards=(), rest=None, slide=None, tolerance=1e-10, longest_step=1e999, check_interval=1e999, sampled=None)")]
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
        let follows = match slide.as_ref().map(|slide| slide.extract::<String>(py)) {
            Some(Ok(name)) if name == "filippov" => true,
            Some(Ok(other)) => {
                let text = format!("slide is a function or 'filippov', not {other:?}");
                return Err(InputError::new_err(text));
            }
            _ => false,
        };
        let slide = slide.filter(|_| !follows);
        for (what, object) in
            [("flow", &flow), ("field", &field), ("rest", &rest), ("slide", &slide)]
        {
            callable(py, what, object.as_ref())?;
        }
        if follows && field.is_none() {
            return Err(InputError::new_err("slide='filippov' needs field="));
        }
        if flow.is_none() && field.is_none() {
            return Err(InputError::new_err("a hybrid system needs flow= or field="));
        }
        let positive = [("longest_step", longest_step), ("check_interval", check_interval)];
        let sampling = sampled.map(|value| ("sampled", value));
        let finite = [("tolerance", tolerance)].into_iter().chain(sampling);
        for (name, value) in positive.into_iter().chain(finite.clone()) {
            if value.is_nan() || value <= 0.0 {
                return Err(InputError::new_err(format!("{name} must be positive, not {value:?}")));
            }
        }
        for (name, value) in finite {
            if !value.is_finite() {
                return Err(InputError::new_err(format!("{name} must be finite, not {value:?}")));
            }
        }
        let tolerances =
            Tolerances::both(tolerance).longest_step(longest_step).check_interval(check_interval);
        let functions = Functions { flow, field, rest, slide };
        let model = Model::new(py, functions, &guards, (tolerances, follows))?;
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
        #[pyo3(from_py_with = whole)] events: usize,
        start_time: f64,
    ) -> PyResult<Execution> {
        let of_start = |error: PyErr| {
            let text = format!("start is no vector of numbers: {}", error.value(py));
            PyErr::from_type(error.get_type(py), text)
        };
        let state = DVector::from_vec(numbers(start).map_err(of_start)?);
        if state.is_empty() {
            return Err(InputError::new_err("a state has at least one number"));
        }
        if !start_time.is_finite() {
            return Err(value_error(Error::BadLimit { what: "the start time", value: start_time }));
        }
        if time.is_nan() {
            return Err(value_error(Error::BadLimit { what: "the time", value: time }));
        }
        if time < start_time {
            let text = format!(
                "time={time:?} is before start_time={start_time:?}: the execution would end before it starts"
            );
            return Err(InputError::new_err(text));
        }
        if mode.as_ref().is_some_and(|mode| mode.is_instance_of::<SlidingMode>()) {
            let text = "an execution starts in a mode of the model: on a surface it slides at once";
            return Err(InputError::new_err(text));
        }
        let mode = mode.unwrap_or_else(|| py.None().into_bound(py));
        let mode = self.model.modes.number(&mode)?;
        let limits = Limits { sampling_interval: self.sampled, ..Limits::new(time, events) };
        Ok(Execution::new(py, Arc::clone(&self.model), mode, state, (start_time, limits)))
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<()> {
        Err(refused(py, "a HybridSystem", &self.model.functions()))
    }

    /// It never changes.
    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: Py<PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        let names: Vec<&str> = self.model.watched.iter().map(Watched::name).collect();
        format!("HybridSystem(guards={names:?})")
    }
}
