//! Pieces joined to one file, which is compared with them before it gets its name.

use crate::atomic_file::AtomicFile;
use crate::error::Error;
use crate::pieces::{Pieces, StoredPiece};
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

impl Pieces {
    /// The payload of a piece that must be finished.
    ///
    /// # Errors
    /// [`Error::MissingPiece`], and [`Error::Piece`] for a damaged or foreign one.
    pub fn finished(&self, piece: usize) -> Result<Vec<u8>, Error> {
        match self.find(piece)? {
            StoredPiece::Finished(payload) => Ok(payload),
            StoredPiece::Missing => {
                let job = self.description().to_owned();
                Err(Error::MissingPiece { path: self.path(piece), job })
            }
            StoredPiece::Unusable(unusable) => Err(unusable.into()),
        }
    }

    /// Writes `header` and the payloads of the pieces 0 … `pieces` − 1 to the file `path`. Compares the written bytes
    /// with the pieces before the file gets its name.
    ///
    /// `go_on` is asked before each piece is written, and before it is compared: its error, such as a signal, ends
    /// the assembly. `look` receives each payload that agrees, in order, with its number.
    ///
    /// # Errors
    /// [`Error::MissingPiece`] if a piece is not finished; [`Error::Differs`] if the written file does not have the
    /// bytes of the pieces; the errors of `go_on`. After an error the pieces, and a file that had this name before,
    /// are unchanged.
    pub fn assemble<E: From<Error>>(
        &self,
        path: &Path,
        header: &[u8],
        pieces: usize,
        go_on: impl Fn() -> Result<(), E>,
        look: impl FnMut(usize, &[u8]),
    ) -> Result<(), E> {
        let mut file = AtomicFile::create(path)?;
        file.append(header)?;
        for piece in 0..pieces {
            go_on()?;
            file.append(&self.finished(piece)?)?;
        }
        file.finish_if(|written| self.compare(written, (path, header, pieces), go_on, look))
    }

    /// Reads a file from its start, and compares it with the header and all pieces.
    fn compare<E: From<Error>>(
        &self,
        written: &mut File,
        (path, header, pieces): (&Path, &[u8], usize),
        go_on: impl Fn() -> Result<(), E>,
        mut look: impl FnMut(usize, &[u8]),
    ) -> Result<(), E> {
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
            go_on()?;
            let payload = self.finished(piece)?;
            agree(&payload, &|| format!("piece {piece}"))?;
            look(piece, &payload);
        }
        let length = written.metadata().map_err(Error::at(path))?.len();
        if length != offset {
            let part = "its end".to_owned();
            return Err(Error::Differs { path: path.into(), part, offset }.into());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    fn no_signal() -> Result<(), Error> {
        Ok(())
    }

    fn folder(name: &str) -> PathBuf {
        let folder =
            std::env::temp_dir().join(format!("resumable_assembly_{name}_{}", std::process::id()));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn pieces_are_assembled_in_order() {
        let folder = folder("assembled");
        let kept = Pieces::open(&folder.join("pieces"), "a job").unwrap();
        for (piece, payload) in [&b"two "[..], b"", b"three"].into_iter().enumerate().rev() {
            kept.write(piece, payload).unwrap();
        }
        let (path, mut seen) = (folder.join("all"), Vec::new());
        let see = |piece: usize, payload: &[u8]| seen.push((piece, payload.len()));
        kept.assemble(&path, b"one ", 3, no_signal, see).unwrap();
        assert_eq!(std::fs::read(&path).unwrap(), b"one two three");
        assert_eq!(seen, [(0, 4), (1, 0), (2, 5)]);
        let missing = kept.assemble(&path, b"", 4, no_signal, |_, _| ()).unwrap_err();
        assert!(missing.to_string().contains("piece_000003"), "{missing}");
        // A signal at any time, while the pieces are written or compared.
        for after in 0..6 {
            let asked = std::cell::Cell::new(0);
            let signal = || {
                asked.set(asked.get() + 1);
                if asked.get() > after {
                    Err(Error::at(&path)(ErrorKind::Interrupted.into()))
                } else {
                    Ok(())
                }
            };
            kept.assemble(&path, b"", 3, signal, |_, _| ()).unwrap_err();
            assert_eq!(std::fs::read_dir(&folder).unwrap().count(), 2, "no file is left over");
        }
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
            kept.compare(&mut file, (&path, b"head", 2), no_signal, |_, _| ())
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
