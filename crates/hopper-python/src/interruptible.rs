//! Long computations that Ctrl-C ends soon, and during which other Python threads run.

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// Time between two looks for Ctrl-C, and between two reports of progress. More looks would cost more than they give; fewer would
/// let a person wait.
const LOOK: Duration = Duration::from_millis(25);

/// Calls `piece` for 0, 1, … below `count`, without the interpreter's lock. Each piece takes some milliseconds.
pub(crate) fn pieces<E: Send>(
    py: Python<'_>,
    count: usize,
    mut piece: impl FnMut(usize) -> Result<(), E> + Send,
    error: impl Fn(E) -> PyErr,
) -> PyResult<()> {
    for k in 0..count {
        py.check_signals()?;
        py.detach(|| piece(k)).map_err(&error)?;
    }
    py.check_signals()
}

/// The function of (done, all) that an argument `progress` of a user asks for.
pub(crate) fn progress_function<'py>(
    py: Python<'py>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(progress) = progress else { return Ok(None) };
    let own = py.import("passive_hopper._progress")?.call_method1("function_of", (progress,))?;
    Ok((!own.is_none()).then_some(own))
}

/// What a computation in the background and its caller tell each other.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    stopped: AtomicBool,
    done: AtomicUsize,
}

impl Watch {
    /// Whether the result is no longer wanted.
    pub(crate) fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    /// Counts finished parts.
    pub(crate) fn finished(&self, parts: usize) {
        self.done.fetch_add(parts, Ordering::Relaxed);
    }
}

/// The result of `work`, which runs in a thread of its own. `report` gets the number of finished parts whenever it has grown.
///
/// After Ctrl-C or an error of `report` this function returns at once. The thread ends as soon as it looks at the [`Watch`], and
/// a computation that never looks ends in the background.
pub(crate) fn in_background<T: Send + 'static, E: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Watch) -> Result<T, E> + Send + 'static,
    error: impl Fn(E) -> PyErr,
    mut report: impl FnMut(usize) -> PyResult<()>,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    let (sender, mut receiver) = channel();
    let own = Arc::clone(&watch);
    // The receiver is gone if the result is no longer wanted.
    std::thread::spawn(move || drop(sender.send(work(&own))));
    let mut told = 0;
    let mut look = || {
        py.check_signals()?;
        let done = watch.done.load(Ordering::Relaxed);
        if done > told {
            told = done;
            report(done)?;
        }
        Ok(())
    };
    loop {
        // A receiver can be moved to another thread, and not be shared with it.
        let found;
        (receiver, found) = py.detach(move || {
            let found = receiver.recv_timeout(LOOK);
            (receiver, found)
        });
        let looked: PyResult<()> = look();
        if let Err(error) = looked {
            watch.stopped.store(true, Ordering::Relaxed);
            return Err(error);
        }
        match found {
            Ok(found) => return found.map_err(error),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the computation ended without a result"));
            }
        }
    }
}
