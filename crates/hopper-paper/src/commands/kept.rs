//! Pieces of a picture that are computed in parallel and stored on disk until the picture is complete.

use crate::error::Error;
use rayon::prelude::*;
use repository_tools::{Folder, Progress};
use resumable_job::{Lock, Pieces};
use std::sync::atomic::{AtomicU64, Ordering};

/// The pieces 0 … `count` − 1 in order. Those that an earlier run finished in `folder/name` are read; the others are computed.
///
/// `description` has all that the pieces depend on. A run with another description finds foreign pieces, which is an error.
pub(super) fn pieces(
    folder: &Folder,
    lock: &Lock,
    (name, description): (&'static str, &str),
    count: usize,
    piece: impl Fn(usize) -> Result<Vec<u8>, Error> + Sync,
) -> Result<(Pieces, Vec<Vec<u8>>), Error> {
    let kept = Pieces::open(&folder.path().join(name), description)?;
    let bar = Progress.bar(name, count as u64);
    let done = AtomicU64::new(0);
    let all = (0..count).into_par_iter().map(|at| {
        let bytes = match kept.read(at)? {
            Some(bytes) => bytes,
            None => {
                let bytes = piece(at)?;
                // Without its lock this run would write among the pieces of another run.
                lock.confirm()?;
                kept.write(at, &bytes)?;
                bytes
            }
        };
        bar.set(done.fetch_add(1, Ordering::Relaxed) + 1);
        Ok(bytes)
    });
    let all = all.collect::<Result<Vec<_>, Error>>()?;
    bar.finish();
    Ok((kept, all))
}
