//! Results and what is given without functions go through pickle and copy, and are compared. What holds a function
//! of the user refuses, and names the function.

use pyo3::PyClass;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::PyTuple;

/// A class whose attributes are all that it has.
pub(crate) trait Plain: PyClass + Into<PyClassInitializer<Self>> {
    /// Their names.
    const ATTRIBUTES: &'static [&'static str];

    /// The object with these attributes.
    fn restored(values: &Bound<'_, PyTuple>) -> PyResult<Self>;
}

/// [`Plain`] for a class with these fields, which are its attributes.
macro_rules! plain {
    ($class:ident { $($field:ident),* }) => {
        impl $crate::pickling::Plain for $class {
            const ATTRIBUTES: &'static [&'static str] = &[$(stringify!($field)),*];

            fn restored(values: &pyo3::Bound<'_, pyo3::types::PyTuple>) -> pyo3::PyResult<Self> {
                use pyo3::types::PyAnyMethods;
                let ($($field,)*) = values.extract()?;
                Ok($class { $($field),* })
            }
        }
    };
}
pub(crate) use plain;

/// What pickle and copy make an object of: a function and its arguments.
pub(crate) type Reduced<'py> = (Bound<'py, PyAny>, Bound<'py, PyTuple>);

fn attributes<'py, T: Plain>(object: &Bound<'py, T>) -> PyResult<Vec<Bound<'py, PyAny>>> {
    T::ATTRIBUTES.iter().map(|name| object.as_any().getattr(*name)).collect()
}

/// The call that makes an object of `kind` again.
pub(crate) fn restoring<'py>(
    py: Python<'py>,
    kind: &str,
    values: Bound<'py, PyTuple>,
) -> PyResult<Reduced<'py>> {
    let restore = py.import("nonsmooth._native")?.getattr("_restored")?;
    Ok((restore, (kind, values).into_pyobject(py)?))
}

/// A plain object for pickle and copy.
pub(crate) fn reduced<'py, T: Plain>(object: &Bound<'py, T>) -> PyResult<Reduced<'py>> {
    let py = object.py();
    let kind = object.as_any().get_type().name()?.to_string();
    restoring(py, &kind, PyTuple::new(py, attributes(object)?)?)
}

/// Whether two plain objects have the same attributes. Arrays are the same if all their numbers are.
pub(crate) fn equal<T: Plain>(object: &Bound<'_, T>, other: &Bound<'_, PyAny>) -> PyResult<bool> {
    let Ok(other) = other.cast::<T>() else { return Ok(false) };
    let same_arrays = object.py().import("numpy")?.getattr("array_equal")?;
    for (own, other) in attributes(object)?.into_iter().zip(attributes(other)?) {
        let is_array = own.hasattr("dtype")? && other.hasattr("dtype")?;
        let same =
            if is_array { same_arrays.call1((own, other))?.extract()? } else { own.eq(other)? };
        if !same {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The error of an object that holds functions of the user: pickle could not tell where they come from.
pub(crate) fn refused(py: Python<'_>, what: &str, held: &[(String, &Py<PyAny>)]) -> PyErr {
    let shown = |(name, function): &(String, &Py<PyAny>)| {
        let function =
            function.bind(py).repr().map_or_else(|_| "?".into(), |text| text.to_string());
        format!("{name}={function}")
    };
    let functions: Vec<String> = held.iter().map(shown).collect();
    PyTypeError::new_err(format!(
        "cannot pickle {what}: it holds {}; pickle what it is made of, and make it again where it is needed",
        functions.join(", ")
    ))
}
