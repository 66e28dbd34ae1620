//! Sliding points as Python objects.

use super::model::Model;
use super::names::{ExecutionMode, ExecutionSurface};
use super::vectors::{State, copied};
use crate::pickling::{Reduced, equal, plain, reduced};
use pyo3::prelude::*;

/// A point of a surface at which the fields on both sides point.
#[pyclass(frozen, get_all, module = "nonsmooth.hybrid")]
#[derive(Debug)]
pub(crate) struct Sliding {
    /// The name of the guard.
    surface: String,
    /// The mode where the guard is negative.
    below: Py<PyAny>,
    /// The mode where it is positive.
    above: Py<PyAny>,
    /// The time.
    time: f64,
    /// The state on the surface.
    state: Py<PyAny>,
    /// The rates of the guard below the surface and above it.
    rates: (f64, f64),
    /// The field of Filippov's convention, tangent to the surface; None if the model has no field.
    field: Option<Py<PyAny>>,
}

impl Sliding {
    pub(crate) fn of(
        py: Python<'_>,
        model: &Model,
        sliding: &hybrid_system::Sliding<ExecutionMode, ExecutionSurface, State>,
    ) -> PyResult<Self> {
        Ok(Sliding {
            surface: model.event_name(sliding.surface),
            below: model.mode_object(py, sliding.below)?,
            above: model.mode_object(py, sliding.above)?,
            time: sliding.time,
            state: copied(py, &sliding.state),
            rates: sliding.rates,
            field: sliding.field.as_ref().map(|field| copied(py, field)),
        })
    }
}

plain!(Sliding { surface, below, above, time, state, rates, field });

#[pymethods]
impl Sliding {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __eq__(slf: &Bound<'_, Self>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
        equal(slf, other)
    }

    fn __repr__(&self) -> String {
        format!("Sliding({:?}, time={:?}, rates={:?})", self.surface, self.time, self.rates)
    }
}
