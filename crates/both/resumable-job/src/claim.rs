//! The job whose results a folder has, in a text file beside them.

use crate::atomic_file::{remove_leftovers, write_atomically};
use crate::error::Error;
use crate::lock::Lock;
use crate::pieces::is_piece_name;
use crate::regular_file::{Contents, read_regular};
use std::io::ErrorKind;
use std::path::Path;

/// The name of the file with the description of the job.
const JOB_FILE: &str = "job.txt";

/// The name of the lock on this file.
const JOB_FILE_LOCK: &str = "job";

/// A longer file was not written by [`claim`]: descriptions are some lines.
const LONGEST: u64 = 1 << 16;

/// Says in `folder/job.txt` that the folder has the results of the described job, or makes sure that it does.
///
/// The description has all that the results depend on: the parameters, and the version of the computation. A
/// process with another description is refused, so that results of two jobs never mix. Processes may call this at
/// the same time. `is_result` tells the names of results and of folders of pieces: if there are any without a
/// `job.txt`, nobody knows which job made them. A folder without pieces is none of them.
///
/// # Errors
/// [`Error::OtherJob`] for a folder with another job, [`Error::UnknownJob`] for results without `job.txt`, and the
/// errors of [`Lock::take`] and of files.
pub fn claim(
    folder: &Path,
    description: &str,
    is_result: impl Fn(&str) -> bool,
) -> Result<(), Error> {
    let lock = Lock::wait(folder, JOB_FILE_LOCK)?;
    let path = folder.join(JOB_FILE);
    match claimed_by(folder)? {
        Some(found) if found == description => Ok(()),
        Some(found) => {
            Err(Error::OtherJob { folder: folder.into(), found, wanted: description.to_owned() })
        }
        None => {
            for name in names(folder)?.into_iter().filter(|name| is_result(name)) {
                let path = folder.join(name);
                if !is_folder(&path) || names(&path)?.iter().any(|name| is_piece_name(name)) {
                    return Err(Error::UnknownJob { path });
                }
            }
            lock.confirm()?;
            write_atomically(&path, format!("{description}\n").as_bytes())
        }
    }
}

/// Removes all results from a folder, and `job.txt` after them. The caller holds the lock on the job, and a [`claim`]
/// follows. A process that is killed here leaves `job.txt` and some results.
///
/// `is_result` tells the names of the files and folders to remove. Of a folder, only the pieces are removed, and
/// the folder itself if nothing else is in it.
///
/// # Errors
/// [`Error::File`] for what cannot be removed.
pub fn remove_results(folder: &Path, is_result: impl Fn(&str) -> bool) -> Result<(), Error> {
    for name in names(folder)?.into_iter().filter(|name| is_result(name)) {
        let path = folder.join(name);
        if !is_folder(&path) {
            std::fs::remove_file(&path).map_err(Error::at(&path))?;
            continue;
        }
        for name in names(&path)?.into_iter().filter(|name| is_piece_name(name)) {
            let path = path.join(name);
            std::fs::remove_file(&path).map_err(Error::at(&path))?;
        }
        remove_leftovers(&path);
        // A folder with files of others stays.
        let _ = std::fs::remove_dir(&path);
    }
    let path = folder.join(JOB_FILE);
    match std::fs::remove_file(&path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(Error::at(&path)(error)),
        _ => Ok(()),
    }
}

/// Whether the folder has the description of a job.
pub fn is_claimed(folder: &Path) -> bool {
    folder.join(JOB_FILE).is_file()
}

/// Whether this is a folder itself, and not a link to one.
fn is_folder(path: &Path) -> bool {
    std::fs::symlink_metadata(path).is_ok_and(|data| data.is_dir())
}

/// The description of the job whose results a folder has; `None` if it has none.
///
/// # Errors
/// [`Error::File`] for a `job.txt` that is no description of a job, or cannot be read.
pub fn claimed_by(folder: &Path) -> Result<Option<String>, Error> {
    let path = &folder.join(JOB_FILE);
    match read_regular(path)? {
        Contents::Bytes(bytes) if bytes.len() as u64 <= LONGEST => {
            Ok(Some(String::from_utf8_lossy(&bytes).trim_end().to_owned()))
        }
        Contents::Missing => Ok(None),
        Contents::Bytes(_) | Contents::NoFile => {
            let reason =
                "this is no file with the description of a job; remove it, or give another folder";
            Err(Error::at(path)(std::io::Error::new(ErrorKind::InvalidData, reason)))
        }
    }
}

/// The names in a folder, in order.
fn names(folder: &Path) -> Result<Vec<String>, Error> {
    let entries = std::fs::read_dir(folder).map_err(Error::at(folder))?;
    let mut names = Vec::new();
    for entry in entries {
        names.extend(entry.map_err(Error::at(folder))?.file_name().into_string().ok());
    }
    names.sort();
    Ok(names)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("resumable_claim_{name}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    fn is_result(name: &str) -> bool {
        ["tiles", "array.npy"].contains(&name)
    }

    #[test]
    fn a_folder_has_one_job_until_its_results_are_removed() {
        let folder = folder("one");
        std::fs::write(folder.join("notes.md"), b"of the user").unwrap();
        claim(&folder, "squares of 0 to 3", is_result).unwrap();
        claim(&folder, "squares of 0 to 3", is_result).unwrap();
        assert!(is_claimed(&folder));
        std::fs::create_dir_all(folder.join("tiles")).unwrap();
        for name in ["piece_000012.bin", "parts_of_3", "piece_000001.bin.1-2.partial.tmp"] {
            std::fs::write(folder.join("tiles").join(name), b"").unwrap();
        }
        std::fs::write(folder.join("array.npy"), b"").unwrap();
        let error = claim(&folder, "cubes of 0 to 3", is_result).unwrap_err();
        assert!(matches!(error, Error::OtherJob { .. }), "{error}");
        let text = error.to_string();
        assert!(text.contains("squares of 0 to 3") && text.contains("cubes of 0 to 3"), "{text}");
        assert!(text.contains(&folder.display().to_string()), "{text}");
        remove_results(&folder, is_result).unwrap();
        claim(&folder, "cubes of 0 to 3", is_result).unwrap();
        assert_eq!(names(&folder).unwrap(), ["job.txt", "notes.md"]);
        assert_eq!(std::fs::read(folder.join("job.txt")).unwrap(), b"cubes of 0 to 3\n");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    /// A user's folder can have the name of a folder of pieces.
    #[test]
    fn only_pieces_are_removed_from_a_folder() {
        let folder = folder("own");
        std::fs::create_dir_all(folder.join("tiles/more")).unwrap();
        std::fs::write(folder.join("tiles/photo.png"), b"of the user").unwrap();
        claim(&folder, "squares", is_result).unwrap();
        std::fs::write(folder.join("tiles/piece_000000.bin"), b"").unwrap();
        remove_results(&folder, is_result).unwrap();
        assert!(!is_claimed(&folder));
        assert_eq!(names(&folder.join("tiles")).unwrap(), ["more", "photo.png"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn results_without_a_job_are_refused() {
        let folder = folder("unknown");
        std::fs::write(folder.join("array.npy"), b"").unwrap();
        let error = claim(&folder, "squares", is_result).unwrap_err();
        assert!(matches!(error, Error::UnknownJob { .. }), "{error}");
        assert!(error.to_string().contains("array.npy"), "{error}");
        assert_eq!(names(&folder).unwrap(), ["array.npy"]);
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_damaged_description_is_another_job_and_a_folder_is_told() {
        let folder = folder("damaged");
        let path = folder.join("job.txt");
        for contents in [&b""[..], b"squar", b"\xff\xfe", b"squares and more"] {
            std::fs::write(&path, contents).unwrap();
            let error = claim(&folder, "squares", is_result).unwrap_err();
            assert!(matches!(error, Error::OtherJob { .. }), "{error}");
        }
        std::fs::write(&path, vec![b'a'; 100_000]).unwrap();
        assert!(claim(&folder, "squares", is_result).is_err());
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
        let error = claim(&folder, "squares", is_result).unwrap_err().to_string();
        assert!(error.contains("job.txt") && error.contains("remove it"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    /// Many processes start at once in an empty folder with two jobs: one job gets the folder.
    #[test]
    fn of_two_jobs_at_once_one_gets_the_folder() {
        let folder = folder("race");
        let claimed: Vec<(usize, bool)> = std::thread::scope(|scope| {
            let one = |k: usize| {
                let folder = &folder;
                scope.spawn(move || (k % 2, claim(folder, ["a", "b"][k % 2], is_result).is_ok()))
            };
            let threads: Vec<_> = (0..8).map(one).collect();
            threads.into_iter().map(|thread| thread.join().unwrap()).collect()
        });
        let job = std::fs::read_to_string(folder.join("job.txt")).unwrap();
        for (k, is_claimed) in claimed {
            assert_eq!(is_claimed, job.trim() == ["a", "b"][k]);
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
