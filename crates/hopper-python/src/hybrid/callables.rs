//! A model during one call: the hybrid system of the library, whose functions are those of Python.
//!
//! The library has no way to pass an exception through its searches. The first exception is therefore kept, all later values are NaN without a call
//! of Python, the search ends at once on them, and the caller raises the exception that is kept.

use super::guards::{After, Times};
use super::model::{Model, Watched};
use super::names::{Mode, Surface};
use super::quasi_polynomial::QuasiPolynomial;
use super::sliding::Sliding;
use super::vectors::{State, array, vector};
use crate::errors::of_callback;
use hybrid_system::{
    Enclosure, Error, Filippov, FilippovMode, FilippovSurface, Guard, NextEvent, Reset, Search,
    StateVector, default_search, integrated_crossing, integrated_flow, integrated_states,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::cell::RefCell;

/// A model during one call.
pub(crate) struct Callables<'py, 'a> {
    py: Python<'py>,
    pub(crate) model: &'a Model,
    exception: RefCell<Option<PyErr>>,
}

impl<'py, 'a> Callables<'py, 'a> {
    pub(crate) fn new(py: Python<'py>, model: &'a Model) -> Self {
        Callables { py, model, exception: RefCell::new(None) }
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

    /// The value of a call, unless it or an earlier one has raised an exception.
    fn kept<T>(&self, call: impl FnOnce() -> PyResult<T>) -> Option<T> {
        if self.exception.borrow().is_some() {
            return None;
        }
        // A function that is written in C would never see Ctrl-C.
        match self.py.check_signals().and_then(|()| call()) {
            Ok(value) => Some(value),
            Err(error) => {
                let error = of_callback(self.py, "of the model", error);
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
        Ok(Some((self.model.modes.number(&mode)?, vector(&state, dimension, what)?)))
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
            return integrated_flow(self, mode, start, time, self.model.tolerances);
        };
        let call = || {
            let found = flow.bind(self.py).call1((self.mode(mode), self.array(start), time))?;
            vector(&found, start.len(), "flow")
        };
        self.kept(call).unwrap_or_else(|| Self::nan(start))
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
        let call = || guard.get().value.bind(self.py).call1((self.array(state),))?.extract();
        self.kept(call).unwrap_or(f64::NAN)
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
        match self.kept(call).flatten() {
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
        self.kept(call).flatten()
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
        self.kept(call).flatten()
    }

    fn vector_field(&self, mode: Mode, state: &State) -> Option<State> {
        let field = self.model.functions.field.as_ref()?.bind(self.py);
        let call = || {
            let found = field.call1((self.mode(mode), self.array(state)))?;
            vector(&found, state.len(), "field")
        };
        Some(self.kept(call).unwrap_or_else(|| Self::nan(state)))
    }

    fn next_time(&self, _: Mode, surface: Surface, after: f64) -> Option<f64> {
        let Some(Watched::Clock(clock)) = self.model.watched.get(surface.0) else { return None };
        match &clock.get().times {
            Times::Preset(times) => times.next_after(after),
            Times::Periodic(times) => times.next_after(after),
            Times::Function(next) => {
                self.kept(|| next.bind(self.py).call1((after,))?.extract::<Option<f64>>()).flatten()
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
        let call = || {
            let found = signal.call1((self.mode(mode), self.array(start)))?;
            if found.is_none() {
                return Ok(None);
            }
            match found.cast::<QuasiPolynomial>() {
                Ok(found) => Ok(Some(found.get().own.clone())),
                Err(_) => Err(PyTypeError::new_err(format!(
                    "the signal of {:?} must return a QuasiPolynomial, or None, not {found}",
                    guard.get().name()
                ))),
            }
        };
        self.kept(call).flatten()
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
        let call = || {
            let times = PyTuple::new(self.py, [times.0, times.1])?;
            let found = enclosure.call1((self.mode(mode), self.array(start), order, times))?;
            let ends: Option<(f64, f64)> = found.extract()?;
            Ok(ends.map(|(low, high)| Enclosure::new(low, high)))
        };
        self.kept(call).flatten()
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
