//! Threads for computations in the background. A new one takes as long as a run of some events: those that have finished are kept.

use crate::generation::generation;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::mpsc::{Sender, channel};
use std::sync::{Mutex, PoisonError};

/// What a thread does.
type Job = Box<dyn FnOnce() + Send>;

/// A thread that waits for jobs. It ends when this is dropped, after the job that it has.
pub(crate) struct Worker(Sender<Job>);

/// Threads that wait: more than a program has threads of Python at a time would only take memory.
const MOST: usize = 16;

/// The threads that wait, with the generation of their process: a child of fork has none of them. It is locked only by a thread that is
/// attached to the interpreter, and so never while another one forks.
static WAITING: Mutex<(u64, Vec<Worker>)> = Mutex::new((0, Vec::new()));

/// A thread that has this job.
///
/// # Errors
/// RuntimeError if the system gives no thread.
pub(crate) fn given(_: Python<'_>, job: Job) -> PyResult<Worker> {
    let waiting = {
        let mut all = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
        if all.0 != generation() {
            // Those of the parent are no threads here.
            std::mem::forget(std::mem::replace(&mut *all, (generation(), Vec::new())));
        }
        all.1.pop()
    };
    let worker = match waiting {
        Some(worker) => worker,
        None => {
            let (sender, receiver) = channel::<Job>();
            let run = move || receiver.into_iter().for_each(|job| job());
            let thread = std::thread::Builder::new().spawn(run);
            thread.map_err(|error| {
                PyRuntimeError::new_err(format!("no thread can be had: {error}"))
            })?;
            Worker(sender)
        }
    };
    let text = "a thread of a computation has ended";
    worker.0.send(job).map_err(|_| PyRuntimeError::new_err(text))?;
    Ok(worker)
}

/// Keeps a thread whose job has ended.
pub(crate) fn keep(_: Python<'_>, worker: Worker) {
    let mut all = WAITING.lock().unwrap_or_else(PoisonError::into_inner);
    if all.0 == generation() && all.1.len() < MOST {
        all.1.push(worker);
    }
}
