//! The progress of a computation that takes a while, as the program `hopper` shows that of its jobs.

use resumable_job::{Pace, Place};
use std::io::{IsTerminal, Stderr};
use std::sync::Mutex;
use std::time::Instant;

/// Shows how far computations are, on standard error: a line that changes on a terminal, elsewhere a line every 30
/// seconds.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Progress;

/// The progress of one computation, for all its threads.
#[derive(Debug)]
pub(crate) struct Bar {
    began: Instant,
    line: Mutex<resumable_job::Progress<Stderr>>,
}

impl Progress {
    /// The progress of `length` steps, such as claims.
    pub(crate) fn bar(&self, name: &'static str, length: u64) -> Bar {
        let total = usize::try_from(length).unwrap_or(usize::MAX);
        let pace = Pace { unit: name, total, found: 0, each: None };
        let stream = std::io::stderr();
        let place = Place::new(false, stream.is_terminal());
        let line = Mutex::new(resumable_job::Progress::new(pace, place, stream));
        Bar { began: Instant::now(), line }
    }
}

impl Bar {
    /// Tells that `position` of the steps are done.
    pub(crate) fn set(&self, position: u64) {
        // Another thread is telling a number that is as good.
        if let Ok(mut progress) = self.line.try_lock() {
            let done = usize::try_from(position).unwrap_or(usize::MAX);
            progress.tell(done, self.began.elapsed());
        }
    }
    /// Removes the line from the terminal.
    pub(crate) fn finish(&self) {
        if let Ok(mut progress) = self.line.lock() {
            progress.clear();
        }
    }
}
