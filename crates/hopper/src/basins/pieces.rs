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

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;

    /// A run that was interrupted leaves its finished pieces, and the next run computes the others only.
    #[test]
    fn an_interrupted_run_goes_on() {
        let path = std::env::temp_dir().join(format!("hopper_kept_{}", std::process::id()));
        let folder = Folder::open(&path).unwrap();
        let lock = Lock::take(folder.path(), "kept").unwrap();
        let whole = |at: usize| vec![at as u8; at];
        let breaks = |at: usize| match at {
            5 => Err(Error::CheckFailed("broken off".into())),
            _ => Ok(whole(at)),
        };
        let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let name = ("pieces", "a picture");
        assert!(threads.install(|| pieces(&folder, &lock, name, 8, breaks)).is_err());
        let kept = Pieces::open(&path.join("pieces"), "a picture").unwrap();
        let finished: Vec<usize> = (0..8).filter(|&at| kept.read(at).unwrap().is_some()).collect();
        assert!(finished.starts_with(&[0, 1, 2, 3, 4]), "{finished:?}");
        let computed = Mutex::new(Vec::new());
        let again = pieces(&folder, &lock, name, 8, |at| {
            computed.lock().unwrap().push(at);
            Ok(whole(at))
        });
        let (kept, all) = again.unwrap();
        assert_eq!(all, (0..8).map(whole).collect::<Vec<_>>());
        assert_eq!(computed.into_inner().unwrap().len(), 8 - finished.len());
        // Another picture in the same folder is an error that names the folder.
        let other = pieces(&folder, &lock, ("pieces", "another picture"), 8, |at| Ok(whole(at)));
        assert!(other.unwrap_err().to_string().contains("pieces"));
        kept.remove(8).unwrap();
        std::fs::remove_dir_all(&path).unwrap();
    }
}
