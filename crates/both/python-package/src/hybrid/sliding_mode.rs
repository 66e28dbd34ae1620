//! Sliding modes as Python objects.

use crate::pickling::{Reduced, plain, reduced};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// The mode of a motion along a surface, by Filippov's convention.
///
/// Two of them are equal if the surface and the modes on both sides are.
#[pyclass(frozen, get_all, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct SlidingMode {
    /// The name of the guard.
    pub(crate) surface: String,
    /// The mode where the guard is negative.
    pub(crate) below: Py<PyAny>,
    /// The mode where it is positive.
    pub(crate) above: Py<PyAny>,
}

impl SlidingMode {
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyTuple>> {
        (&self.surface, self.below.bind(py), self.above.bind(py)).into_pyobject(py)
    }
}

plain!(SlidingMode { surface, below, above });

#[pymethods]
impl SlidingMode {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __eq__(&self, py: Python<'_>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        match other.cast::<SlidingMode>() {
            Ok(other) => self.parts(py)?.eq(other.get().parts(py)?),
            Err(_) => Ok(false),
        }
    }

    fn __hash__(&self, py: Python<'_>) -> PyResult<isize> {
        self.parts(py)?.hash()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let (below, above) = (self.below.bind(py).repr()?, self.above.bind(py).repr()?);
        Ok(format!("SlidingMode({:?}, below={below}, above={above})", self.surface))
    }
}
