//! A search that may take minutes, and keeps nothing on disk: with its time shown, and ended at once by a signal.

use crate::error::Error;
use crate::interrupt::Interrupt;
use crate::options::form::OutputOptions;
use crate::streams::Streams;
use resumable_job::{Pace, Place, Progress};
use std::io::IsTerminal;
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
    let interrupt = Interrupt::watch()?;
    let place = Place::new(options.is_quiet(), std::io::stderr().is_terminal());
    let pace = Pace { unit: "searches", total: 1, found: 0, each: None };
    let mut progress = Progress::new(pace, place, &mut *streams.messages);
    let began = Instant::now();
    // The sender is dropped when the work ends, also by a panic.
    let (working, ended) = channel::<()>();
    let worker = std::thread::spawn(move || {
        let found = work();
        drop(working);
        found
    });
    while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(LOOK) {
        if let Some(status) = interrupt.status() {
            progress.clear();
            return Err(Error::Ended { status });
        }
        progress.tell(0, began.elapsed());
    }
    progress.clear();
    worker.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
}
