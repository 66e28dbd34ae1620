//! Files, written whole or not at all.

use crate::error::Error;
use std::path::{Path, PathBuf};

/// The root of the repository: the folder above `crates` in which this library was built.
pub fn repository() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(2).unwrap_or(package).to_path_buf()
}

/// The folder for a program's results: `out`, or the folder `name` in `target` in the repository.
pub fn results_folder(out: Option<&Path>, name: &str) -> Result<Folder, Error> {
    out.map_or_else(|| Folder::open(&repository().join("target").join(name)), Folder::open)
}

/// A folder for results.
#[derive(Debug, Clone)]
pub struct Folder(PathBuf);

impl Folder {
    /// Makes the folder if need be, and sees that it can be written to.
    pub fn open(path: &Path) -> Result<Self, Error> {
        std::fs::create_dir_all(path)
            .map_err(|source| Error::File { path: path.into(), source })?;
        let folder = Folder(path.to_path_buf());
        folder.write(".writable", b"")?;
        let probe = folder.0.join(".writable");
        std::fs::remove_file(&probe).map_err(|source| Error::File { path: probe, source })?;
        Ok(folder)
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }

    /// Writes a file under another name first: whoever looks finds the old or the new one, never half.
    pub fn write(&self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let (path, partial) = (self.0.join(name), self.0.join(format!("{name}.partial.tmp")));
        let at = |path: &Path| {
            let path = path.to_path_buf();
            move |source| Error::File { path, source }
        };
        let written = std::fs::write(&partial, bytes).map_err(at(&partial));
        let moved = written.and_then(|()| std::fs::rename(&partial, &path).map_err(at(&path)));
        if moved.is_err() {
            let _ = std::fs::remove_file(&partial); // the first error is the one to tell
        }
        moved
    }
}

/// Reads a text file.
pub fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|source| Error::File { path: path.into(), source })
}

/// The 64-bit FNV-1a digest of some bytes, to compare data that must be the same everywhere.
pub fn digest(bytes: &[u8]) -> String {
    let step = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    format!("{:016x}", bytes.iter().fold(0xcbf2_9ce4_8422_2325, step))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digest_is_fnv_1a() {
        assert_eq!(digest(b""), "cbf29ce484222325");
        assert_eq!(digest(b"a"), "af63dc4c8601ec8c");
    }

    #[test]
    fn a_folder_that_cannot_be_made_is_an_error_with_its_name() {
        let error = Folder::open(Path::new("/dev/null/paper")).unwrap_err();
        assert!(error.to_string().contains("/dev/null/paper"), "{error}");
    }
}
