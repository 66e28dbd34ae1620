//! Numbers from whatever NumPy makes an array of, and results of the same shape.

use numpy::{AllowTypeChange, Element, PyArray, PyArrayLikeDyn, PyArrayMethods};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;

/// The numbers of a scalar or an array, in C order, and its shape.
pub(crate) struct Numbers {
    pub(crate) values: Vec<f64>,
    pub(crate) shape: Vec<usize>,
}

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers {
    type Error = PyErr;

    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        // Fast for single numbers.
        if let Ok(value) = object.extract::<f64>() {
            return Ok(Numbers { values: vec![value], shape: Vec::new() });
        }
        // NumPy makes NaN of None.
        if object.is_none() {
            return Err(PyTypeError::new_err(
                "a number or an array of numbers is needed, not None",
            ));
        }
        let array: PyArrayLikeDyn<'py, f64, AllowTypeChange> = object.extract()?;
        let view = array.as_array();
        let values = match view.as_slice() {
            Some(values) => values.to_vec(),
            None => view.iter().copied().collect(),
        };
        Ok(Numbers { values, shape: view.shape().to_vec() })
    }
}

/// An array of this shape.
pub(crate) fn shaped<'py, T: Element>(
    py: Python<'py>,
    values: Vec<T>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    let array = PyArray::from_vec(py, values).reshape(shape.to_vec())?;
    Ok(array.into_any())
}

/// A float for a scalar, an array for an array.
pub(crate) fn like<'py>(
    py: Python<'py>,
    values: Vec<f64>,
    shape: &[usize],
) -> PyResult<Bound<'py, PyAny>> {
    match (shape, values.as_slice()) {
        ([], &[value]) => Ok(value.into_pyobject(py)?.into_any()),
        _ => shaped(py, values, shape),
    }
}
