//! One lock file: the lock belongs to the open file, and ends with its process.
//!
//! The system removes the lock when the process ends, also if it is killed. A lock file left on disk is therefore
//! harmless, and the next process locks it again. A stopped process keeps its lock.

use crate::error::Error;
use crate::open_file::is_named;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Time before a refused lock is tried once more. Between taking the lock and writing its number, a holder's file has
/// no number or an old one. That takes microseconds. A longer time would delay the refusal without a gain.
pub(crate) const SECOND_TRY_AFTER: Duration = Duration::from_millis(20);

/// Trials to lock a file that its last holder removes meanwhile. Each lost trial needs another process that ended at
/// that instant, so that a few trials suffice. The limit is for file systems on which a name never shows the file that
/// was opened.
const TRIALS: usize = 100;

/// How many processes may hold a lock file at once.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Holders {
    /// One.
    One,
    /// Any number of those that ask for it in this way.
    Many,
}

/// A locked file, until it is dropped.
#[derive(Debug)]
pub(crate) struct LockedFile {
    file: File,
    path: PathBuf,
    holders: Holders,
}

/// The outcome of a trial to lock a file.
pub(crate) enum Trial {
    Locked(LockedFile),
    /// Another process holds it; its number, if the file contains it.
    Held(Option<u32>),
}

impl LockedFile {
    /// Locks `folder/name.lock`. A file with one holder contains the number of its process.
    pub(crate) fn take(folder: &Path, name: &str, holders: Holders) -> Result<Trial, Error> {
        let path = folder.join(format!("{name}.lock"));
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
            let tried = match holders {
                Holders::One => file.try_lock(),
                Holders::Many => file.try_lock_shared(),
            };
            match tried {
                // The last holder removed the file after this process opened it: the lock protects nothing.
                Ok(()) if !is_named(&file, &path).map_err(Error::at(&path))? => continue,
                Ok(()) => {
                    let locked = LockedFile { file, path, holders };
                    locked.tell_process().map_err(Error::at(&locked.path))?;
                    return Ok(Trial::Locked(locked));
                }
                Err(TryLockError::WouldBlock) if !refused => {
                    refused = true;
                    std::thread::sleep(SECOND_TRY_AFTER);
                }
                Err(TryLockError::WouldBlock) => return Ok(Trial::Held(holder(&file))),
                Err(TryLockError::Error(source)) => {
                    return Err(Error::NoLocks { folder: folder.into(), source });
                }
            }
        }
        let source = std::io::Error::other("the lock file never is the file that was opened");
        Err(Error::NoLocks { folder: folder.into(), source })
    }

    /// As [`crate::Lock::confirm`].
    pub(crate) fn confirm(&self) -> Result<(), Error> {
        if is_named(&self.file, &self.path).map_err(Error::at(&self.path))? {
            Ok(())
        } else {
            Err(Error::LockLost { path: self.path.clone() })
        }
    }

    fn tell_process(&self) -> std::io::Result<()> {
        self.file.set_len(0)?; // the number of a killed holder
        match self.holders {
            Holders::One => (&self.file).write_all(format!("{}\n", std::process::id()).as_bytes()),
            Holders::Many => Ok(()),
        }
    }

    /// Whether this process is the only holder from now on. If not, it holds the file no longer.
    fn is_last(&self) -> bool {
        self.holders == Holders::One || self.file.try_lock().is_ok()
    }
}

impl Drop for LockedFile {
    fn drop(&mut self) {
        // The file is removed while it is still locked, so that a process that opened it before finds its name gone
        // (`take`). This needs inode numbers; on other systems the file stays. A file that another process put there in
        // the meantime stays too, and so does a file that others hold.
        if cfg!(unix) && self.is_last() && is_named(&self.file, &self.path).unwrap_or(false) {
            let _ = std::fs::remove_file(&self.path);
        }
    }
}

/// The process that holds `path`; `None` if no process does, or if the file does not contain its number.
pub(crate) fn holder_of(path: &Path) -> Option<u32> {
    // Opening a named pipe would wait for a reader.
    if !std::fs::symlink_metadata(path).is_ok_and(|data| data.is_file()) {
        return None;
    }
    // Opened for writing, because some network file systems lock only files that are open for writing.
    let file = OpenOptions::new().read(true).write(true).open(path).ok()?;
    match file.try_lock_shared() {
        Err(TryLockError::WouldBlock) => holder(&file),
        _ => None,
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
