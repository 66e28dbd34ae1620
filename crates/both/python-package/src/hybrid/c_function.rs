//! Functions that are written in C, or compiled to it: they are called without the interpreter.
#![expect(
    unsafe_code,
    reason = "a function of C is a bare address: the contract of CFunction is what makes its call safe"
)]

use crate::errors::value_error;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// void f(double t, const double *x, const double *p, double *out)
type Function = unsafe extern "C" fn(f64, *const f64, *const f64, *mut f64);

/// The function of a [`CFunction`], which whoever has it keeps: it alone makes them.
#[derive(Clone, Copy)]
pub(super) struct Pointer(Function);

impl Pointer {
    /// The results at a time and a state.
    pub(super) fn write(self, time: f64, state: &[f64], parameters: &[f64], results: &mut [f64]) {
        // Safety: the contract of `CFunction`. The slices live during the call.
        unsafe {
            (self.0)(time, state.as_ptr(), parameters.as_ptr(), results.as_mut_ptr());
        }
    }
}

/// A function of C with the signature `void (double, double *, double *, double *)`: of the time, the components of the state, the parameters, and the
/// results that it writes.
///
/// # Contract
/// The caller of `CFunction(address, …)` promises that there is a function with this signature at the address, that it reads as many components and
/// parameters as the system has, writes as many results as it is asked for, may be called from any thread, and stays as long as `owner` lives. The
/// front checks the signature where the object tells it, and demands it of a bare address.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct CFunction {
    pointer: Pointer,
    /// What keeps the function alive: it is not called after this is gone.
    owner: Py<PyAny>,
}

impl CFunction {
    /// The function. The caller keeps this object as long as it has it.
    pub(super) fn pointer(&self) -> Pointer {
        self.pointer
    }

    fn write(&self, time: f64, state: &[f64], parameters: &[f64], results: &mut [f64]) {
        self.pointer.write(time, state, parameters, results);
    }
}

#[pymethods]
impl CFunction {
    #[new]
    fn new(address: usize, owner: Py<PyAny>) -> PyResult<Self> {
        if address == 0 {
            return Err(value_error("there is no function at the address 0"));
        }
        // Safety: the contract of this class.
        let function = unsafe { std::mem::transmute::<usize, Function>(address) };
        Ok(CFunction { pointer: Pointer(function), owner })
    }

    /// The results at a time and a state.
    fn __call__(
        &self,
        time: f64,
        state: Vec<f64>,
        parameters: Vec<f64>,
        results: usize,
    ) -> Vec<f64> {
        let mut found = vec![f64::NAN; results];
        self.write(time, &state, &parameters, &mut found);
        found
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        Ok(format!("CFunction({})", self.owner.bind(py).repr()?))
    }
}

/// A function of C at the values of its parameters, of a state whose last component is the time.
struct AtParameters {
    function: Py<CFunction>,
    parameters: Vec<f64>,
}

impl AtParameters {
    fn write(&self, state: &[f64], results: &mut [f64]) {
        let Some((time, components)) = state.split_last() else { return };
        self.function.get().write(*time, components, &self.parameters, results);
    }
}

/// The field of a model by functions of C, one for each mode. The last component of the state is the time.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct CField {
    /// By mode.
    functions: Py<PyDict>,
}

/// The function of one mode of a [`CField`].
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct CFieldOfMode(AtParameters);

#[pymethods]
impl CField {
    #[new]
    fn new(
        py: Python<'_>,
        functions: Vec<(Bound<'_, PyAny>, Py<CFunction>)>,
        parameters: Vec<f64>,
    ) -> PyResult<Self> {
        let all = PyDict::new(py);
        for (mode, function) in functions {
            let parameters = parameters.clone();
            all.set_item(
                mode,
                Bound::new(py, CFieldOfMode(AtParameters { function, parameters }))?,
            )?;
        }
        Ok(CField { functions: all.unbind() })
    }

    /// As the callback field(mode, x).
    fn __call__(
        &self,
        py: Python<'_>,
        mode: &Bound<'_, PyAny>,
        state: Vec<f64>,
    ) -> PyResult<Vec<f64>> {
        let mut rates = vec![0.0; state.len()];
        self.write(py, mode, &state, &mut rates)?;
        Ok(rates)
    }
}

impl CField {
    /// The rates in a mode, without a call of Python; that of the time is 1.
    ///
    /// # Errors
    /// KeyError for a mode without a function.
    pub(super) fn write(
        &self,
        py: Python<'_>,
        mode: &Bound<'_, PyAny>,
        state: &[f64],
        rates: &mut [f64],
    ) -> PyResult<()> {
        let own = self.functions.bind(py).as_any().get_item(mode)?.cast_into::<CFieldOfMode>()?;
        if let Some((of_time, others)) = rates.split_last_mut() {
            own.get().0.write(state, others);
            *of_time = 1.0;
        }
        Ok(())
    }
}

/// The value of a guard by a function of C.
#[pyclass(frozen, module = "nonsmooth._native")]
pub(crate) struct CGuard(AtParameters);

#[pymethods]
impl CGuard {
    #[new]
    fn new(function: Py<CFunction>, parameters: Vec<f64>) -> Self {
        CGuard(AtParameters { function, parameters })
    }

    /// As the callback value(x).
    fn __call__(&self, state: Vec<f64>) -> f64 {
        self.value(&state)
    }
}

impl CGuard {
    /// The value, without a call of Python.
    pub(super) fn value(&self, state: &[f64]) -> f64 {
        let mut found = [f64::NAN];
        self.0.write(state, &mut found);
        found[0]
    }
}
