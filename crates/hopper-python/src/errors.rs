//! Errors of the libraries as Python's exceptions.

use pyo3::exceptions::{PyArithmeticError, PyValueError};
use pyo3::{PyErr, create_exception};

create_exception!(
    passive_hopper,
    UndecidedError,
    PyArithmeticError,
    "What happens cannot be decided: a hop with 1024 bits (sudden or not, on which branch, or grounded or not), or an event of a \
     hybrid system that rounding hides."
);

/// A ValueError with the message of a library's error, which has the numbers in it.
pub(crate) fn value_error(error: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(error.to_string())
}

/// As [`value_error`], for an error of the map: an undecided hop is an [`UndecidedError`].
pub(crate) fn map_error(error: passive_hopper::Error) -> PyErr {
    use passive_hopper::Error::{SuddenLiftOffBudget, Undecided};
    match error {
        Undecided { .. } | SuddenLiftOffBudget { .. } => UndecidedError::new_err(error.to_string()),
        other => value_error(other),
    }
}
