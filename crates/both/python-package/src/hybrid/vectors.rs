//! States as arrays of NumPy, and back.

use crate::arrays::{Numbers, shaped};
use crate::errors::{InputError, of_result};
use nalgebra::DVector;
use numpy::{PyArray1, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyList, PyTuple};

/// The state of a model.
pub(crate) type State = DVector<f64>;

/// A state as an object of Python.
pub(crate) fn copied(py: Python<'_>, state: &State) -> Py<PyAny> {
    array(py, state.as_slice()).into_any().unbind()
}

/// States as an array, one row for each.
pub(crate) fn state_rows<'py>(
    py: Python<'py>,
    states: &[State],
    dimension: usize,
) -> PyResult<Bound<'py, PyAny>> {
    let rows = states.iter().flat_map(|state| state.as_slice()).copied().collect();
    shaped(py, rows, &[states.len(), dimension])
}

/// A state as an array of its own.
pub(crate) fn array<'py>(py: Python<'py>, state: &[f64]) -> Bound<'py, PyArray1<f64>> {
    PyArray1::from_slice(py, state)
}

/// The numbers of a list, a tuple, or anything that NumPy makes a one-dimensional array of.
pub(crate) fn numbers(object: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    if let Ok(array) = object.cast::<PyArray1<f64>>() {
        return Ok(array.readonly().as_array().iter().copied().collect());
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        return object.extract();
    }
    let Numbers { values, shape } = object.extract()?;
    if shape.len() != 1 {
        let text = format!("a vector is needed, not an array of {} dimensions", shape.len());
        return Err(PyTypeError::new_err(text));
    }
    Ok(values)
}

/// The vector that a function of the model has returned.
///
/// # Errors
/// ValueError for a vector of another length than the state.
pub(crate) fn vector(
    object: &Bound<'_, PyAny>,
    dimension: usize,
    what: &str,
) -> PyResult<DVector<f64>> {
    let numbers = numbers(object).map_err(|error| of_result(object.py(), what, error))?;
    let found = numbers.len();
    if found != dimension {
        let text = format!("{what} returned {found} numbers, and the state has {dimension}");
        return Err(InputError::new_err(text));
    }
    Ok(DVector::from_vec(numbers))
}
