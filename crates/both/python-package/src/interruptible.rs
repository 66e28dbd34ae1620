//! Long computations that Ctrl-C ends soon, and during which other Python threads run.

use crate::errors::of_callback;
use crate::generation::generation;
use crate::workers;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between two looks for Ctrl-C, and between two reports of progress. More looks would cost more than they
/// give; fewer would let a person wait.
const LOOK: Duration = Duration::from_millis(25);

/// The number of hops between two looks for Ctrl-C.
///
/// A hop takes from 9 ns to some milliseconds, by the arithmetic that decides it, and neighbours take about the
/// same: a piece is made longer if the one before was short, and shorter if it took long.
pub(crate) struct Pace {
    hops: usize,
    begun: Option<Instant>,
}

impl Pace {
    /// Hops of the first piece: 40 ms, if each takes the 160 µs of a hop at α = 10¹².
    const FIRST: usize = 1 << 8;
    /// Hops of the longest piece: a tenth of a millisecond, by the kernel.
    pub(crate) const LONGEST: usize = 1 << 13;
    /// A piece that takes less is followed by a longer one.
    const SHORT: Duration = Duration::from_millis(1);
    /// A piece that takes more is followed by a shorter one.
    const LONG: Duration = Duration::from_millis(10);

    pub(crate) fn new() -> Self {
        Pace { hops: Pace::FIRST, begun: None }
    }

    /// Looks for Ctrl-C, and gives the number of hops of the next piece.
    pub(crate) fn next(&mut self, py: Python<'_>) -> PyResult<usize> {
        py.check_signals()?;
        let now = Instant::now();
        match self.begun.map(|begun| now - begun) {
            Some(taken) if taken < Pace::SHORT => self.hops = (2 * self.hops).min(Pace::LONGEST),
            Some(taken) if taken > Pace::LONG => self.hops = (self.hops / 8).max(1),
            _ => {}
        }
        self.begun = Some(now);
        Ok(self.hops)
    }
}

/// The function of (done, all) that an argument `progress` of a user asks for.
pub(crate) fn progress_function<'py>(
    py: Python<'py>,
    progress: Option<Bound<'py, PyAny>>,
) -> PyResult<Option<Bound<'py, PyAny>>> {
    let Some(progress) = progress else { return Ok(None) };
    let own = py.import("nonsmooth._progress")?.call_method1("function_of", (progress,))?;
    Ok((!own.is_none()).then_some(own))
}

/// Work on so many threads; on all of them, unless the caller asks for a number.
///
/// # Errors
/// That of the system if the threads cannot be had.
pub(crate) fn with_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, rayon::ThreadPoolBuildError> {
    match threads {
        None => Ok(work()),
        Some(threads) => {
            Ok(ThreadPoolBuilder::new().num_threads(threads.max(1)).build()?.install(work))
        }
    }
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

/// The threads of a forked process, with its generation. It is locked only by a thread that is attached to the
/// interpreter, and so never while another one forks.
static POOL: Mutex<Option<(u64, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads of a forked process; `None` in a process that was not forked, which has rayon's own.
fn pool_of_child(_: Python<'_>) -> PyResult<Option<Arc<ThreadPool>>> {
    let generation = generation();
    if generation == 0 {
        return Ok(None);
    }
    let mut pool = POOL.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((own, pool)) = pool.as_ref()
        && *own == generation
    {
        return Ok(Some(Arc::clone(pool)));
    }
    let new = ThreadPoolBuilder::new().build();
    let new = Arc::new(new.map_err(|error| PyRuntimeError::new_err(error.to_string()))?);
    // Threads of the parent's pool never end: dropping it would wait for them.
    std::mem::forget(pool.replace((generation, Arc::clone(&new))));
    Ok(Some(new))
}

/// The result of `work`, which runs in another thread. `report` gets the number of finished parts whenever it
/// has grown.
///
/// After Ctrl-C or an error of `report` this function returns at once. The thread ends as soon as it looks at the
/// [`Watch`], and a computation that never looks ends in the background.
pub(crate) fn in_background<T: Send + 'static, E: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(&Watch) -> Result<T, E> + Send + 'static,
    error: impl Fn(E) -> PyErr,
    mut report: impl FnMut(usize) -> PyResult<()>,
) -> PyResult<T> {
    let watch = Arc::new(Watch::default());
    let (sender, mut receiver) = channel();
    let own = Arc::clone(&watch);
    let pool = pool_of_child(py)?;
    let run = move || {
        let found = match pool {
            Some(pool) => pool.install(|| work(&own)),
            None => work(&own),
        };
        // The receiver is gone if the result is no longer wanted.
        drop(sender.send(found));
    };
    let worker = workers::given(py, Box::new(run))?;
    let mut told = 0;
    let mut look = || {
        py.check_signals()?;
        let done = watch.done.load(Ordering::Relaxed);
        if done > told {
            told = done;
            report(done).map_err(|error| of_callback(py, "progress", error))?;
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
            Ok(found) => {
                workers::keep(py, worker);
                return found.map_err(error);
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(PyRuntimeError::new_err("the computation ended without a result"));
            }
        }
    }
}
