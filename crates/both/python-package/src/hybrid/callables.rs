//! A model during one call: the hybrid system of the library, whose functions are those of Python.
//!
//! The library has no way to pass an exception through its searches. The first exception is therefore kept, all
//! later values are NaN without a call of Python, the search ends at once on them, and the caller raises the
//! exception that is kept.

use super::c_function::{CField, CGuard};
use super::guards::{After, Times};
use super::model::{Model, Watched};
use super::names::{Mode, Surface};
use super::quasi_polynomial::QuasiPolynomial;
use super::sliding::Sliding;
use super::vectors::{State, array, numbers, vector};
use crate::errors::{InputError, of_callback, of_result};
use hybrid_system::{
    Enclosure, Error, Filippov, FilippovMode, FilippovSurface, Guard, NextEvent, Reset, Search,
    StateVector, default_search, integrated_crossing, integrated_states,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyTuple};
use std::cell::RefCell;

/// A model during one call.
pub(crate) struct Callables<'py, 'a> {
    py: Python<'py>,
    pub(crate) model: &'a Model,
    exception: RefCell<Option<PyErr>>,
    /// The first number of a function that is not finite, in words: the cause of what follows from it.
    not_finite: RefCell<Option<String>>,
}

impl<'py, 'a> Callables<'py, 'a> {
    pub(crate) fn new(py: Python<'py>, model: &'a Model) -> Self {
        Callables { py, model, exception: RefCell::new(None), not_finite: RefCell::new(None) }
    }

    /// The same with the motion along surfaces, if the user wants it.
    pub(crate) fn with_sliding(py: Python<'py>, model: &'a Model) -> Filippov<Self> {
        let callables = Callables::new(py, model);
        Filippov::new(callables, model.tolerances).following(model.follows)
    }

    /// The first exception of a function. It is told once.
    pub(crate) fn exception(&self) -> Option<PyErr> {
        self.exception.borrow_mut().take()
    }

    /// The exception of an error of the library. Where a number is not finite it names the function that gave it first.
    pub(crate) fn raised(&self, error: &Error) -> PyErr {
        self.model.exception(self.py, error, self.not_finite.borrow_mut().take())
    }

    /// Remembers a result that is not finite, and where the function was called.
    fn seen(&self, what: &str, found: &[f64], mode: Mode, state: &State) {
        if found.iter().all(|number| number.is_finite()) || self.not_finite.borrow().is_some() {
            return;
        }
        let mode = self
            .mode(mode)
            .bind(self.py)
            .repr()
            .map_or_else(|_| "?".into(), |text| text.to_string());
        let text = format!(
            "{what} returned {found:?} in mode {mode} from the state {:?}",
            state.as_slice()
        );
        *self.not_finite.borrow_mut() = Some(text.replace("NaN", "nan"));
    }

    /// The value of a call, unless it or an earlier one has raised an exception.
    fn kept<T>(&self, what: &str, call: impl FnOnce() -> PyResult<T>) -> Option<T> {
        if self.exception.borrow().is_some() {
            return None;
        }
        // A function that is written in C would never see Ctrl-C.
        match self.py.check_signals().and_then(|()| call()) {
            Ok(value) => Some(value),
            Err(error) => {
                let error = of_callback(self.py, what, error);
                *self.exception.borrow_mut() = Some(error);
                None
            }
        }
    }

    fn mode(&self, mode: Mode) -> Py<PyAny> {
        self.model.modes.name(self.py, mode)
    }

    fn array(&self, state: &State) -> Bound<'py, PyAny> {
        array(self.py, state.as_slice()).into_any()
    }

    /// A pair of a mode and a state that a function returned; `None` for None.
    fn pair(
        &self,
        found: &Bound<'py, PyAny>,
        dimension: usize,
        what: &str,
    ) -> PyResult<Option<(Mode, State)>> {
        if found.is_none() {
            return Ok(None);
        }
        let Ok((mode, state)) = found.extract::<(Bound<'py, PyAny>, Bound<'py, PyAny>)>() else {
            let text = format!("{what} must return a pair (mode, state), or None, not {found}");
            return Err(PyTypeError::new_err(text));
        };
        let mode =
            self.model.modes.number(&mode).map_err(|error| of_result(self.py, what, error))?;
        let next = vector(&state, dimension, what)?;
        if next.iter().any(|number| !number.is_finite()) {
            let text = format!("{what} returned the state {state}; its numbers must be finite");
            return Err(InputError::new_err(text));
        }
        Ok(Some((mode, next)))
    }

    fn nan(state: &State) -> State {
        state.filled(|_| f64::NAN)
    }
}

impl hybrid_system::HybridSystem for Callables<'_, '_> {
    type State = State;
    type Mode = Mode;
    type Surface = Surface;

    fn flow(&self, mode: Mode, start: &State, time: f64) -> State {
        let Some(flow) = &self.model.functions.flow else {
            let found = integrated_states(self, mode, start, &[time], self.model.tolerances);
            // Without this the reason would be lost in a state of NaN.
            return match found.map(|mut states| states.pop()) {
                Ok(Some(state)) => state,
                Ok(None) => Self::nan(start),
                Err(error) => {
                    let raised = self.raised(&error);
                    self.kept("field", || Err::<(), _>(raised));
                    Self::nan(start)
                }
            };
        };
        let call = || {
            let found = flow.bind(self.py).call1((self.mode(mode), self.array(start), time))?;
            vector(&found, start.len(), "flow")
        };
        let found = self.kept("flow", call).unwrap_or_else(|| Self::nan(start));
        self.seen(&format!("flow over the time {time:?}"), found.as_slice(), mode, start);
        found
    }

    fn flow_at(&self, mode: Mode, start: &State, times: &[f64]) -> Result<Vec<State>, Error> {
        match self.model.functions.flow {
            Some(_) => Ok(times.iter().map(|&time| self.flow(mode, start, time)).collect()),
            None => integrated_states(self, mode, start, times, self.model.tolerances),
        }
    }

    fn guards(&self, mode: Mode) -> &[Guard<Surface>] {
        self.model.guards(mode)
    }

    fn guard_value(&self, surface: Surface, state: &State) -> f64 {
        let Some(Watched::Guard(guard)) = self.model.watched.get(surface.0) else {
            return f64::NAN;
        };
        let what = || format!("the value of {:?}", guard.get().name());
        let call = || {
            let value = guard.get().value.bind(self.py);
            if let Ok(own) = value.cast::<CGuard>() {
                return Ok(own.get().value(state.as_slice()));
            }
            let found = value.call1((self.array(state),))?;
            // True and False would be numbers, and one of them the surface itself. NumPy's have the second name before version 2.
            let name = found.get_type().name()?;
            if found.is_instance_of::<PyBool>() || name == "bool" || name == "bool_" {
                let text = format!(
                    "{} returned {found}; return a number that is zero on the surface and changes its sign there",
                    what()
                );
                return Err(PyTypeError::new_err(text));
            }
            found.extract().map_err(|error| of_result(self.py, &what(), error))
        };
        let found = self.kept(&what(), call).unwrap_or(f64::NAN);
        if !found.is_finite() && self.not_finite.borrow().is_none() {
            let text = format!("{} is {found:?} at the state {:?}", what(), state.as_slice());
            *self.not_finite.borrow_mut() = Some(text.replace("NaN", "nan"));
        }
        found
    }

    fn reset(&self, mode: Mode, surface: Surface, before: &State) -> Reset<Mode, State> {
        let Some(watched) = self.model.watched.get(surface.0) else { return Reset::Stop };
        let reset = match watched.after() {
            After::Nothing => return Reset::Jump { mode, state: before.clone() },
            After::End => return Reset::Stop,
            After::Reset(reset) => reset,
        };
        let what = || format!("the reset of {:?}", watched.name());
        let call = || {
            let found = reset.bind(self.py).call1((self.mode(mode), self.array(before)))?;
            self.pair(&found, before.len(), &what())
        };
        match self.kept(&what(), call).flatten() {
            Some((mode, state)) => Reset::Jump { mode, state },
            None => Reset::Stop,
        }
    }

    fn rest(&self, mode: Mode, limit: &State) -> Option<(Mode, State)> {
        let rest = self.model.functions.rest.as_ref()?.bind(self.py);
        let call = || {
            let found = rest.call1((self.mode(mode), self.array(limit)))?;
            self.pair(&found, limit.len(), "rest")
        };
        self.kept("rest", call).flatten()
    }

    fn slide(
        &self,
        sliding: &hybrid_system::Sliding<Mode, Surface, State>,
    ) -> Option<(Mode, State)> {
        let slide = self.model.functions.slide.as_ref()?.bind(self.py);
        let call = || {
            let point = hybrid_system::Sliding {
                surface: FilippovSurface::Model(sliding.surface),
                below: FilippovMode::Free(sliding.below),
                above: FilippovMode::Free(sliding.above),
                time: sliding.time,
                state: sliding.state.clone(),
                rates: sliding.rates,
                fields: sliding.fields.clone(),
                field: sliding.field.clone(),
            };
            let point = Sliding::of(self.py, self.model, &point)?;
            self.pair(&slide.call1((point,))?, sliding.state.len(), "slide")
        };
        self.kept("slide", call).flatten()
    }

    fn vector_field(&self, mode: Mode, state: &State) -> Option<State> {
        let field = self.model.functions.field.as_ref()?.bind(self.py);
        let call = || {
            if let Ok(own) = field.cast::<CField>() {
                let mut rates = Self::nan(state);
                let mode = self.mode(mode);
                own.get().write(
                    self.py,
                    mode.bind(self.py),
                    state.as_slice(),
                    rates.as_mut_slice(),
                )?;
                return Ok(rates);
            }
            let found = field.call1((self.mode(mode), self.array(state)))?;
            vector(&found, state.len(), "field")
        };
        let found = self.kept("field", call).unwrap_or_else(|| Self::nan(state));
        self.seen("field", found.as_slice(), mode, state);
        Some(found)
    }

    fn next_time(&self, _: Mode, surface: Surface, after: f64) -> Option<f64> {
        let Some(Watched::Clock(clock)) = self.model.watched.get(surface.0) else { return None };
        match &clock.get().times {
            Times::Preset(times) => times.next_after(after),
            Times::Periodic(times) => times.next_after(after),
            Times::Function(next) => {
                let what = format!("the times of {:?}", clock.get().name());
                let call = || {
                    let found = next.bind(self.py).call1((after,))?;
                    let time: Option<f64> =
                        found.extract().map_err(|error| of_result(self.py, &what, error))?;
                    match time {
                        Some(time) if time.is_nan() || time <= after => {
                            Err(InputError::new_err(format!(
                                "{what} returned {found} for the time after {after:?}; give a later time, or None"
                            )))
                        }
                        time => Ok(time),
                    }
                };
                self.kept(&what, call).flatten()
            }
        }
    }

    fn guard_quasi_polynomial(
        &self,
        mode: Mode,
        surface: Surface,
        start: &State,
    ) -> Option<hybrid_system::QuasiPolynomial> {
        let Some(Watched::Guard(guard)) = self.model.watched.get(surface.0) else { return None };
        let signal = guard.get().signal.as_ref()?.bind(self.py);
        let what = format!("the signal of {:?}", guard.get().name());
        let call = || {
            let found = signal.call1((self.mode(mode), self.array(start)))?;
            if found.is_none() {
                return Ok(None);
            }
            match found.cast::<QuasiPolynomial>() {
                Ok(found) => {
                    let own = &found.get().own;
                    let at_start = own.value(0.0);
                    if !at_start.is_finite() {
                        let text = format!(
                            "{what} returned a function that is {at_start} at the state {:?}; its coefficients must be \
                             finite",
                            start.as_slice()
                        );
                        return Err(InputError::new_err(text.replace("NaN", "nan")));
                    }
                    Ok(Some(own.clone()))
                }
                Err(_) => Err(PyTypeError::new_err(format!(
                    "{what} must return a QuasiPolynomial, or None, not {found}"
                ))),
            }
        };
        self.kept(&what, call).flatten()
    }

    fn guard_enclosure(
        &self,
        mode: Mode,
        surface: Surface,
        start: &State,
        order: u32,
        times: (f64, f64),
    ) -> Option<Enclosure> {
        let Some(Watched::Guard(guard)) = self.model.watched.get(surface.0) else { return None };
        let enclosure = guard.get().enclosure.as_ref()?.bind(self.py);
        let what = format!("the enclosure of {:?}", guard.get().name());
        let call = || {
            let times = PyTuple::new(self.py, [times.0, times.1])?;
            let found = enclosure.call1((self.mode(mode), self.array(start), order, times))?;
            if found.is_none() {
                return Ok(None);
            }
            match numbers(&found).map_err(|error| of_result(self.py, &what, error))?[..] {
                [low, high] if low <= high => Ok(Some(Enclosure::new(low, high))),
                [_, _] => Err(InputError::new_err(format!(
                    "{what} returned {found} for the derivative {order}: the lower bound must not exceed the upper one"
                ))),
                _ => Err(PyTypeError::new_err(format!(
                    "{what} must return a pair of bounds (low, high), or None, not {found}"
                ))),
            }
        };
        self.kept(&what, call).flatten()
    }

    fn first_crossing(
        &self,
        mode: Mode,
        start: &State,
        search: &Search<Surface>,
    ) -> Result<NextEvent<Surface, State>, Error> {
        match self.model.functions.flow {
            Some(_) => default_search(self, mode, start, search),
            None => integrated_crossing(self, mode, start, search, self.model.tolerances),
        }
    }
}
