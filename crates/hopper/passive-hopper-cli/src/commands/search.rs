//! Work that may take minutes, and keeps nothing on disk: with its progress shown, and ended at once by a signal.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::options::form::OutputOptions;
use crate::streams::Streams;
use resumable_job::{Pace, Place, Progress};
use std::io::IsTerminal;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::{Duration, Instant};

/// Time between two looks for signals.
const LOOK: Duration = Duration::from_millis(100);

/// Runs `work`, and shows meanwhile on standard error for how long it has.
///
/// The work has a thread of its own. After a signal it is left alone: it has no files, and ends with the program.
///
/// # Errors
/// [`Error::Ended`] after a signal; the error of `work`.
pub(crate) fn run<T: Send + 'static>(
    options: &OutputOptions,
    streams: &mut Streams<'_>,
    work: impl FnOnce() -> Result<T, Error> + Send + 'static,
) -> Result<T, Error> {
    run_counted(options, streams, ("searches", 1), |_| work())
}

/// The same for work that has `total` pieces, which messages call `unit`. It counts the finished ones.
///
/// # Errors
/// As [`run`].
pub(crate) fn run_counted<T: Send + 'static>(
    options: &OutputOptions,
    streams: &mut Streams<'_>,
    (unit, total): (&'static str, usize),
    work: impl FnOnce(&AtomicUsize) -> Result<T, Error> + Send + 'static,
) -> Result<T, Error> {
    let interrupt = Interrupt::watch()?;
    let place = Place::new(options.is_quiet(), std::io::stderr().is_terminal());
    let pace = Pace { unit, total, found: 0, each: None };
    let counted = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&counted);
    let mut progress = Progress::new(pace, place, &mut *streams.messages);
    let began = Instant::now();
    // The sender is dropped when the work ends, also by a panic.
    let (working, ended) = channel::<()>();
    let worker = std::thread::spawn(move || {
        let found = work(&count);
        drop(working);
        found
    });
    while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(LOOK) {
        if let Some(status) = interrupt.status() {
            progress.clear();
            return Err(Error::Ended { status });
        }
        progress.tell(counted.load(Ordering::Relaxed), began.elapsed());
    }
    progress.clear();
    worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
