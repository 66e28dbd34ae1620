//! The symbols of a call, and the formulas of what it returns.

use super::symbol::{Parts, Symbol};
use crate::arrays::shaped;
use crate::errors::{TracingError, of_hybrid, value_error};
use crate::hybrid::numbers;
use crate::pickling::Reduced;
use equations::{Names, Node};
use pyo3::prelude::*;
use pyo3::types::PyTuple;
use std::sync::PoisonError;

/// The symbols of some functions of one model, with names.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct Trace {
    names: Names,
    parts: Parts,
}

#[pymethods]
impl Trace {
    /// parameters has pairs of a name and a value: a decimal as text.
    #[new]
    fn new(states: Vec<String>, parameters: Vec<(String, String)>) -> PyResult<Self> {
        let states: Vec<&str> = states.iter().map(String::as_str).collect();
        let parameters: Vec<_> =
            parameters.iter().map(|(name, value)| (name.as_str(), value.as_str())).collect();
        let names = Names::new(&states, &parameters).map_err(value_error)?;
        Ok(Trace { names, parts: Parts::default() })
    }

    /// The symbol of the time.
    fn time(&self) -> PyResult<Symbol> {
        Symbol::of(&self.parts, Node::Time)
    }

    /// The symbols of the components of the state.
    fn state(&self) -> PyResult<Vec<Symbol>> {
        let all = 0..self.names.states.len();
        all.map(|place| Symbol::of(&self.parts, Node::State(place))).collect()
    }

    /// The symbols of the parameters.
    fn parameters(&self) -> PyResult<Vec<Symbol>> {
        let all = 0..self.names.parameters.len();
        all.map(|place| Symbol::of(&self.parts, Node::Parameter(place))).collect()
    }

    /// The formulas of texts.
    fn of_text(&self, texts: Vec<String>) -> PyResult<Formulas> {
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let own = equations::Formulas::from_text(self.names.clone(), &texts);
        Ok(Formulas { own: own.map_err(value_error)? })
    }

    /// The formulas of what a function has returned: symbols and numbers.
    fn formulas(&self, outputs: Vec<Bound<'_, PyAny>>) -> PyResult<Formulas> {
        let zero = Symbol::of(&self.parts, Node::Time)?;
        let place = |output: &Bound<'_, PyAny>| match zero.operand(output)? {
            Some(symbol) => Ok(symbol.place),
            None => {
                let kind = output.get_type().name()?;
                let text =
                    format!("a list of numbers is needed, and it has a value of type {kind}");
                Err(TracingError::new_err(text))
            }
        };
        let places = outputs.iter().map(place).collect::<PyResult<Vec<_>>>()?;
        let recorded = self.parts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(text) = &recorded.refused {
            return Err(TracingError::new_err(text.clone()));
        }
        let own = equations::Formulas::of_nodes(self.names.clone(), &recorded.nodes, &places);
        Ok(Formulas { own: own.map_err(value_error)? })
    }
}

/// Formulas of the time, the state and the parameters.
///
/// str(formulas) shows them; pickle and copy keep them with exact numbers.
#[pyclass(frozen, module = "nonsmooth")]
pub(crate) struct Formulas {
    pub(super) own: equations::Formulas,
}

#[pymethods]
impl Formulas {
    /// The formulas of a text of JSON.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        Ok(Formulas { own: equations::Formulas::from_json(text).map_err(value_error)? })
    }

    /// The formulas as JSON, with exact numbers.
    #[getter]
    fn json(&self) -> String {
        self.own.to_json()
    }

    /// Each formula as text.
    #[getter]
    fn texts(&self) -> Vec<String> {
        self.own.texts()
    }

    /// Each formula in LaTeX.
    #[getter]
    fn latex(&self) -> Vec<String> {
        self.own.latex()
    }

    /// The derivatives by the components of the state, row by row, as formulas.
    fn jacobian(&self) -> PyResult<Formulas> {
        Ok(Formulas { own: self.own.jacobian().map_err(value_error)? })
    }

    /// The values at a time and a state; at other values of parameters, given by their names.
    #[pyo3(signature = (time, state, parameters = None))]
    fn values<'py>(
        &self,
        py: Python<'py>,
        time: f64,
        state: &Bound<'py, PyAny>,
        parameters: Option<Vec<(String, f64)>>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let state = numbers(state)?;
        let found = match parameters {
            None => self.own.values(time, &state),
            Some(changed) => {
                let texts: Vec<String> =
                    changed.iter().map(|(_, value)| format!("{value:?}")).collect();
                let names = changed.iter().map(|(name, _)| name.as_str());
                let pairs: Vec<_> = names.zip(texts.iter().map(String::as_str)).collect();
                let own = self.own.clone().with_parameters(&pairs);
                own.and_then(|own| own.values(time, &state))
            }
        };
        let found = found.map_err(|error| of_hybrid(&error.into()))?;
        let count = found.len();
        shaped(py, found, &[count])
    }

    fn __len__(&self) -> usize {
        self.own.count()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (make, json) = (slf.get_type().getattr("from_json")?, slf.get().json());
        Ok((make, PyTuple::new(slf.py(), [json])?))
    }

    fn __eq__(&self, other: &Bound<'_, PyAny>) -> bool {
        other.cast::<Formulas>().is_ok_and(|other| other.get().own == self.own)
    }

    fn __repr__(&self) -> String {
        format!("Formulas({:?})", self.own.texts())
    }
}
