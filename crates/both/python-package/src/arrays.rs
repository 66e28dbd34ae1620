//! Numbers from whatever NumPy makes an array of, and results of the same shape.

use crate::errors::InputError;
use numpy::{
    AllowTypeChange, Element, PyArray, PyArrayDyn, PyArrayLikeDyn, PyArrayMethods,
    PyReadonlyArrayDyn, PyUntypedArrayMethods,
};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyFloat, PyInt};
use std::ops::Range;

/// The numbers of a scalar or an array, in C order, and its shape.
pub(crate) struct Numbers {
    pub(crate) values: Vec<f64>,
    pub(crate) shape: Vec<usize>,
}

/// The number of a float or an int of Python, and of their subclasses as NumPy's float64. `None` for anything else,
/// which is an array of no dimension: only its type tells whether it is a number.
pub(crate) fn scalar(object: Borrowed<'_, '_, PyAny>) -> Option<f64> {
    if object.is_instance_of::<PyFloat>() || object.is_instance_of::<PyInt>() {
        return object.extract().ok();
    }
    None
}

/// Refuses a masked array with masked numbers: NumPy would hand them on as if they were numbers.
///
/// # Errors
/// TypeError, which says what to do.
fn refuse_masked(object: &Bound<'_, PyAny>) -> PyResult<()> {
    if object.is_exact_instance_of::<PyArrayDyn<f64>>() || !object.hasattr("mask")? {
        return Ok(());
    }
    let masked = object.py().import("numpy")?.getattr("ma")?.getattr("is_masked")?;
    if masked.call1((object,))?.extract()? {
        let text = "the array has masked numbers: give those that count, as by array.compressed(), or array.filled(nan)";
        return Err(PyTypeError::new_err(text));
    }
    Ok(())
}

impl<'a, 'py> FromPyObject<'a, 'py> for Numbers {
    type Error = PyErr;

    /// # Errors
    /// TypeError for what is no number: NumPy itself would make numbers of texts and dates, and drop an imaginary part.
    fn extract(object: Borrowed<'a, 'py, PyAny>) -> PyResult<Self> {
        if let Some(value) = scalar(object) {
            return Ok(Numbers { values: vec![value], shape: Vec::new() });
        }
        refuse_masked(&object)?;
        let array = object.py().import("numpy")?.call_method1("asarray", (object,))?;
        let dtype = array.getattr("dtype")?;
        let kind: String = dtype.getattr("kind")?.extract()?;
        match kind.as_str() {
            "b" | "i" | "u" | "f" => {}
            // Python's own conversion, number by number: None is none.
            "O" => {
                let values = array.call_method0("ravel")?.call_method0("tolist")?.extract()?;
                return Ok(Numbers { values, shape: array.getattr("shape")?.extract()? });
            }
            _ => {
                let text = format!("a number or an array of numbers is needed, not {dtype}");
                return Err(PyTypeError::new_err(text));
            }
        }
        let array: PyArrayLikeDyn<'py, f64, AllowTypeChange> = array.extract()?;
        let view = array.as_array();
        let values = match view.as_slice() {
            Some(values) => values.to_vec(),
            None => view.iter().copied().collect(),
        };
        Ok(Numbers { values, shape: view.shape().to_vec() })
    }
}

/// A number, or an array of numbers.
pub(crate) enum Given {
    One(f64),
    Many(Numbers),
}

impl Given {
    /// # Errors
    /// As of [`Numbers`].
    pub(crate) fn of(object: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Some(one) = scalar(object.as_borrowed()) {
            return Ok(Given::One(one));
        }
        let numbers: Numbers = object.extract()?;
        Ok(match (numbers.shape.as_slice(), numbers.values.as_slice()) {
            ([], &[one]) => Given::One(one),
            _ => Given::Many(numbers),
        })
    }
}

/// Where speeds are read from, piece by piece.
pub(crate) enum Source<'py> {
    /// An array of f64 whose numbers are beside each other. Another Python thread may change it during a
    /// computation: each piece is copied while the interpreter is locked.
    Array(PyReadonlyArrayDyn<'py, f64>),
    /// Anything else, converted once.
    Converted(Numbers),
}

impl<'py> Source<'py> {
    pub(crate) fn of(object: &Bound<'py, PyAny>) -> PyResult<Self> {
        refuse_masked(object)?;
        if let Ok(array) = object.cast::<PyArrayDyn<f64>>()
            && array.is_c_contiguous()
            && let Ok(array) = array.try_readonly()
        {
            return Ok(Source::Array(array));
        }
        object.extract().map(Source::Converted)
    }

    pub(crate) fn shape(&self) -> Vec<usize> {
        match self {
            Source::Array(array) => array.shape().to_vec(),
            Source::Converted(numbers) => numbers.shape.clone(),
        }
    }

    /// Puts the numbers of this range into `piece`.
    pub(crate) fn copy(&self, range: Range<usize>, piece: &mut Vec<f64>) -> PyResult<()> {
        let all = match self {
            Source::Array(array) => array.as_slice()?,
            Source::Converted(numbers) => &numbers.values,
        };
        let Some(part) = all.get(range) else {
            let text = "the array was made shorter during the call";
            return Err(InputError::new_err(text));
        };
        piece.clear();
        piece.extend_from_slice(part);
        Ok(())
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
