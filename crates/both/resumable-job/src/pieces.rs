//! Finished pieces of a long job, stored on disk until the result is complete.
//!
//! A piece carries the digest of its job, its own number and a digest of all its bytes:
//!
//! ```text
//!   magic (8) │ digest of the job (16) │ number of the piece (8) │ payload │ digest of all before (16)
//! ```

use crate::atomic_file::{AtomicFile, make_folder, remove_leftovers};
use crate::digest::digest;
use crate::error::{Error, UnusablePiece};
use crate::regular_file::{Contents, read_regular};
use std::fs::OpenOptions;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const MAGIC: &[u8; 8] = b"JOBPIECE";
/// Bytes of a digest in hexadecimal digits.
const DIGEST: usize = 16;
/// Bytes before the payload: magic, digest of the job, number of the piece.
const HEAD: usize = MAGIC.len() + DIGEST + 8;

/// The beginning of the name of a note that the job is done in N parts; the name ends with N.
const PARTS: &str = "parts_of_";

/// True for the names of pieces and of notes of parts: the files that a folder of pieces has.
pub(crate) fn is_piece_name(name: &str) -> bool {
    let number = name.strip_prefix("piece_").and_then(|rest| rest.strip_suffix(".bin"));
    let digits = number.or_else(|| name.strip_prefix(PARTS));
    digits.is_some_and(|text| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit()))
}

/// The pieces of one job in one folder.
///
/// Two processes that write the same piece at once do no harm, but waste work. A [`crate::Lock`] on a part avoids this.
/// [`Pieces::assemble`] and [`Pieces::remove`] need the lock on the whole job.
#[derive(Clone)]
pub struct Pieces {
    folder: PathBuf,
    /// Digest of the description.
    job: [u8; DIGEST],
    description: String,
    is_payload: Option<Arc<IsPayload>>,
}

/// Whether bytes can be the payload of the piece with this number.
type IsPayload = dyn Fn(usize, &[u8]) -> bool + Send + Sync;

impl std::fmt::Debug for Pieces {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Pieces { folder, description, .. } = self;
        formatter
            .debug_struct("Pieces")
            .field("folder", folder)
            .field("description", description)
            .finish_non_exhaustive()
    }
}

/// What a folder has of a piece.
#[derive(Debug, PartialEq, Eq)]
pub enum StoredPiece {
    /// The payload of a finished piece.
    Finished(Vec<u8>),
    /// No file.
    Missing,
    /// A file that is not this piece. [`Pieces::write`] replaces it.
    Unusable(UnusablePiece),
}

impl Pieces {
    /// The pieces of the described job in `folder`. The folder is made if it does not exist. Temporary files of
    /// killed runs are removed from it.
    ///
    /// The description has all that the pieces depend on: the parameters, and a version of the computation that is
    /// raised when it gives other bytes.
    pub fn open(folder: &Path, description: &str) -> Result<Self, Error> {
        make_folder(folder)?;
        // Each killed run leaves the pieces it was writing. Many killed runs would fill the disk.
        remove_leftovers(folder);
        let mut job = [0; DIGEST];
        job.copy_from_slice(digest(description.as_bytes()).as_bytes());
        let (folder, description) = (folder.to_path_buf(), description.to_owned());
        Ok(Pieces { folder, job, description, is_payload: None })
    }

    /// The same pieces, of which only those count whose payload `is_payload` accepts: mostly those of the right
    /// length. A file with another payload is [`StoredPiece::Unusable`].
    #[must_use]
    pub fn holding(
        mut self,
        is_payload: impl Fn(usize, &[u8]) -> bool + Send + Sync + 'static,
    ) -> Self {
        self.is_payload = Some(Arc::new(is_payload));
        self
    }

    pub(crate) fn description(&self) -> &str {
        &self.description
    }

    pub(crate) fn path(&self, piece: usize) -> PathBuf {
        self.folder.join(format!("piece_{piece:06}.bin"))
    }

    /// Whether a piece has a file. It may be damaged: [`find`](Self::find) reads it.
    #[must_use]
    pub fn has_file(&self, piece: usize) -> bool {
        self.path(piece).is_file()
    }

    /// The payload of a piece, if it is finished and whole.
    ///
    /// # Errors
    /// [`Error::Piece`] if the name of the piece belongs to a folder or a device, which no file can replace;
    /// [`Error::File`] if the file cannot be read.
    pub fn find(&self, piece: usize) -> Result<StoredPiece, Error> {
        let path = self.path(piece);
        let mut bytes = match read_regular(&path)? {
            Contents::Bytes(bytes) => bytes,
            Contents::Missing => return Ok(StoredPiece::Missing),
            Contents::NoFile => {
                let reason = "it is no regular file";
                return Err(Error::Piece(UnusablePiece { path, reason }));
            }
        };
        if let Some(reason) = self.defect(piece, &bytes) {
            return Ok(StoredPiece::Unusable(UnusablePiece { path, reason }));
        }
        bytes.truncate(bytes.len() - DIGEST);
        bytes.drain(..HEAD);
        if self.is_payload.as_ref().is_some_and(|is_payload| !is_payload(piece, &bytes)) {
            let reason = "its contents have not the length of this piece";
            return Ok(StoredPiece::Unusable(UnusablePiece { path, reason }));
        }
        Ok(StoredPiece::Finished(bytes))
    }

    /// The reason why the contents of a file are not this piece of this job; `None` if they are.
    fn defect(&self, piece: usize, bytes: &[u8]) -> Option<&'static str> {
        if let Some(reason) = defect(bytes) {
            return Some(reason);
        }
        let (job, number) = bytes[MAGIC.len()..HEAD].split_at(DIGEST);
        if job != self.job {
            return Some("it belongs to another job");
        }
        (number != (piece as u64).to_le_bytes()).then_some("it is another piece of this job")
    }

    /// Stores a finished piece.
    pub fn write(&self, piece: usize, payload: &[u8]) -> Result<(), Error> {
        self.write_if(piece, payload, || Ok(()))
    }

    /// Stores a finished piece if `check` has no objection: before anything is written, and just before the file gets
    /// its name. It is mostly [`Lock::confirm`](crate::Lock::confirm).
    pub fn write_if<E: From<Error>>(
        &self,
        piece: usize,
        payload: &[u8],
        check: impl Fn() -> Result<(), E>,
    ) -> Result<(), E> {
        check()?;
        let mut bytes = Vec::with_capacity(HEAD + payload.len() + DIGEST);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&self.job);
        bytes.extend_from_slice(&(piece as u64).to_le_bytes());
        bytes.extend_from_slice(payload);
        let sum = digest(&bytes);
        bytes.extend_from_slice(sum.as_bytes());
        let mut file = AtomicFile::create(&self.path(piece))?;
        file.append(&bytes)?;
        file.finish_if(|_| check())
    }

    /// Notes that the job is done in so many parts, so that [`numbers_of_parts`](Self::numbers_of_parts) can tell
    /// later.
    pub fn note_parts(&self, of: usize) -> Result<(), Error> {
        let path = self.folder.join(format!("{PARTS}{of}"));
        // A file of no bytes is never half written. One that is here is the note, whoever made it: nothing is
        // written into it, nor to where it may lead.
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Err(error) if error.kind() != ErrorKind::AlreadyExists => Err(Error::at(&path)(error)),
            _ => Ok(()),
        }
    }

    /// The numbers of parts that processes have noted, in increasing order: mostly one, as many as there were
    /// different calls.
    ///
    /// # Errors
    /// [`Error::File`] if the folder cannot be read.
    pub fn numbers_of_parts(&self) -> Result<Vec<usize>, Error> {
        let entries = std::fs::read_dir(&self.folder).map_err(Error::at(&self.folder))?;
        let mut numbers = Vec::new();
        for entry in entries {
            let name = entry.map_err(Error::at(&self.folder))?.file_name();
            numbers.extend(
                name.to_str().and_then(|name| name.strip_prefix(PARTS)?.parse::<usize>().ok()),
            );
        }
        numbers.sort_unstable();
        Ok(numbers)
    }

    /// Removes all pieces of a finished job, the notes of its parts, and the half-written files of killed runs.
    pub fn remove(self, pieces: usize) -> Result<(), Error> {
        for of in self.numbers_of_parts()? {
            let path = self.folder.join(format!("{PARTS}{of}"));
            std::fs::remove_file(&path).map_err(Error::at(&path))?;
        }
        for piece in 0..pieces {
            let path = self.path(piece);
            match std::fs::remove_file(&path) {
                Err(source) if source.kind() != ErrorKind::NotFound => {
                    return Err(Error::File { path, source });
                }
                _ => {}
            }
        }
        remove_leftovers(&self.folder);
        // A folder with other files is not empty: it stays.
        let _ = std::fs::remove_dir(&self.folder);
        Ok(())
    }
}

/// The reason why the contents of a file are not a whole piece of any job; `None` if they are one. They then have at
/// least [`HEAD`] bytes.
fn defect(bytes: &[u8]) -> Option<&'static str> {
    let Some((head, rest)) = bytes.split_at_checked(HEAD) else {
        return Some("it is too short to be a piece");
    };
    if !head.starts_with(MAGIC) {
        return Some("it is no piece of any job");
    }
    if rest.len() < DIGEST {
        return Some("it is cut off");
    }
    let (checked, sum) = bytes.split_at(bytes.len() - DIGEST);
    (sum != digest(checked).as_bytes())
        .then_some("it is damaged: its digest is not that of its contents")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::atomic_file::AtomicFile;

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("resumable_pieces_{name}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        folder
    }

    fn found(kept: &Pieces, piece: usize) -> StoredPiece {
        kept.find(piece).unwrap()
    }

    /// The reason why a piece cannot be used.
    fn reason(kept: &Pieces, piece: usize) -> &'static str {
        match kept.find(piece).unwrap() {
            StoredPiece::Unusable(unusable) => unusable.reason,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn pieces_come_back_whole() {
        let folder = folder("whole");
        let kept = Pieces::open(&folder, "a job").unwrap();
        assert_eq!(found(&kept, 3), StoredPiece::Missing);
        kept.write(3, b"some bytes").unwrap();
        kept.write(4, b"").unwrap();
        [12, 3, 12].into_iter().for_each(|of| kept.note_parts(of).unwrap());
        assert_eq!(kept.numbers_of_parts().unwrap(), [3, 12]);
        let again = Pieces::open(&folder, "a job").unwrap();
        assert_eq!(found(&again, 3), StoredPiece::Finished(b"some bytes".to_vec()));
        assert_eq!(found(&again, 4), StoredPiece::Finished(Vec::new()));
        // A killed run leaves a temporary file without a lock.
        std::fs::write(folder.join("piece_000002.bin.1-7.partial.tmp"), b"half").unwrap();
        again.remove(5).unwrap();
        assert!(!folder.exists());
    }

    #[test]
    fn damaged_and_foreign_pieces_say_so_and_can_be_written_again() {
        let folder = folder("damaged");
        let kept = Pieces::open(&folder, "a job").unwrap();
        kept.write(0, b"some bytes").unwrap();
        let path = kept.path(0);
        let whole = std::fs::read(&path).unwrap();
        for length in 0..whole.len() {
            std::fs::write(&path, &whole[..length]).unwrap();
            reason(&kept, 0);
        }
        for at in 0..whole.len() {
            let mut bytes = whole.clone();
            bytes[at] ^= 1;
            std::fs::write(&path, &bytes).unwrap();
            reason(&kept, 0);
        }
        std::fs::write(&path, [&whole[..], b"more"].concat()).unwrap();
        assert!(reason(&kept, 0).contains("damaged"));
        kept.write(0, b"some bytes").unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), whole);
        let other = Pieces::open(&folder, "another job").unwrap();
        assert!(reason(&other, 0).contains("another job"));
        // The number of a piece belongs to it.
        std::fs::rename(&path, kept.path(1)).unwrap();
        assert!(reason(&kept, 1).contains("another piece"));
        kept.remove(2).unwrap();
    }

    #[test]
    fn a_payload_of_another_length_is_told() {
        let folder = folder("length");
        Pieces::open(&folder, "a job").unwrap().write(0, b"some bytes").unwrap();
        let of = |length| {
            let kept = Pieces::open(&folder, "a job").unwrap();
            kept.holding(move |piece, bytes| piece == 0 && bytes.len() == length)
        };
        assert_eq!(found(&of(10), 0), StoredPiece::Finished(b"some bytes".to_vec()));
        assert!(reason(&of(9), 0).contains("length"));
        of(9).remove(1).unwrap();
    }

    #[test]
    #[cfg(unix)]
    fn a_note_of_parts_empties_no_file_to_which_it_leads() {
        let folder = folder("note");
        let kept = Pieces::open(&folder, "a job").unwrap();
        let target = folder.join("target");
        std::fs::write(&target, b"bytes").unwrap();
        std::os::unix::fs::symlink(&target, folder.join("parts_of_2")).unwrap();
        kept.note_parts(2).unwrap();
        assert_eq!(std::fs::read(&target).unwrap(), b"bytes");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_job_that_is_opened_again_removes_what_killed_runs_left() {
        let folder = folder("killed");
        drop(Pieces::open(&folder, "a job").unwrap());
        let (left, used) =
            (folder.join("piece_000002.bin.1-7.partial.tmp"), folder.join("piece_000003.bin"));
        std::fs::write(&left, b"half").unwrap();
        let writer = AtomicFile::create(&used).unwrap();
        let kept = Pieces::open(&folder, "a job").unwrap();
        assert!(!left.exists());
        // The file of a running writer stays.
        writer.finish().unwrap();
        assert!(used.exists());
        kept.remove(4).unwrap();
    }

    #[test]
    fn a_folder_in_the_place_of_a_piece_is_told() {
        let folder = folder("no_file");
        let kept = Pieces::open(&folder, "a job").unwrap();
        std::fs::create_dir(kept.path(0)).unwrap();
        let error = kept.find(0).unwrap_err();
        assert!(matches!(error, Error::Piece { .. }), "{error}");
        assert!(error.to_string().contains("no regular file; remove it"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
