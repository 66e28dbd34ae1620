//! The guards of a model, as a user gives them.

use super::quasi_polynomial::direction_of;
use super::vectors::numbers;
use crate::errors::{InputError, value_error};
use crate::pickling::refused;
use hybrid_system::{Direction, PeriodicTimes, PresetTimes, Role, Touch};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::hash::{DefaultHasher, Hash, Hasher};

/// What follows an event.
#[derive(Debug)]
pub(crate) enum After {
    /// A function of mode and state.
    Reset(Py<PyAny>),
    /// Mode and state stay as they are.
    Nothing,
    /// The execution ends.
    End,
}

/// A surface g(x) = 0, and what happens when a state crosses it.
///
/// name names its events. value(x) is g. direction is "rising" (g goes from negative to positive), "falling" or
/// "either". reset(mode, x) returns the next mode and state as a pair, or None to end the execution.
///
/// role is "switch": an event where the flow crosses the surface, with a reset. If a jump can lead to the far side,
/// the guard must say what that means: "contact", a floor that holds, where the event is at once; or "crossing",
/// which counts only when the flow crosses it. "observer": a crossing without a reset. "terminal": its event ends
/// the execution. touch says what happens where g comes within rounding of zero and goes back: "error", "event" or
/// "ignore". modes is a list of the modes that have the guard; None for all.
///
/// Two optional functions make its crossings certain: signal(mode, x) returns g along the flow from x as a
/// QuasiPolynomial, or None; enclosure(mode, x, order, times) returns bounds (low, high) on a derivative of g along
/// the flow over the times (from, to), or None. Without them a guard of a closed-form flow is sampled, and one of
/// an integrated flow is followed along the steps.
#[pyclass(frozen, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct Guard {
    /// The name.
    #[pyo3(get)]
    name: String,
    pub(crate) value: Py<PyAny>,
    pub(crate) direction: Direction,
    pub(crate) role: Role,
    pub(crate) touch: Touch,
    pub(crate) after: After,
    pub(crate) modes: Option<Vec<Py<PyAny>>>,
    pub(crate) signal: Option<Py<PyAny>>,
    pub(crate) enclosure: Option<Py<PyAny>>,
}

#[pymethods]
impl Guard {
    #[new]
    #[pyo3(signature = (name, value, direction, *, reset = None, role = "switch", touch = "error", modes = None, signal = None,
                        enclosure = None))]
    #[expect(clippy::too_many_arguments, reason = "they are keywords in Python")]
    fn new(
        py: Python<'_>,
        name: String,
        value: Py<PyAny>,
        direction: &str,
        reset: Option<Py<PyAny>>,
        role: &str,
        touch: &str,
        modes: Option<Vec<Py<PyAny>>>,
        signal: Option<Py<PyAny>>,
        enclosure: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        callable(py, "value", Some(&value))?;
        callable(py, "reset", reset.as_ref())?;
        callable(py, "signal", signal.as_ref())?;
        callable(py, "enclosure", enclosure.as_ref())?;
        let (role, after) = match (role, reset) {
            ("switch", Some(reset)) => (Role::Switch, After::Reset(reset)),
            ("contact", Some(reset)) => (Role::Contact, After::Reset(reset)),
            ("crossing" | "observer", Some(reset)) => (Role::Crossing, After::Reset(reset)),
            ("observer", None) => (Role::Crossing, After::Nothing),
            ("terminal", None) => (Role::Switch, After::End),
            ("switch" | "contact" | "crossing", None) => {
                return Err(InputError::new_err(format!(
                    "guard {name:?} is a {role} and needs reset=; a guard without one is role='observer' or \
                     role='terminal'"
                )));
            }
            ("terminal", Some(_)) => {
                return Err(InputError::new_err(format!(
                    "guard {name:?} is terminal: its reset would never be used"
                )));
            }
            (other, _) => {
                return Err(InputError::new_err(format!(
                    "a role is 'switch', 'contact', 'crossing', 'observer' or 'terminal', not {other:?}"
                )));
            }
        };
        let touch = match touch {
            "error" => Touch::Error,
            "event" => Touch::Event,
            "ignore" => Touch::Ignore,
            other => {
                let text = format!("a touch is 'error', 'event' or 'ignore', not {other:?}");
                return Err(InputError::new_err(text));
            }
        };
        let direction = direction_of(direction)?;
        Ok(Guard { name, value, direction, role, touch, after, modes, signal, enclosure })
    }

    fn __reduce__(&self, py: Python<'_>) -> PyResult<()> {
        Err(refused(py, &format!("the guard {:?}", self.name), &self.functions()))
    }

    /// It never changes.
    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: Py<PyAny>) -> Py<Self> {
        slf
    }

    fn __repr__(&self) -> String {
        format!("Guard({:?})", self.name)
    }
}

/// What an event calls, by its name.
fn reset_of(after: &After) -> Option<(String, &Py<PyAny>)> {
    match after {
        After::Reset(reset) => Some(("reset".to_owned(), reset)),
        After::Nothing | After::End => None,
    }
}

impl Guard {
    /// Its functions, by their names.
    pub(crate) fn functions(&self) -> Vec<(String, &Py<PyAny>)> {
        let optional = [("signal", &self.signal), ("enclosure", &self.enclosure)];
        let optional =
            optional.into_iter().filter_map(|(name, own)| Some((name.to_owned(), own.as_ref()?)));
        [("value".to_owned(), &self.value)]
            .into_iter()
            .chain(reset_of(&self.after))
            .chain(optional)
            .collect()
    }

    pub(crate) fn name(&self) -> &str {
        &self.name
    }
}

/// The times of a clock.
#[derive(Debug)]
pub(crate) enum Times {
    Preset(PresetTimes),
    Periodic(PeriodicTimes),
    /// A function from a time to the first event strictly after it, or None.
    Function(Py<PyAny>),
}

/// Events at preset times.
///
/// name names them. reset(mode, x) is as that of a Guard; without it nothing changes. The times are one of: times,
/// a rising sequence, or a function from a time to the next event strictly after it, or None; period, with the time
/// of the first event in first.
#[pyclass(frozen, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct Clock {
    /// The name.
    #[pyo3(get)]
    name: String,
    pub(crate) times: Times,
    pub(crate) after: After,
    pub(crate) modes: Option<Vec<Py<PyAny>>>,
    /// The period, if it has one, and the first time, as they were given.
    periodic: (Option<f64>, f64),
}

#[pymethods]
impl Clock {
    #[new]
    #[pyo3(signature = (name, *, times = None, period = None, first = 0.0, reset = None, modes = None))]
    fn new(
        py: Python<'_>,
        name: String,
        times: Option<Bound<'_, PyAny>>,
        period: Option<f64>,
        first: f64,
        reset: Option<Py<PyAny>>,
        modes: Option<Vec<Py<PyAny>>>,
    ) -> PyResult<Self> {
        callable(py, "reset", reset.as_ref())?;
        if period.is_none() && first != 0.0 {
            let text = format!(
                "clock {name:?} has first={first:?}, which counts with period= alone; begin times= with it"
            );
            return Err(InputError::new_err(text));
        }
        let periodic = (period, first);
        let times = match (times, period) {
            (Some(times), None) if times.is_callable() => Times::Function(times.unbind()),
            (Some(times), None) => {
                Times::Preset(PresetTimes::new(numbers(&times)?).map_err(value_error)?)
            }
            (None, Some(period)) => {
                Times::Periodic(PeriodicTimes::new(first, period).map_err(value_error)?)
            }
            (given, _) => {
                let found = if given.is_some() { "both" } else { "neither" };
                let text =
                    format!("clock {name:?} needs either times= or period=, and has {found}");
                return Err(InputError::new_err(text));
            }
        };
        let after = reset.map_or(After::Nothing, After::Reset);
        Ok(Clock { name, times, after, modes, periodic })
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, ())> {
        let (py, own) = (slf.py(), slf.get());
        let functions = own.functions();
        if !functions.is_empty() {
            return Err(refused(py, &format!("the clock {:?}", own.name), &functions));
        }
        let given = PyDict::new(py);
        match &own.times {
            Times::Preset(times) => given.set_item("times", times.times().to_vec())?,
            _ => {
                given.set_item("period", own.periodic.0)?;
                given.set_item("first", own.periodic.1)?;
            }
        }
        given.set_item("modes", own.modes.as_ref())?;
        let partial = py.import("functools")?.getattr("partial")?;
        Ok((partial.call((slf.get_type(), &own.name), Some(&given))?, ()))
    }

    fn __copy__(slf: Py<Self>) -> Py<Self> {
        slf
    }

    fn __deepcopy__(slf: Py<Self>, _memo: Py<PyAny>) -> Py<Self> {
        slf
    }

    /// Clocks with functions are equal if they are the same object.
    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        if slf.as_any().is(other) {
            return Ok(true);
        }
        let Ok(other) = other.cast::<Self>() else { return Ok(false) };
        let (own, other) = (slf.get(), other.get());
        let plain = own.functions().is_empty() && other.functions().is_empty();
        let times = match (&own.times, &other.times) {
            (Times::Preset(one), Times::Preset(two)) => one == two,
            (Times::Periodic(one), Times::Periodic(two)) => one == two,
            _ => false,
        };
        let modes = match (&own.modes, &other.modes) {
            (None, None) => true,
            (Some(one), Some(two)) => {
                PyList::new(slf.py(), one)?.eq(PyList::new(slf.py(), two)?)?
            }
            _ => false,
        };
        Ok(plain && own.name == other.name && times && modes)
    }

    fn __hash__(&self) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.name.hash(&mut hasher);
        hasher.finish()
    }

    fn __repr__(&self) -> String {
        format!("Clock({:?})", self.name)
    }
}

impl Clock {
    /// Its functions, by their names.
    pub(crate) fn functions(&self) -> Vec<(String, &Py<PyAny>)> {
        let times = match &self.times {
            Times::Function(times) => Some(("times".to_owned(), times)),
            Times::Preset(_) | Times::Periodic(_) => None,
        };
        times.into_iter().chain(reset_of(&self.after)).collect()
    }

    pub(crate) fn name(&self) -> &str {
        &self.name
    }
}

/// TypeError unless an argument, if it is given, can be called.
pub(crate) fn callable(py: Python<'_>, what: &str, object: Option<&Py<PyAny>>) -> PyResult<()> {
    match object {
        Some(object) if !object.bind(py).is_callable() => {
            let found = object.bind(py).get_type().name()?;
            Err(PyTypeError::new_err(format!("{what} must be a function, not {found}")))
        }
        _ => Ok(()),
    }
}
