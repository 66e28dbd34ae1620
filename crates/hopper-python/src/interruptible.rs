//! Long computations in pieces: Ctrl-C ends them between two pieces, and other Python threads run during each.

use pyo3::prelude::*;

/// Calls `piece` for 0, 1, … below `count`, without the interpreter's lock, and `report` with the number of finished pieces.
pub(crate) fn pieces<E: Send>(
    py: Python<'_>,
    count: usize,
    mut piece: impl FnMut(usize) -> Result<(), E> + Send,
    error: impl Fn(E) -> PyErr,
    mut report: impl FnMut(usize) -> PyResult<()>,
) -> PyResult<()> {
    for k in 0..count {
        py.check_signals()?;
        py.detach(|| piece(k)).map_err(&error)?;
        report(k + 1)?;
    }
    py.check_signals()
}
