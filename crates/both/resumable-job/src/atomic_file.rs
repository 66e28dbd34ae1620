//! Files that appear under their name complete or not at all.
//!
//! The bytes go to a temporary file beside the final one. They are flushed to the disk, and the temporary file is
//! renamed. The temporary name contains the number of the process and a counter, and is created new each time.
//! Therefore no two writers share it. The writer locks its temporary file: a temporary file without a lock belongs to a
//! writer that has ended.
//!
//! A name that is a link is written through: the file to which it leads is replaced, and the link stays. A named
//! pipe or a device cannot be replaced, and is refused.

use crate::error::Error;
use crate::open_file::is_named;
use std::fs::{File, OpenOptions, TryLockError};
use std::io::{BufWriter, ErrorKind, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// The ending of every temporary name.
const SUFFIX: &str = ".partial.tmp";

/// Links that are followed one after the other: as many as Linux follows.
const MOST_LINKS: usize = 40;

/// Temporary files that this process has begun.
static BEGUN: AtomicU64 = AtomicU64::new(0);

/// A file under construction; [`AtomicFile::finish`] gives it its name. If it is dropped before, no file remains.
#[derive(Debug)]
pub struct AtomicFile {
    file: BufWriter<File>,
    temporary: PathBuf,
    /// The name that the caller gave.
    path: PathBuf,
    /// The file that gets the bytes: that of the name, or the one to which it leads.
    destination: PathBuf,
    has_its_name: bool,
}

impl AtomicFile {
    /// Begins a file that will be named `path`, in a folder that exists.
    ///
    /// # Errors
    /// [`Error::File`] if the file cannot be created, or if `path` is, or leads to, a folder, a named pipe or a
    /// device, which no file can replace.
    pub fn create(path: &Path) -> Result<Self, Error> {
        let destination = destination(path)?;
        let old = std::fs::metadata(&destination).ok();
        if let Some(old) = old.as_ref().filter(|old| !old.is_file()) {
            let (kind, reason) = if old.is_dir() {
                (
                    ErrorKind::IsADirectory,
                    "this is a folder, and a file is to have this name; remove it, or give another folder",
                )
            } else {
                (
                    ErrorKind::InvalidInput,
                    "this is a named pipe or a device, and a file is written whole or not at all; give a file",
                )
            };
            return Err(Error::at(path)(std::io::Error::new(kind, reason)));
        }
        let name = destination.file_name().unwrap_or_default().to_string_lossy().into_owned();
        loop {
            let count = BEGUN.fetch_add(1, Ordering::Relaxed);
            let temporary = destination
                .with_file_name(format!("{name}.{}-{count}{SUFFIX}", std::process::id()));
            let new = OpenOptions::new().read(true).write(true).create_new(true).open(&temporary);
            let file = match new {
                Ok(file) => file,
                // The number of a process is used again after its end, and in another container at the same time. The
                // name then belongs to another process: the next count is tried.
                Err(error) if error.kind() == ErrorKind::AlreadyExists => continue,
                // The temporary name means nothing to a reader.
                Err(error) => return Err(Error::at(path)(error)),
            };
            let ours = match file.try_lock() {
                Ok(()) => is_named(&file, &temporary).map_err(Error::at(&temporary))?,
                // `remove_leftovers` of another process found the file before it was locked, and removes it.
                Err(TryLockError::WouldBlock) => false,
                // Without locks on this file system, `remove_leftovers` removes no file either.
                Err(TryLockError::Error(_)) => true,
            };
            if ours {
                if let Some(old) = &old {
                    // The new file is as open to others as the one that it replaces. Where that cannot be, it is
                    // its owner's.
                    let _ = file.set_permissions(old.permissions());
                }
                let (path, file) = (path.to_path_buf(), BufWriter::new(file));
                return Ok(AtomicFile { file, temporary, path, destination, has_its_name: false });
            }
        }
    }

    /// Appends bytes.
    pub fn append(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.file.write_all(bytes).map_err(Error::at(&self.path))
    }

    /// Flushes the bytes to the disk and gives the file its name.
    pub fn finish(self) -> Result<(), Error> {
        self.finish_if(|_| Ok(()))
    }

    /// As [`finish`](Self::finish), if `check` accepts the file. `check` receives the flushed file, at its start. After
    /// an error of `check`, the file that had the name before is unchanged.
    pub fn finish_if<E: From<Error>>(
        mut self,
        check: impl FnOnce(&mut File) -> Result<(), E>,
    ) -> Result<(), E> {
        let flushed = self.file.flush().and_then(|()| {
            let file = self.file.get_mut();
            file.sync_all()?;
            file.seek(SeekFrom::Start(0))
        });
        flushed.map_err(Error::at(&self.path))?;
        check(self.file.get_mut())?;
        std::fs::rename(&self.temporary, &self.destination).map_err(Error::at(&self.path))?;
        self.has_its_name = true;
        sync_folder_of(&self.destination);
        Ok(())
    }
}

impl Drop for AtomicFile {
    fn drop(&mut self) {
        if !self.has_its_name {
            // An earlier error is reported. If this removal fails too, `remove_leftovers` removes the file later.
            let _ = std::fs::remove_file(&self.temporary);
        }
    }
}

/// The file that gets the bytes for a name: that name, or the one to which it leads by links, whether it exists or not.
///
/// # Errors
/// [`Error::File`] for links that cannot be read, or that lead in a circle.
pub fn destination(path: &Path) -> Result<PathBuf, Error> {
    let mut destination = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match std::fs::read_link(&destination) {
            // A link is relative to the folder in which it lies.
            Ok(next) => destination = destination.with_file_name("").join(next),
            Err(error) if matches!(error.kind(), ErrorKind::InvalidInput | ErrorKind::NotFound) => {
                return Ok(destination);
            }
            // An existing file of another kind, on systems with other answers.
            Err(_) if !destination.is_symlink() => return Ok(destination),
            Err(error) => return Err(Error::at(path)(error)),
        }
    }
    let reason = "this link leads to another one, and so on without end; remove it";
    Err(Error::at(path)(std::io::Error::new(ErrorKind::InvalidInput, reason)))
}

/// Writes a whole file: a reader finds either the old bytes or the new ones.
pub fn write_atomically(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut file = AtomicFile::create(path)?;
    file.append(bytes)?;
    file.finish()
}

/// Makes a folder with its parents. A folder that exists stays as it is.
///
/// # Errors
/// [`Error::File`] with the answer of the system; with the reason if a file, or a link that leads nowhere, has this
/// name.
pub fn make_folder(folder: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(folder).map_err(|error| {
        let error = if error.kind() == ErrorKind::AlreadyExists {
            let reason = "this is a file, or a link that leads to no folder; remove it, or give another folder";
            std::io::Error::new(ErrorKind::NotADirectory, reason)
        } else {
            error
        };
        Error::at(folder)(error)
    })
}

/// Removes from a folder the temporary files of [`AtomicFile`]s whose process no longer runs.
/// Files of running or stopped processes stay, since these processes hold their locks. Files that cannot be locked or
/// read stay too. Such a leftover only costs disk space, so that no failure is reported.
pub fn remove_leftovers(folder: &Path) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        if !is_temporary(&entry.file_name().to_string_lossy()) {
            continue;
        }
        // Opening a named pipe would wait for a reader.
        if !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let path = entry.path();
        // Opened for writing, because some network file systems lock only files that are open for writing.
        let Ok(file) = OpenOptions::new().write(true).open(&path) else { continue };
        if file.try_lock().is_ok() && is_named(&file, &path).unwrap_or(false) {
            // The lock is held during the removal. A writer that created this file just now therefore notices the
            // removal (`create`).
            let _ = std::fs::remove_file(&path);
        }
    }
}

/// True for names as [`AtomicFile::create`] makes them: NAME.PROCESS-COUNT.partial.tmp.
fn is_temporary(name: &str) -> bool {
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    name.strip_suffix(SUFFIX)
        .and_then(|rest| rest.rsplit_once('.'))
        .and_then(|(_, numbers)| numbers.split_once('-'))
        .is_some_and(|(process, count)| is_number(process) && is_number(count))
}

/// Flushes the folder, which holds the name. Some systems cannot flush folders. A name may then be lost when the power
/// fails, but not when the process is killed. Therefore this is no error.
fn sync_folder_of(path: &Path) {
    let parent = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    let _ = File::open(parent.unwrap_or(Path::new("."))).and_then(|folder| folder.sync_all());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("resumable_file_{name}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn names(folder: &Path) -> Vec<String> {
        let entries = std::fs::read_dir(folder).unwrap();
        let mut names: Vec<_> =
            entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_has_its_name_only_when_finished() {
        let folder = folder("name");
        let path = folder.join("a");
        write_atomically(&path, b"old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.append(b"new").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        file.finish().unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        let mut dropped = AtomicFile::create(&path).unwrap();
        dropped.append(b"never").unwrap();
        drop(dropped);
        assert_eq!(std::fs::read(&path).unwrap(), b"new");
        assert_eq!(names(&folder), ["a"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_folder_of_this_name_is_an_error_at_the_beginning() {
        let folder = folder("is_folder");
        let error = AtomicFile::create(&folder).unwrap_err().to_string();
        assert!(error.contains("is_folder") && error.contains("this is a folder"), "{error}");
        assert_eq!(names(&folder), [""; 0]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    #[cfg(unix)]
    fn a_link_is_written_through() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = folder("link");
        std::fs::create_dir(folder.join("there")).unwrap();
        let target = folder.join("there/target");
        symlink("there/target", folder.join("b")).unwrap();
        symlink("b", folder.join("a")).unwrap();
        // The link leads to no file yet.
        for bytes in [b"first", b"again"] {
            write_atomically(&folder.join("a"), bytes).unwrap();
            assert_eq!(std::fs::read(&target).unwrap(), bytes);
            assert!(folder.join("a").is_symlink() && !target.is_symlink());
        }
        // The mode of the file stays.
        std::fs::set_permissions(&target, std::fs::Permissions::from_mode(0o600)).unwrap();
        write_atomically(&folder.join("a"), b"third").unwrap();
        assert_eq!(std::fs::metadata(&target).unwrap().permissions().mode() & 0o777, 0o600);
        assert_eq!(names(&folder.join("there")), ["target"]);
        symlink("circle", folder.join("circle")).unwrap();
        let error = write_atomically(&folder.join("circle"), b"").unwrap_err().to_string();
        assert!(error.contains("without end"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    #[cfg(unix)]
    fn a_pipe_is_refused_with_the_reason() {
        let folder = folder("pipe");
        let pipe = folder.join("pipe");
        assert!(std::process::Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        std::os::unix::fs::symlink("/dev/null", folder.join("null")).unwrap();
        for name in ["pipe", "null"] {
            let error = write_atomically(&folder.join(name), b"").unwrap_err().to_string();
            assert!(error.contains("named pipe") && error.contains(name), "{error}");
        }
        assert_eq!(names(&folder), ["null", "pipe"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_in_the_place_of_a_folder_is_told() {
        let folder = folder("make");
        make_folder(&folder.join("a/b")).unwrap();
        make_folder(&folder.join("a")).unwrap();
        std::fs::write(folder.join("c"), b"").unwrap();
        let error = make_folder(&folder.join("c")).unwrap_err().to_string();
        assert!(error.contains("this is a file") && error.contains("remove it"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_refused_file_leaves_the_old_one() {
        let folder = folder("refused");
        let path = folder.join("a");
        write_atomically(&path, b"old").unwrap();
        let mut file = AtomicFile::create(&path).unwrap();
        file.append(b"new").unwrap();
        let error = std::io::Error::other("refused");
        let refused: Result<(), Error> = file.finish_if(|_| Err(Error::at(&path)(error)));
        assert!(refused.is_err());
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
        assert_eq!(names(&folder), ["a"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn many_writers_of_one_name_leave_the_bytes_of_one_of_them() {
        let folder = folder("many");
        let path = folder.join("a");
        std::thread::scope(|scope| {
            for letter in b'a'..b'i' {
                let path = &path;
                scope.spawn(move || {
                    for _ in 0..20 {
                        write_atomically(path, &vec![letter; 100_000]).unwrap();
                        remove_leftovers(path.parent().unwrap());
                    }
                });
            }
        });
        let bytes = std::fs::read(&path).unwrap();
        assert_eq!(bytes.len(), 100_000);
        assert!(bytes.iter().all(|byte| *byte == bytes[0]));
        assert_eq!(names(&folder), ["a"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn leftovers_go_and_files_in_use_stay() {
        let folder = folder("leftovers");
        let file = AtomicFile::create(&folder.join("a")).unwrap();
        let stay = ["b.partial.tmp", "c.1-x.partial.tmp", "d.-1.partial.tmp", "e.tmp", "f.1-2.tmp"];
        for name in stay.iter().chain(&["g.npy.123-4.partial.tmp", "h.1-0.partial.tmp"]) {
            std::fs::write(folder.join(name), b"").unwrap();
        }
        remove_leftovers(&folder);
        let mut expected: Vec<_> = stay.iter().map(|&name| name.to_owned()).collect();
        expected.push(file.temporary.file_name().unwrap().to_string_lossy().into_owned());
        expected.sort();
        assert_eq!(names(&folder), expected);
        file.finish().unwrap();
        assert!(folder.join("a").exists());
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_name_left_by_an_earlier_process_of_the_same_number_is_passed_over() {
        let folder = folder("same_number");
        let next = BEGUN.load(Ordering::Relaxed);
        // Other tests of this process also take counts, so that a range of names is occupied.
        for count in next..next + 50 {
            let name = format!("a.{}-{count}{SUFFIX}", std::process::id());
            std::fs::write(folder.join(name), b"left over").unwrap();
        }
        write_atomically(&folder.join("a"), b"bytes").unwrap();
        assert_eq!(std::fs::read(folder.join("a")).unwrap(), b"bytes");
        remove_leftovers(&folder);
        assert_eq!(names(&folder), ["a"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn errors_name_the_file() {
        let error = write_atomically(Path::new("/dev/null/a"), b"").unwrap_err();
        assert!(error.to_string().contains("/dev/null/a"), "{error}");
    }
}
