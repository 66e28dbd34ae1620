//! Finished pieces of a long job, stored on disk until the result is complete.
//!
//! A piece carries the digest of its job, its own number and a digest of all its bytes:
//!
//! ```text
//!   magic (8) │ digest of the job (16) │ number of the piece (8) │ payload │ digest of all before (16)
//! ```

use crate::atomic_file::{AtomicFile, make_folder, remove_leftovers, write_atomically};
use crate::digest::{digest, program_digest};
use crate::error::Error;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::{Path, PathBuf};

const MAGIC: &[u8; 8] = b"JOBPIECE";
/// Bytes of a digest in hexadecimal digits.
const DIGEST: usize = 16;
/// Bytes before the payload: magic, digest of the job, number of the piece.
const HEAD: usize = MAGIC.len() + DIGEST + 8;

/// The pieces of one job in one folder.
/// Two processes that write the same piece at once do no harm, but waste work. A [`crate::Lock`] avoids this.
/// [`Pieces::assemble`] and [`Pieces::remove`] need the lock.
/// needed for [`Pieces::assemble`] and [`Pieces::remove`].
#[derive(Debug, Clone)]
pub struct Pieces {
    folder: PathBuf,
    /// Digest of the description.
    job: [u8; DIGEST],
    description: String,
}

impl Pieces {
    /// The pieces of the described job in `folder`. The folder is made if it does not exist. Temporary files of killed runs
    /// are removed from it.
    ///
    /// The running program belongs to the description: another build may compute other bytes.
    pub fn open(folder: &Path, description: &str) -> Result<Self, Error> {
        let description = format!("{description}; program {}", program_digest()?);
        make_folder(folder)?;
        // Each killed run leaves the pieces it was writing. Many killed runs would fill the disk.
        remove_leftovers(folder);
        let mut job = [0; DIGEST];
        job.copy_from_slice(digest(description.as_bytes()).as_bytes());
        Ok(Pieces { folder: folder.to_path_buf(), job, description })
    }

    fn path(&self, piece: usize) -> PathBuf {
        self.folder.join(format!("piece_{piece:06}.bin"))
    }

    /// The payload of a piece; `None` if the piece is not finished.
    ///
    /// # Errors
    /// [`Error::Piece`] for a damaged file and for another piece of this job; [`Error::ForeignPiece`] for a piece of
    /// another job.
    pub fn read(&self, piece: usize) -> Result<Option<Vec<u8>>, Error> {
        let path = self.path(piece);
        // Asked before the file is opened: opening a named pipe would wait for a writer.
        match std::fs::metadata(&path) {
            Ok(data) if data.is_file() => {}
            Ok(_) => return Err(Error::Piece { path, reason: "it is no regular file" }),
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(Error::File { path, source }),
        }
        let mut bytes = match std::fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            Err(source) => return Err(Error::File { path, source }),
        };
        if let Some(reason) = defect(&bytes) {
            return Err(Error::Piece { path, reason });
        }
        let (job, number) = bytes[MAGIC.len()..HEAD].split_at(DIGEST);
        if job != self.job {
            return Err(Error::ForeignPiece { path });
        }
        if number != (piece as u64).to_le_bytes() {
            return Err(Error::Piece { path, reason: "it is another piece of this job" });
        }
        bytes.truncate(bytes.len() - DIGEST);
        bytes.drain(..HEAD);
        Ok(Some(bytes))
    }

    /// Stores a finished piece.
    pub fn write(&self, piece: usize, payload: &[u8]) -> Result<(), Error> {
        let mut bytes = Vec::with_capacity(HEAD + payload.len() + DIGEST);
        bytes.extend_from_slice(MAGIC);
        bytes.extend_from_slice(&self.job);
        bytes.extend_from_slice(&(piece as u64).to_le_bytes());
        bytes.extend_from_slice(payload);
        let sum = digest(&bytes);
        bytes.extend_from_slice(sum.as_bytes());
        write_atomically(&self.path(piece), &bytes)
    }

    /// The payload of a piece that must be finished.
    fn finished(&self, piece: usize) -> Result<Vec<u8>, Error> {
        self.read(piece)?.ok_or_else(|| Error::MissingPiece {
            path: self.path(piece),
            job: self.description.clone(),
        })
    }

    /// Writes `header` and the payloads of the pieces 0 … `pieces` − 1 to the file `path`. Compares the written bytes
    /// with the pieces before the file gets its name.
    ///
    /// `look` receives each payload that agrees, in order, with its number.
    ///
    /// # Errors
    /// [`Error::MissingPiece`] if a piece is not finished; [`Error::Differs`] if the written file does not have the
    /// bytes of the pieces. After either error the pieces, and a file that had this name before, are unchanged.
    pub fn assemble(
        &self,
        path: &Path,
        header: &[u8],
        pieces: usize,
        look: impl FnMut(usize, &[u8]),
    ) -> Result<(), Error> {
        let mut file = AtomicFile::create(path)?;
        file.append(header)?;
        for piece in 0..pieces {
            file.append(&self.finished(piece)?)?;
        }
        file.finish_if(|written| self.compare(written, path, header, pieces, look))
    }

    /// Reads a file from its start, and compares it with the header and all pieces.
    fn compare(
        &self,
        written: &mut File,
        path: &Path,
        header: &[u8],
        pieces: usize,
        mut look: impl FnMut(usize, &[u8]),
    ) -> Result<(), Error> {
        let mut offset = 0;
        let mut found = Vec::new();
        let mut agree = |expected: &[u8], part: &dyn Fn() -> String| {
            found.resize(expected.len(), 0);
            let is_whole = match written.read_exact(&mut found) {
                Ok(()) => true,
                Err(error) if error.kind() == ErrorKind::UnexpectedEof => false,
                Err(error) => return Err(Error::at(path)(error)),
            };
            if !is_whole || found != expected {
                return Err(Error::Differs { path: path.into(), part: part(), offset });
            }
            offset += expected.len() as u64;
            Ok(())
        };
        agree(header, &|| "the header".to_owned())?;
        for piece in 0..pieces {
            let payload = self.finished(piece)?;
            agree(&payload, &|| format!("piece {piece}"))?;
            look(piece, &payload);
        }
        let length = written.metadata().map_err(Error::at(path))?.len();
        if length != offset {
            let part = "its end".to_owned();
            return Err(Error::Differs { path: path.into(), part, offset });
        }
        Ok(())
    }

    /// Removes all pieces of a finished job, and the half-written files of killed runs.
    pub fn remove(self, pieces: usize) -> Result<(), Error> {
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

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("resumable_pieces_{name}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        folder
    }

    #[test]
    fn pieces_come_back_whole() {
        let folder = folder("whole");
        let kept = Pieces::open(&folder, "a job").unwrap();
        assert_eq!(kept.read(3).unwrap(), None);
        kept.write(3, b"some bytes").unwrap();
        kept.write(4, b"").unwrap();
        let again = Pieces::open(&folder, "a job").unwrap();
        assert_eq!(again.read(3).unwrap().as_deref(), Some(&b"some bytes"[..]));
        assert_eq!(again.read(4).unwrap().as_deref(), Some(&b""[..]));
        // A killed run leaves a temporary file without a lock.
        std::fs::write(folder.join("piece_000002.bin.1-7.partial.tmp"), b"half").unwrap();
        again.remove(5).unwrap();
        assert!(!folder.exists());
    }

    #[test]
    fn damaged_and_foreign_pieces_are_errors_that_say_so() {
        let folder = folder("damaged");
        let kept = Pieces::open(&folder, "a job").unwrap();
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
        let other = Pieces::open(&folder, "another job").unwrap();
        let error = other.read(0).unwrap_err().to_string();
        assert!(error.contains("another job") && error.contains("piece_000000"), "{error}");
        // The number of a piece belongs to it.
        std::fs::rename(&path, kept.path(1)).unwrap();
        assert!(matches!(kept.read(1), Err(Error::Piece { .. })));
        kept.remove(2).unwrap();
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
    fn a_piece_of_another_job_names_the_folder_to_remove() {
        let folder = folder("foreign");
        Pieces::open(&folder, "a job").unwrap().write(0, b"bytes").unwrap();
        let error = Pieces::open(&folder, "another job").unwrap().read(0).unwrap_err();
        assert!(matches!(error, Error::ForeignPiece { .. }), "{error}");
        assert!(error.to_string().ends_with(&format!("the folder {}", folder.display())));
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_folder_in_the_place_of_a_piece_is_told() {
        let folder = folder("no_file");
        let kept = Pieces::open(&folder, "a job").unwrap();
        std::fs::create_dir(kept.path(0)).unwrap();
        let error = kept.read(0).unwrap_err();
        assert!(matches!(error, Error::Piece { .. }), "{error}");
        assert!(error.to_string().contains("no regular file; remove it"), "{error}");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn pieces_are_assembled_in_order() {
        let folder = folder("assembled");
        let kept = Pieces::open(&folder.join("pieces"), "a job").unwrap();
        for (piece, payload) in [&b"two "[..], b"", b"three"].into_iter().enumerate().rev() {
            kept.write(piece, payload).unwrap();
        }
        let (path, mut seen) = (folder.join("all"), Vec::new());
        kept.assemble(&path, b"one ", 3, |piece, payload| seen.push((piece, payload.len())))
            .unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"one two three");
        assert_eq!(seen, [(0, 4), (1, 0), (2, 5)]);
        let missing = kept.assemble(&path, b"", 4, |_, _| ()).unwrap_err();
        assert!(missing.to_string().contains("piece_000003"), "{missing}");
        // The file of the earlier success is untouched.
        assert_eq!(std::fs::read(&path).unwrap(), b"one two three");
        std::fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn a_file_that_differs_from_its_pieces_is_found() {
        let folder = folder("differs");
        let kept = Pieces::open(&folder.join("pieces"), "a job").unwrap();
        kept.write(0, b"abcd").unwrap();
        kept.write(1, b"efgh").unwrap();
        let path = folder.join("all");
        let compare = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            let mut file = File::open(&path).unwrap();
            kept.compare(&mut file, &path, b"head", 2, |_, _| ())
        };
        compare(b"headabcdefgh").unwrap();
        for (bytes, words) in [
            (&b"heAdabcdefgh"[..], "the header, from byte 0"),
            (b"headab\0defgh", "piece 0, from byte 4"),
            (b"headabcd\0\0\0\0", "piece 1, from byte 8"),
            (b"headabcdefg", "piece 1, from byte 8"),
            (b"headabcdefghi", "its end, from byte 12"),
            (b"", "the header, from byte 0"),
        ] {
            let error = compare(bytes).unwrap_err();
            assert!(matches!(error, Error::Differs { .. }));
            assert!(error.to_string().contains(words), "{error}");
        }
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
