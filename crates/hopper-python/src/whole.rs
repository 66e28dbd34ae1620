//! Whole numbers of a user.

use crate::errors::value_error;
use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;

/// An int, or what Python takes for one, as a number of Rust without a sign: the `from_py_with` of every count and index.
///
/// # Errors
/// TypeError for what is no int. ValueError with the number beyond the range of `T`; pyo3 alone has an OverflowError without it.
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

/// Two whole numbers: a tuple, a list or an array.
///
/// # Errors
/// As [`whole`], and ValueError for another count than two.
pub(crate) fn two_whole(object: &Bound<'_, PyAny>) -> PyResult<[usize; 2]> {
    let [first, second]: [Bound<'_, PyAny>; 2] = object.extract()?;
    Ok([whole(&first)?, whole(&second)?])
}
