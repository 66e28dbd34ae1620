//! A lock on a named part of a folder, which ends with its process.
//!
//! The lock belongs to the open file, not to its name: the system removes the lock when the process ends, also if it is
//! killed. A lock file left on disk is therefore harmless, and the next process locks it again. A stopped process keeps
//! its lock.

use crate::error::Error;
use crate::open_file::is_named;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Time before a refused lock is tried once more. Between taking the lock and writing its number, a holder's file has
/// no number or an old one. That takes microseconds. A longer time would delay the refusal without a gain.
const SECOND_TRY_AFTER: Duration = Duration::from_millis(20);

/// Trials to lock a file that its last holder removes meanwhile. Each lost trial needs another process that ended at
/// that instant, so that a few trials suffice. The limit is for file systems on which a name never shows the file that
/// was opened.
const TRIALS: usize = 100;

/// The right of one process to write one part of a folder, until it is dropped.
#[derive(Debug)]
pub struct Lock {
    file: File,
    path: PathBuf,
}

impl Lock {
    /// Takes the lock on `part` of a folder that exists. Different parts of one folder are independent.
    ///
    /// `part` is a file name without its extension: the lock file is `folder/part.lock`. It holds the number of
    /// the process, for the message of others, and is removed with the lock.
    ///
    /// # Errors
    /// [`Error::AtWork`] if another process holds the lock, [`Error::NoLocks`] if the file system has no locks,
    /// [`Error::LockFile`] if the name of the lock file belongs to a folder, a link or a device, and [`Error::File`]
    /// if the lock file cannot be opened or written.
    pub fn take(folder: &Path, part: &str) -> Result<Self, Error> {
        let path = folder.join(format!("{part}.lock"));
        let mut refused = false;
        for _ in 0..TRIALS {
            // A link would lead to another file, and the process number would replace its bytes.
            if std::fs::symlink_metadata(&path).is_ok_and(|data| !data.is_file()) {
                return Err(Error::LockFile { path });
            }
            // The file is not truncated: the number in it may be the number of the holder.
            let mut options = OpenOptions::new();
            options.read(true).write(true).create(true).truncate(false);
            let file = options.open(&path).map_err(Error::at(&path))?;
            match file.try_lock() {
                // The last holder removed the file after this process opened it: the lock protects nothing.
                Ok(()) if !is_named(&file, &path).map_err(Error::at(&path))? => continue,
                Ok(()) => {
                    let lock = Lock { file, path };
                    lock.tell_process().map_err(Error::at(&lock.path))?;
                    return Ok(lock);
                }
                Err(TryLockError::WouldBlock) if !refused => {
                    refused = true;
                    std::thread::sleep(SECOND_TRY_AFTER);
                }
                Err(TryLockError::WouldBlock) => {
                    let holder = holder(&file);
                    return Err(Error::AtWork { folder: folder.into(), part: part.into(), holder });
                }
                Err(TryLockError::Error(source)) => {
                    return Err(Error::NoLocks { folder: folder.into(), source });
                }
            }
        }
        let source = std::io::Error::other("the lock file never is the file that was opened");
        Err(Error::NoLocks { folder: folder.into(), source })
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
        if is_named(&self.file, &self.path).map_err(Error::at(&self.path))? {
            Ok(())
        } else {
            Err(Error::LockLost { path: self.path.clone() })
        }
    }

    fn tell_process(&self) -> std::io::Result<()> {
        self.file.set_len(0)?; // the number of a killed holder
        (&self.file).write_all(format!("{}\n", std::process::id()).as_bytes())
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // The file is removed while it is still locked, so that a process that opened it before finds its name gone
        // (`take`). This needs inode numbers; on other systems the file stays. A file that another process put there in
        // the meantime stays too.
        if cfg!(unix) && is_named(&self.file, &self.path).unwrap_or(false) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// The number in a lock file. `None` if it cannot be read: on Windows a lock also prevents others from reading.
///
/// The open file is read, not its name: the holder may end just now and remove the name.
fn holder(mut file: &File) -> Option<u32> {
    let mut text = String::new();
    file.read_to_string(&mut text).ok()?;
    text.trim().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;
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
    fn the_parts_of_a_job_have_separate_locks() {
        let folder = folder("parts");
        let parts = ["part-1-of-2", "part-2-of-2"].map(|part| Lock::take(&folder, part).unwrap());
        assert!(Lock::take(&folder, "part-1-of-2").is_err());
        drop(parts);
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
