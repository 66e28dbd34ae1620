//! Errors of the libraries as Python's exceptions.

use hybrid_system::Error as HybridError;
use pyo3::exceptions::{PyRuntimeError, PyStopIteration};
use pyo3::{PyErr, Python, import_exception};

// The classes are those of the package in Python: an exception of Rust has one base only.
import_exception!(nonsmooth.errors, InputError);
import_exception!(nonsmooth.errors, ComputationError);
import_exception!(nonsmooth.errors, UndecidedError);
import_exception!(nonsmooth.errors, TracingError);

/// The reason of an integration that has taken all its steps.
const NO_STEPS: &str = "no steps are left";

/// What a user may do then.
const STIFF: &str = "a million steps are the most of an arc: end the run before, or take a method for stiff systems, such as Radau or BDF of SciPy's \
                     solve_ivp";

/// The exception of an error of a hybrid system: UndecidedError where rounding hides what happens, ComputationError where a
/// computation cannot go on, InputError for wrong input.
pub(crate) fn of_hybrid(error: &HybridError) -> PyErr {
    of_hybrid_with(error, error.to_string())
}

/// The same with another text.
pub(crate) fn of_hybrid_with(error: &HybridError, text: String) -> PyErr {
    match error {
        HybridError::Integration { reason: NO_STEPS, .. } => {
            ComputationError::new_err(format!("{text}; {STIFF}"))
        }
        HybridError::Grazing { .. }
        | HybridError::UndecidedStart { .. }
        | HybridError::UndecidedSign { .. } => UndecidedError::new_err(text),
        HybridError::StateNotFinite { .. }
        | HybridError::FieldNotFinite { .. }
        | HybridError::NotFinite { .. }
        | HybridError::Integration { .. }
        | HybridError::Root { .. }
        | HybridError::TimelessChain { .. }
        | HybridError::SlidingNotUnique { .. }
        | HybridError::Formula(equations::Error::NoValue { .. }) => ComputationError::new_err(text),
        HybridError::Formula(equations::Error::Kink { .. }) => TracingError::new_err(text),
        _ => InputError::new_err(text),
    }
}

/// An InputError with the message of a library's error, which has the numbers in it.
pub(crate) fn value_error(error: impl std::fmt::Display) -> PyErr {
    InputError::new_err(error.to_string())
}

/// As [`value_error`], for an error of the map: an undecided hop is an [`UndecidedError`].
pub(crate) fn map_error(error: passive_hopper::Error) -> PyErr {
    use passive_hopper::Error::{SuddenLiftOffBudget, Undecided};
    match error {
        Undecided { .. } | SuddenLiftOffBudget { .. } => UndecidedError::new_err(error.to_string()),
        other => value_error(other),
    }
}

/// The exception of a result that a function of the user should not have returned: it names the function.
pub(crate) fn of_result(py: Python<'_>, what: &str, error: PyErr) -> PyErr {
    let text = format!("{what} returned something wrong: {}", error.value(py));
    let own = PyErr::from_type(error.get_type(py), text);
    own.set_cause(py, Some(error));
    own
}

/// The exception of a function of the user. StopIteration would end a loop over the results as if they were
/// complete: it becomes a RuntimeError with it as its cause, as in a generator (PEP 479).
pub(crate) fn of_callback(py: Python<'_>, what: &str, error: PyErr) -> PyErr {
    if !error.is_instance_of::<PyStopIteration>(py) {
        return error;
    }
    let own = PyRuntimeError::new_err(format!("{what} raised StopIteration"));
    own.set_cause(py, Some(error));
    own
}
