//! A lock on a folder for one job, or for one part of a job.
//!
//! ```text
//!   whole job, assembly     JOB.lock, one holder
//!   part K of N             JOB.lock together with other parts, and JOB.part-K-of-N.lock, one holder
//! ```

use crate::error::Error;
use crate::locked_file::{Holders, LockedFile, SECOND_TRY_AFTER, Trial, holder_of};
use crate::part::Part;
use std::path::Path;

/// Trials of [`Lock::wait`], each after [`SECOND_TRY_AFTER`]: about ten seconds. The waiting processes write one short
/// file each. A longer wait would only delay the message about a process that was stopped.
const PATIENCE: usize = 500;

/// The right of one process to write one job in a folder, or one part of a job, until it is dropped.
#[derive(Debug)]
pub struct Lock {
    /// Dropped first: another process that finds the part free also finds the job free or held in parts.
    part: Option<LockedFile>,
    whole: LockedFile,
}

impl Lock {
    /// Takes the lock on a job in a folder that exists, for this process alone. Different jobs of one folder are
    /// independent.
    ///
    /// `job` is a file name without its extension: the lock file is `folder/job.lock`. It holds the number of
    /// the process, for the message of others, and is removed with the lock.
    ///
    /// # Errors
    /// [`Error::AtWork`] if another process holds the lock or the lock of a part, [`Error::NoLocks`] if the file system
    /// has no locks, [`Error::LockFile`] if the name of the lock file belongs to a folder, a link or a device, and
    /// [`Error::File`] if the lock file cannot be opened or written.
    pub fn take(folder: &Path, job: &str) -> Result<Self, Error> {
        match LockedFile::take(folder, job, Holders::One)? {
            Trial::Locked(whole) => Ok(Lock { part: None, whole }),
            Trial::Held(holder) => {
                let part = part_at_work(folder, job);
                let (holder, name) = match part {
                    Some((name, holder)) => (Some(holder), name),
                    None => (holder, job.to_owned()),
                };
                Err(Error::AtWork { folder: folder.into(), part: name, holder })
            }
        }
    }

    /// Takes the lock on one part of a job. Other parts can be held at the same time, and the whole job cannot.
    ///
    /// # Errors
    /// As [`Lock::take`]; [`Error::AtWork`] if another process holds this part or the whole job.
    pub fn take_part(folder: &Path, job: &str, part: Part) -> Result<Self, Error> {
        let at_work = |part: String, holder| Error::AtWork { folder: folder.into(), part, holder };
        let whole = match LockedFile::take(folder, job, Holders::Many)? {
            Trial::Locked(whole) => whole,
            Trial::Held(holder) => return Err(at_work(job.to_owned(), holder)),
        };
        let name = format!("{job}.{}", part.name());
        match LockedFile::take(folder, &name, Holders::One)? {
            Trial::Locked(own) => Ok(Lock { part: Some(own), whole }),
            Trial::Held(holder) => Err(at_work(name, holder)),
        }
    }

    /// As [`Lock::take`], but waits some seconds for other processes, for a step that takes milliseconds.
    pub(crate) fn wait(folder: &Path, job: &str) -> Result<Self, Error> {
        for _ in 1..PATIENCE {
            match Lock::take(folder, job) {
                Err(Error::AtWork { .. }) => std::thread::sleep(SECOND_TRY_AFTER),
                other => return other,
            }
        }
        Lock::take(folder, job)
    }

    /// Makes sure that the lock still protects the folder.
    ///
    /// Others can remove the lock file, or the whole folder, and the next process then locks a new file. To be
    /// called before each step that writes into the folder. It shortens the time in which two processes write
    /// there, and cannot prevent it: others can remove the file just after the call.
    ///
    /// # Errors
    /// [`Error::LockLost`] if the name of the lock file is gone or belongs to another file.
    pub fn confirm(&self) -> Result<(), Error> {
        self.whole.confirm()?;
        self.part.as_ref().map_or(Ok(()), LockedFile::confirm)
    }
}

/// A part of the job that a process is at work on, and this process.
fn part_at_work(folder: &Path, job: &str) -> Option<(String, u32)> {
    let start = format!("{job}.part-");
    std::fs::read_dir(folder).into_iter().flatten().flatten().find_map(|entry| {
        let name = entry.file_name().into_string().ok()?;
        let name = name.strip_suffix(".lock").filter(|name| name.starts_with(&start))?;
        Some((name.to_owned(), holder_of(&entry.path())?))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::File;
    use std::path::PathBuf;
    use std::sync::atomic::{AtomicUsize, Ordering};

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("resumable_lock_{name}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn a_second_lock_is_an_error_that_names_folder_and_process() {
        let folder = folder("second");
        let first = Lock::take(&folder, "job").unwrap();
        let error = Lock::take(&folder, "job").unwrap_err();
        let text = error.to_string();
        assert!(matches!(error, Error::AtWork { holder: Some(_), .. }), "{error:?}");
        assert!(text.contains(&folder.display().to_string()), "{text}");
        assert!(text.contains(&format!("process {}", std::process::id())), "{text}");
        drop(first);
        drop(Lock::take(&folder, "job").unwrap());
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn parts_are_held_side_by_side_and_the_whole_alone() {
        let folder = folder("parts");
        let part = |k| Lock::take_part(&folder, "job", Part::new(k, 2).unwrap());
        let at_work = |lock: Result<Lock, Error>, name: &str| {
            let text = lock.unwrap_err().to_string();
            assert!(text.contains(&format!("process {} ", std::process::id())), "{text}");
            assert!(text.contains(&format!("'{name}")), "{text}");
        };
        let (first, second) = (part(1).unwrap(), part(2).unwrap());
        at_work(part(1), "job.part-1-of-2");
        // A refused process leaves the lock of the others.
        first.confirm().unwrap();
        at_work(Lock::take(&folder, "job"), "job.part-");
        drop(first);
        second.confirm().unwrap();
        at_work(Lock::take(&folder, "job"), "job.part-2-of-2");
        drop(second);
        let whole = Lock::take(&folder, "job").unwrap();
        at_work(part(1), "job");
        drop(whole);
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    /// Parts come and go all the time; no thread holds a part while another one holds the whole.
    #[test]
    fn parts_and_the_whole_are_never_held_at_once() {
        let folder = folder("whole");
        let (whole, parts) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let (mut both, mut most) = (0, 0);
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..6)
                .map(|thread| {
                    let (folder, whole, parts) = (&folder, &whole, &parts);
                    scope.spawn(move || {
                        let (mut both, mut most) = (0, 0);
                        for _ in 0..50 {
                            if thread == 0 {
                                let Ok(lock) = Lock::take(folder, "job") else { continue };
                                whole.fetch_add(1, Ordering::SeqCst);
                                both += parts.load(Ordering::SeqCst);
                                std::thread::yield_now();
                                whole.fetch_sub(1, Ordering::SeqCst);
                                drop(lock);
                            } else {
                                let part = Part::new(thread, 5).unwrap();
                                let Ok(lock) = Lock::take_part(folder, "job", part) else {
                                    continue;
                                };
                                most = most.max(1 + parts.fetch_add(1, Ordering::SeqCst));
                                both += whole.load(Ordering::SeqCst);
                                std::thread::sleep(std::time::Duration::from_millis(1));
                                lock.confirm().unwrap();
                                parts.fetch_sub(1, Ordering::SeqCst);
                                drop(lock);
                            }
                        }
                        (both, most)
                    })
                })
                .collect();
            for thread in threads {
                let (own_both, own_most) = thread.join().unwrap();
                (both, most) = (both + own_both, most.max(own_most));
            }
        });
        assert_eq!(both, 0);
        assert!(most > 1, "no two parts were held at once");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_lock_file_without_a_process_locks_nothing() {
        let folder = folder("left");
        for contents in
            ["", "4194304\n", "no number\n", "a longer text than any number of a process"]
        {
            std::fs::write(folder.join("job.lock"), contents).unwrap();
            let lock = Lock::take(&folder, "job").unwrap();
            let text = std::fs::read_to_string(folder.join("job.lock")).unwrap();
            assert_eq!(text, format!("{}\n", std::process::id()));
            drop(lock);
            assert!(!folder.join("job.lock").exists());
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_holder_without_a_number_is_another_process() {
        let folder = folder("no_number");
        let path = folder.join("job.lock");
        let file = File::create(&path).unwrap();
        file.lock().unwrap();
        let error = Lock::take(&folder, "job").unwrap_err();
        assert!(matches!(error, Error::AtWork { holder: None, .. }), "{error:?}");
        assert!(error.to_string().contains("another process"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    /// The lock file appears and disappears all the time; two threads never hold the lock at once.
    #[test]
    fn two_threads_never_hold_a_lock_at_once() {
        let folder = folder("never");
        let (inside, taken) = (AtomicUsize::new(0), AtomicUsize::new(0));
        std::thread::scope(|scope| {
            for _ in 0..8 {
                scope.spawn(|| {
                    for _ in 0..50 {
                        if let Ok(lock) = Lock::take(&folder, "job") {
                            assert_eq!(inside.fetch_add(1, Ordering::SeqCst), 0);
                            taken.fetch_add(1, Ordering::SeqCst);
                            std::thread::yield_now();
                            inside.fetch_sub(1, Ordering::SeqCst);
                            drop(lock);
                        }
                    }
                });
            }
        });
        assert!(taken.into_inner() > 0);
        assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 0);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_lock_file_that_is_removed_or_replaced_is_noticed() {
        let folder = folder("lost");
        let first = Lock::take(&folder, "job").unwrap();
        first.confirm().unwrap();
        std::fs::remove_file(folder.join("job.lock")).unwrap();
        let error = first.confirm().unwrap_err();
        assert!(matches!(error, Error::LockLost { .. }), "{error}");
        let second = Lock::take(&folder, "job").unwrap();
        second.confirm().unwrap();
        assert!(first.confirm().is_err());
        // The end of the first one leaves the lock of the second one.
        drop(first);
        second.confirm().unwrap();
        drop(second);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_name_of_a_folder_or_a_link_is_no_lock() {
        let folder = folder("no_file");
        let (path, other) = (folder.join("job.lock"), folder.join("other"));
        std::fs::write(&other, b"contents").unwrap();
        std::os::unix::fs::symlink(&other, &path).unwrap();
        let error = Lock::take(&folder, "job").unwrap_err();
        assert!(matches!(error, Error::LockFile { .. }), "{error}");
        assert_eq!(std::fs::read(&other).unwrap(), b"contents");
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
        let error = Lock::take(&folder, "job").unwrap_err().to_string();
        assert!(error.contains("job.lock") && error.contains("remove it"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_folder_without_locks_is_an_error_that_names_it() {
        let source = std::io::Error::from(std::io::ErrorKind::Unsupported);
        let text = Error::NoLocks { folder: "/mnt/x".into(), source }.to_string();
        assert!(text.contains("/mnt/x") && text.contains("another file system"), "{text}");
    }

    #[test]
    fn a_missing_folder_is_an_error_that_names_it() {
        let error = Lock::take(Path::new("/nowhere/at/all"), "job").unwrap_err();
        assert!(error.to_string().contains("/nowhere/at/all"), "{error}");
    }
}
