//! Modes and surfaces by number, with the Python objects that are their names.

use hybrid_system::{FilippovMode, FilippovSurface};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// The number of a mode. Its text is replaced by the name in messages.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Mode(pub(crate) usize);

/// The number of a guard. Its text is replaced by the name in messages.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Surface(pub(crate) usize);

impl fmt::Debug for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "⟨mode {}⟩", self.0)
    }
}

impl fmt::Debug for Surface {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "⟨guard {}⟩", self.0)
    }
}

/// A mode of an execution: one of the model, or a sliding motion.
pub(crate) type ExecutionMode = FilippovMode<Mode, Surface>;

/// A surface of an execution: one of the model, or the end of a sliding motion.
pub(crate) type ExecutionSurface = FilippovSurface<Mode, Surface>;

/// The modes that have been named so far: any hashable Python objects.
#[derive(Debug)]
pub(crate) struct Modes {
    /// From each mode to its number.
    numbers: Py<PyDict>,
    names: Mutex<Vec<Py<PyAny>>>,
}

impl Modes {
    pub(crate) fn new(py: Python<'_>) -> Self {
        Modes { numbers: PyDict::new(py).unbind(), names: Mutex::new(Vec::new()) }
    }

    /// The number of a mode. A new mode gets the next number.
    ///
    /// # Errors
    /// TypeError for an object that has no hash.
    pub(crate) fn number(&self, mode: &Bound<'_, PyAny>) -> PyResult<Mode> {
        let numbers = self.numbers.bind(mode.py());
        if let Some(number) = numbers.get_item(mode)? {
            return Ok(Mode(number.extract()?));
        }
        // The names are not locked while Python runs: a hash may call anything.
        let number = {
            let mut names = self.names.lock().unwrap_or_else(PoisonError::into_inner);
            names.push(mode.clone().unbind());
            names.len() - 1
        };
        numbers.set_item(mode, number)?;
        Ok(Mode(number))
    }

    /// The name of a mode.
    pub(crate) fn name(&self, py: Python<'_>, mode: Mode) -> Py<PyAny> {
        let names = self.names.lock().unwrap_or_else(PoisonError::into_inner);
        names.get(mode.0).map_or_else(|| py.None(), |name| name.clone_ref(py))
    }

    /// The number of modes so far.
    pub(crate) fn count(&self) -> usize {
        self.names.lock().unwrap_or_else(PoisonError::into_inner).len()
    }
}
