//! Fixed points, traps and crises.

use crate::errors::value_error;
use crate::pickling::{Reduced, plain, reduced};
use crate::whole::whole;
use hopper_basin::TrapEdge;
use passive_hopper::MassRatio;
use pyo3::prelude::*;

/// Fixed points between two looks for Ctrl-C: a millisecond.
const LOOK: usize = 1 << 12;

/// The trap [α*_n, α*_n + Δ]: every orbit in it converges to α*_n.
#[pyclass(frozen, eq, module = "passive_hopper")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Trap {
    trap: hopper_basin::Trap,
    mass_ratio: f64,
}

#[pymethods]
impl Trap {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        let (py, own) = (slf.py(), slf.get());
        let make = py.import("passive_hopper")?.getattr("trap")?;
        Ok((make, (own.trap.n, own.mass_ratio).into_pyobject(py)?))
    }

    /// The index of the fixed point.
    #[getter]
    fn n(&self) -> u64 {
        self.trap.n
    }

    /// α*_n, in units of m₂gω/k.
    #[getter]
    fn left(&self) -> f64 {
        self.trap.fixed_point.value()
    }

    /// α*_n + Δ.
    #[getter]
    fn right(&self) -> f64 {
        self.trap.right()
    }

    /// Δ, the length.
    #[getter]
    fn length(&self) -> f64 {
        self.trap.delta
    }

    /// Bound on the error of the length.
    #[getter]
    fn error(&self) -> f64 {
        self.trap.error
    }

    /// Why the trap ends there: "crossing", "contact end" or "next fixed point".
    #[getter]
    fn edge(&self) -> &'static str {
        match self.trap.edge {
            TrapEdge::Crossing => "crossing",
            TrapEdge::ContactEnd => "contact end",
            TrapEdge::NextFixedPoint => "next fixed point",
        }
    }

    fn __repr__(&self) -> String {
        let (left, right) = (self.left(), self.right());
        format!("Trap(n={}, left={left:?}, right={right:?}, edge={:?})", self.n(), self.edge())
    }

    fn __contains__(&self, alpha: f64) -> bool {
        self.trap.contains(alpha)
    }
}

/// A mass ratio at which the map's minimum on a hump touches its fixed point, or zero.
#[pyclass(frozen, get_all, eq, module = "passive_hopper")]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Crisis {
    /// The index of the hump.
    n: u64,
    /// The mass ratio M ≤ 1 at the touch; it happens at 1/M as well.
    mass_ratio: f64,
    /// Bound on the error of the mass ratio.
    error: f64,
    /// The lift-off speed of the minimum at the touch, to an ulp.
    alpha: f64,
}

plain!(Crisis { n, mass_ratio, error, alpha });

#[pymethods]
impl Crisis {
    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<Reduced<'py>> {
        reduced(slf)
    }

    fn __repr__(&self) -> String {
        format!("Crisis(n={}, mass_ratio={:?}, alpha={:?})", self.n, self.mass_ratio, self.alpha)
    }
}

/// α*_n, the n-th solution of tan α* = α*, in units of m₂gω/k: a float for an int, an array for a sequence of ints.
///
/// >>> from passive_hopper import alpha_star
/// >>> alpha_star(1)
/// 4.493409457909064
#[pyfunction]
pub(crate) fn alpha_star<'py>(
    py: Python<'py>,
    n: &Bound<'py, PyAny>,
) -> PyResult<Bound<'py, PyAny>> {
    let star = |n: &Bound<'py, PyAny>| whole(n).map(passive_hopper::alpha_star);
    let indices = match (star(n), n.try_iter()) {
        (Ok(star), _) => return Ok(star.into_pyobject(py)?.into_any()),
        (Err(_), Ok(indices)) => indices,
        (Err(error), Err(_)) => return Err(error),
    };
    let mut stars = Vec::new();
    for n in indices {
        // A range may be long.
        if stars.len().is_multiple_of(LOOK) {
            py.check_signals()?;
        }
        stars.push(star(&n?)?);
    }
    let count = stars.len();
    crate::arrays::shaped(py, stars, &[count])
}

/// The trap of α*_n.
#[pyfunction]
pub(crate) fn trap(#[pyo3(from_py_with = whole)] n: u64, mass_ratio: f64) -> PyResult<Trap> {
    let ratio = MassRatio::new(mass_ratio).map_err(value_error)?;
    hopper_basin::Trap::new(n, ratio).map(|trap| Trap { trap, mass_ratio }).map_err(value_error)
}

impl From<hopper_basin::Crisis> for Crisis {
    fn from(of: hopper_basin::Crisis) -> Self {
        Crisis { n: of.n, mass_ratio: of.mass_ratio, error: of.error, alpha: of.alpha }
    }
}

/// The mass ratio from which orbits of hump n fall below α*_n.
#[pyfunction]
pub(crate) fn crisis(#[pyo3(from_py_with = whole)] n: u64) -> PyResult<Crisis> {
    hopper_basin::crisis(n).map(Crisis::from).map_err(value_error)
}

/// The mass ratio from which orbits of hump n are grounded.
#[pyfunction]
pub(crate) fn grounding(#[pyo3(from_py_with = whole)] n: u64) -> PyResult<Crisis> {
    hopper_basin::grounding(n).map(Crisis::from).map_err(value_error)
}
