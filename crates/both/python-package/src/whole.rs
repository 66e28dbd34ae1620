//! Whole numbers of a user, and the memory that they ask for.

use crate::errors::value_error;
use pyo3::exceptions::{PyMemoryError, PyOverflowError};
use pyo3::prelude::*;

/// An int, or what Python takes for one, as a number of Rust without a sign: the `from_py_with` of every count and
/// index.
///
/// # Errors
/// TypeError for what is no int. ValueError with the number beyond the range of `T`; pyo3 alone has an
/// OverflowError without it.
pub(crate) fn whole<T: TryFrom<u64>>(object: &Bound<'_, PyAny>) -> PyResult<T> {
    let beyond = || {
        let largest = u64::MAX >> (64 - 8 * size_of::<T>());
        value_error(format!("a whole number from 0 to {largest} is needed, not {object}"))
    };
    match object.extract::<u64>() {
        Ok(number) => T::try_from(number).map_err(|_| beyond()),
        Err(error) if error.is_instance_of::<PyOverflowError>(object.py()) => Err(beyond()),
        Err(error) => Err(error),
    }
}

/// A number of threads, at least one; `None` for all.
///
/// # Errors
/// As [`whole`], and ValueError for none.
pub(crate) fn threads_of(object: &Bound<'_, PyAny>) -> PyResult<Option<usize>> {
    if object.is_none() {
        return Ok(None);
    }
    match whole(object)? {
        0 => Err(value_error("threads= is a number from 1 on, not 0")),
        threads => Ok(Some(threads)),
    }
}

/// Two whole numbers: a tuple, a list or an array.
///
/// # Errors
/// As [`whole`], and ValueError for another count than two.
pub(crate) fn two_whole(object: &Bound<'_, PyAny>) -> PyResult<[usize; 2]> {
    let [first, second]: [Bound<'_, PyAny>; 2] = object.extract()?;
    Ok([whole(&first)?, whole(&second)?])
}

/// Whether there is memory for `count` results of about `bytes` bytes each. Without this question a count that is
/// too large ends the process.
///
/// # Errors
/// MemoryError with the size, as NumPy has it.
pub(crate) fn room_for(count: usize, bytes: usize) -> PyResult<()> {
    let room = Vec::<u8>::new().try_reserve_exact(count.saturating_mul(bytes));
    room.map_err(|_| no_room(count, bytes))
}

/// The exception where there is no memory for results.
pub(crate) fn no_room(count: usize, bytes: usize) -> PyErr {
    let all = count as f64 * bytes as f64 / 1e9;
    PyMemoryError::new_err(format!(
        "{count} results need {all:.3} GB of memory, which cannot be had"
    ))
}
