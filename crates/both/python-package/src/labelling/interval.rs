//! A number with an interval.

use crate::pickling::{Reduced, plain, reduced};
use basin_of_attraction::{Bounds, ConfidenceInterval};
use pyo3::prelude::*;

/// A number, and an interval in which it lies: a 95 % confidence interval, or bounds. The source says which.
#[pyclass(frozen, get_all, eq, from_py_object, module = "nonsmooth.labelling")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Interval {
    /// The estimate. It need not be the middle.
    value: f64,
    /// The lower end.
    lower: f64,
    /// The upper end.
    upper: f64,
}

plain!(Interval { value, lower, upper });

#[pymethods]
impl Interval {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    pub(crate) fn __repr__(&self) -> String {
        let Interval { value, lower, upper } = self;
        format!("Interval(value={value:?}, lower={lower:?}, upper={upper:?})")
    }

    fn __contains__(&self, number: f64) -> bool {
        self.lower <= number && number <= self.upper
    }
}

impl From<ConfidenceInterval> for Interval {
    fn from(ConfidenceInterval { value, lower, upper }: ConfidenceInterval) -> Self {
        Interval { value, lower, upper }
    }
}

impl From<Bounds> for crate::basins::Bounds {
    fn from(Bounds { lower, upper }: Bounds) -> Self {
        crate::basins::Bounds { lower, upper }
    }
}
