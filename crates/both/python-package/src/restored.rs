//! The objects that pickle has stored, by the names of their classes.

use crate::basins::{Bounds, restored_basins};
use crate::errors::InputError;
use crate::fates::Fate;
use crate::fixed_points::Crisis;
use crate::hop::{Hop, Landing};
use crate::hybrid::{Event, QuasiPolynomial, Sliding, SlidingMode, Zeno};
use crate::labelling::{BoxCount, Interval, UncertaintyExponent};
use crate::pickling::Plain;
use hybrid_system::QuasiPolynomialPart;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

fn plain_of<T: Plain>(py: Python<'_>, values: &Bound<'_, PyTuple>) -> PyResult<Py<PyAny>> {
    Ok(Py::new(py, T::restored(values)?)?.into_any())
}

/// The object that pickle has stored.
#[pyfunction]
pub(crate) fn _restored(
    py: Python<'_>,
    kind: &str,
    values: &Bound<'_, PyTuple>,
) -> PyResult<Py<PyAny>> {
    match kind {
        "Landing" => plain_of::<Landing>(py, values),
        "Hop" => plain_of::<Hop>(py, values),
        "Fate" => plain_of::<Fate>(py, values),
        "Crisis" => plain_of::<Crisis>(py, values),
        "Bounds" => plain_of::<Bounds>(py, values),
        "Interval" => plain_of::<Interval>(py, values),
        "BoxCount" => plain_of::<BoxCount>(py, values),
        "UncertaintyExponent" => plain_of::<UncertaintyExponent>(py, values),
        "Event" => plain_of::<Event>(py, values),
        "Zeno" => plain_of::<Zeno>(py, values),
        "Sliding" => plain_of::<Sliding>(py, values),
        "SlidingMode" => plain_of::<SlidingMode>(py, values),
        "QuasiPolynomial" => {
            let (parts,): (Vec<QuasiPolynomialPart>,) = values.extract()?;
            let own = hybrid_system::QuasiPolynomial::from_parts(parts);
            Ok(Py::new(py, QuasiPolynomial::from(own))?.into_any())
        }
        "IntervalBasins" => restored_basins(py, values),
        other => Err(InputError::new_err(format!(
            "this version of passive_hopper has no {other} in its pickles"
        ))),
    }
}
