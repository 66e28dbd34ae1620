//! Forks: a child has none of the threads of its parent.

use pyo3::prelude::*;
use std::sync::atomic::{AtomicU64, Ordering};

/// How often this process was forked from one that had loaded the package.
static GENERATION: AtomicU64 = AtomicU64::new(0);

/// The generation of this process: 0 unless it was forked.
pub(crate) fn generation() -> u64 {
    GENERATION.load(Ordering::Relaxed)
}

/// To be called in the child after a fork: of the threads of the parent none is there.
#[pyfunction]
pub(crate) fn after_fork() {
    GENERATION.fetch_add(1, Ordering::Relaxed);
}
