//! Guards along closed-form flows as functions of time.

use crate::errors::{InputError, value_error};
use crate::pickling::{Reduced, restoring};
use hybrid_system::{Direction, FirstCrossing};
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// A sum of polynomials times exponentials, sines and cosines of time: g(t) = Σ exp(σt) (p(t) cos ωt + q(t) sin ωt).
///
/// Along the flow of constant forces, springs and linear dampers a guard is such a function. A Guard with a signal=
/// has crossings that are certain: none is missed.
///
/// >>> from nonsmooth.hybrid import QuasiPolynomial as Q
/// >>> height = Q.polynomial([0, -4, 0.5]) + Q.sine(5, 1)      # t²/2 − 4t + 5 sin t
/// >>> time = height.first_crossing("falling", 20)
/// >>> abs(height(time)) < 1e-14
/// True
#[pyclass(frozen, eq, module = "nonsmooth.hybrid")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct QuasiPolynomial {
    pub(crate) own: hybrid_system::QuasiPolynomial,
}

#[pymethods]
impl QuasiPolynomial {
    /// A polynomial, lowest power first.
    #[staticmethod]
    fn polynomial(coefficients: Vec<f64>) -> Self {
        hybrid_system::QuasiPolynomial::polynomial(&coefficients).into()
    }

    /// amplitude · sin ωt.
    #[staticmethod]
    fn sine(amplitude: f64, omega: f64) -> Self {
        hybrid_system::QuasiPolynomial::sine(amplitude, omega).into()
    }

    /// amplitude · cos ωt.
    #[staticmethod]
    fn cosine(amplitude: f64, omega: f64) -> Self {
        hybrid_system::QuasiPolynomial::cosine(amplitude, omega).into()
    }

    /// amplitude · exp(rate · t).
    #[staticmethod]
    fn exponential(amplitude: f64, rate: f64) -> Self {
        hybrid_system::QuasiPolynomial::exponential(amplitude, rate).into()
    }

    /// This function times exp(−rate · t).
    fn damped(&self, rate: f64) -> Self {
        self.own.clone().damped(rate).into()
    }

    /// Its derivative.
    fn derivative(&self) -> Self {
        self.own.derivative().into()
    }

    /// The time of the first crossing of zero in a direction ("rising", "falling" or "either") up to a horizon;
    /// None if there is none.
    fn first_crossing(&self, direction: &str, horizon: f64) -> PyResult<Option<f64>> {
        let found = self.own.first_crossing(direction_of(direction)?, horizon);
        match found.map_err(value_error)? {
            FirstCrossing::At { time, .. } => Ok(Some(time)),
            FirstCrossing::Never => Ok(None),
            other => Err(crate::errors::UndecidedError::new_err(format!(
                "the first crossing cannot be decided: {other:?}"
            ))),
        }
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let terms = slf.get().own.to_parts().into_pyobject(slf.py())?;
        restoring(slf.py(), "QuasiPolynomial", PyTuple::new(slf.py(), [terms])?)
    }

    fn __call__(&self, time: f64) -> f64 {
        self.own.value(time)
    }

    fn __add__(&self, other: &Self) -> Self {
        (self.own.clone() + other.own.clone()).into()
    }

    fn __sub__(&self, other: &Self) -> Self {
        (self.own.clone() - other.own.clone()).into()
    }

    fn __neg__(&self) -> Self {
        (-self.own.clone()).into()
    }

    fn __mul__(&self, other: &Bound<'_, PyAny>) -> PyResult<Self> {
        if let Ok(other) = other.cast::<Self>() {
            return Ok((self.own.clone() * other.get().own.clone()).into());
        }
        Ok(self.own.clone().scaled(other.extract()?).into())
    }

    fn __rmul__(&self, factor: f64) -> Self {
        self.own.clone().scaled(factor).into()
    }

    fn __repr__(&self) -> String {
        format!("QuasiPolynomial(value at 0: {:?})", self.own.value(0.0))
    }
}

impl From<hybrid_system::QuasiPolynomial> for QuasiPolynomial {
    fn from(own: hybrid_system::QuasiPolynomial) -> Self {
        QuasiPolynomial { own }
    }
}

/// A direction by its name.
///
/// # Errors
/// ValueError for other words.
pub(crate) fn direction_of(name: &str) -> PyResult<Direction> {
    let all = [Direction::Rising, Direction::Falling, Direction::Either];
    all.into_iter().find(|direction| name_of(*direction) == name).ok_or_else(|| {
        InputError::new_err(format!("a direction is 'rising', 'falling' or 'either', not {name:?}"))
    })
}

/// The name of a direction.
pub(crate) fn name_of(direction: Direction) -> &'static str {
    match direction {
        Direction::Rising => "rising",
        Direction::Falling => "falling",
        Direction::Either => "either",
    }
}
