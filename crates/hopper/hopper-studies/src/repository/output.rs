//! Folders for results, and files to read.

use crate::error::Error;
use resumable_job::{AtomicFile, make_folder, remove_leftovers, write_atomically};
use std::path::{Path, PathBuf};

/// The root of the repository: the folder above `crates` in which this library was built.
pub(crate) fn repository() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(3).unwrap_or(package).to_path_buf()
}

/// The folder for a program's results: `out`, or the folder `name` in `target` in the repository.
pub(crate) fn results_folder(out: Option<&Path>, name: &str) -> Result<Folder, Error> {
    out.map_or_else(|| Folder::open(&repository().join("target").join(name)), Folder::open)
}

/// A folder for results.
#[derive(Debug, Clone)]
pub(crate) struct Folder(PathBuf);

impl Folder {
    /// Makes the folder if it does not exist, and tries to write a file in it: a command then fails before its
    /// computation and not after it. Removes temporary files of killed runs.
    pub(crate) fn open(path: &Path) -> Result<Self, Error> {
        make_folder(path)?;
        // The trial file is dropped unfinished, which removes it.
        drop(AtomicFile::create(&path.join(".writable"))?);
        let folder = Folder(path.to_path_buf());
        folder.remove_leftovers();
        Ok(folder)
    }

    /// The path of the folder.
    pub(crate) fn path(&self) -> &Path {
        &self.0
    }

    /// Writes a file: other processes find the old file or the complete new one.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        Ok(write_atomically(&self.0.join(name), bytes)?)
    }

    /// Removes temporary files of killed runs. Files that a running process writes stay.
    pub(crate) fn remove_leftovers(&self) {
        remove_leftovers(&self.0);
    }
}

/// Reads a text file.
pub(crate) fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|source| Error::File { path: path.into(), source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_cannot_be_made_is_an_error_with_its_name() {
        let error = Folder::open(Path::new("/dev/null/paper")).unwrap_err();
        assert!(error.to_string().contains("/dev/null/paper"), "{error}");
    }

    #[test]
    fn opening_a_folder_leaves_no_file_in_it() {
        let path = std::env::temp_dir().join(format!("hopper_folder_{}", std::process::id()));
        let folder = Folder::open(&path).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        std::fs::remove_dir(&path).unwrap();
    }
}
