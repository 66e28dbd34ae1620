//! Finished pieces of a long job, kept on disk: whatever stops a run, the next one goes on from there.
//!
//! A piece is written under another name, flushed and renamed, so that it is there whole or not at all.
//! It carries the job it belongs to and a digest of itself.

use crate::error::Error;
use repository_tools::{Folder, digest};
use std::io::Write;
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 8] = b"HOPPIECE";

/// The pieces of one job in one folder.
#[derive(Debug, Clone)]
pub struct Checkpoint {
    folder: PathBuf,
    /// Digest of the job's description.
    job: [u8; 16],
    description: String,
}

/// What tells this build of the program from others: the size of its file and when it was written.
pub(crate) fn program_digest() -> Result<String, Error> {
    let fail = |source| Error::File { path: "this program".into(), source };
    let data = std::env::current_exe().and_then(std::fs::metadata).map_err(fail)?;
    let written = data.modified().map_err(fail)?;
    Ok(digest(format!("{} {written:?}", data.len()).as_bytes()))
}

impl Checkpoint {
    /// The pieces of the job described, in `folder`. The program itself belongs to the description: a
    /// different build may compute different bytes.
    pub fn open(folder: &Path, description: &str) -> Result<Self, Error> {
        let description = format!("{description}; program {}", program_digest()?);
        Folder::open(folder)?;
        let mut job = [0; 16];
        job.copy_from_slice(digest(description.as_bytes()).as_bytes());
        Ok(Checkpoint { folder: folder.to_path_buf(), job, description })
    }

    fn path(&self, piece: usize) -> PathBuf {
        self.folder.join(format!("piece_{piece:06}.bin"))
    }

    /// A piece, if it is finished.
    ///
    /// # Errors
    /// [`Error::Piece`] for a damaged file and for one of another job.
    pub fn read(&self, piece: usize) -> Result<Option<Vec<u8>>, Error> {
        let path = self.path(piece);
        let bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(Error::File { path, source }),
        };
        let bad = |reason| Err(Error::Piece { path: path.clone(), reason });
        let Some((head, rest)) = bytes.split_at_checked(8 + 16 + 8) else {
            return bad("it is too short to be a piece");
        };
        if head[..8] != MAGIC[..] {
            return bad("it is no piece of any job");
        }
        let Some((payload, sum)) = rest.len().checked_sub(16).map(|at| rest.split_at(at)) else {
            return bad("it is cut off");
        };
        let checked = &bytes[..bytes.len() - 16];
        if sum != digest(checked).as_bytes() {
            return bad("it is damaged: its digest is not that of its contents");
        }
        if head[8..24] != self.job || head[24..] != (piece as u64).to_le_bytes() {
            return bad("it belongs to another job, or another build of this program");
        }
        Ok(Some(payload.to_vec()))
    }

    /// Keeps a finished piece.
    pub fn write(&self, piece: usize, payload: &[u8]) -> Result<(), Error> {
        let mut bytes = Vec::with_capacity(payload.len() + 48);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&self.job);
        bytes.extend_from_slice(&(piece as u64).to_le_bytes());
        bytes.extend_from_slice(payload);
        let sum = digest(&bytes);
        bytes.extend_from_slice(sum.as_bytes());
        let (path, partial) = (self.path(piece), self.partial(piece));
        let at = |path: &Path| {
            let path = path.to_path_buf();
            move |source| Error::File { path, source }
        };
        let mut file = std::fs::File::create(&partial).map_err(at(&partial))?;
        file.write_all(&bytes).and_then(|()| file.sync_all()).map_err(at(&partial))?;
        std::fs::rename(&partial, &path).map_err(at(&path))?;
        // The name is on disk with its folder; where folders cannot be flushed, a kill is survived still.
        let _ = std::fs::File::open(&self.folder).and_then(|folder| folder.sync_all());
        Ok(())
    }

    /// A name of this process alone: two runs in one folder do not write into each other's files.
    fn partial(&self, piece: usize) -> PathBuf {
        self.path(piece).with_extension(format!("{}.partial.tmp", std::process::id()))
    }

    /// What the job is, for messages.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// Removes all pieces of a job that is done, and what killed runs left half written.
    pub fn remove(self, pieces: usize) -> Result<(), Error> {
        for piece in 0..pieces {
            let path = self.path(piece);
            match std::fs::remove_file(&path) {
                Err(source) if source.kind() != std::io::ErrorKind::NotFound => {
                    return Err(Error::File { path, source });
                }
                _ => {}
            }
        }
        for entry in std::fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            if entry.file_name().to_string_lossy().ends_with(".partial.tmp") {
                let _ = std::fs::remove_file(entry.path());
            }
        }
        // Not empty if somebody else keeps something in it: then it stays.
        let _ = std::fs::remove_dir(&self.folder);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("hopper_{name}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        folder
    }

    #[test]
    fn pieces_come_back_whole() {
        let folder = folder("whole");
        let kept = Checkpoint::open(&folder, "a job").unwrap();
        assert_eq!(kept.read(3).unwrap(), None);
        kept.write(3, b"some bytes").unwrap();
        kept.write(4, b"").unwrap();
        let again = Checkpoint::open(&folder, "a job").unwrap();
        assert_eq!(again.read(3).unwrap().as_deref(), Some(&b"some bytes"[..]));
        assert_eq!(again.read(4).unwrap().as_deref(), Some(&b""[..]));
        again.remove(5).unwrap();
        assert!(!folder.exists());
    }

    #[test]
    fn damaged_and_foreign_pieces_are_errors_that_say_so() {
        let folder = folder("damaged");
        let kept = Checkpoint::open(&folder, "a job").unwrap();
        kept.write(0, b"some bytes").unwrap();
        let path = kept.path(0);
        let whole = std::fs::read(&path).unwrap();
        for length in 0..whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap();
            assert!(matches!(kept.read(0), Err(Error::Piece { .. })), "{length}");
        }
        for at in 0..whole.len() {
            let mut bytes = whole.clone();
            bytes[at] ^= 1;
            std::fs::write(&path, &bytes).unwrap();
            assert!(matches!(kept.read(0), Err(Error::Piece { .. })), "{at}");
        }
        std::fs::write(&path, &whole).unwrap();
        let other = Checkpoint::open(&folder, "another job").unwrap();
        let error = other.read(0).unwrap_err().to_string();
        assert!(error.contains("another job") && error.contains("piece_000000"), "{error}");
        // The place of a piece belongs to it.
        std::fs::rename(&path, kept.path(1)).unwrap();
        assert!(matches!(kept.read(1), Err(Error::Piece { .. })));
        kept.remove(2).unwrap();
    }
}
