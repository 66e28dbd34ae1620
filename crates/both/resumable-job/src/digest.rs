//! Digests that identify bytes, and builds of a program.

use crate::error::Error;
use std::fs::File;
use std::io::{ErrorKind, Read};
use std::path::Path;

/// Offset basis and prime of the 64-bit variant: RFC 9923, section 5.
const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0000_0100_0000_01b3;

/// Bytes of a file that are in memory at once.
const BUFFER: usize = 1 << 16;

/// The 64-bit FNV-1a digest of some bytes, as 16 hexadecimal digits.
///
/// A test of the lift-off map hashes a million results with a variant of its own. It takes a 64-bit word in a step,
/// where this function takes a byte, and so gives other digests.
pub fn digest(bytes: &[u8]) -> String {
    text(appended(BASIS, bytes))
}

/// The [`digest`] of a file, which need not fit in memory.
///
/// # Errors
/// [`Error::File`] if it cannot be read.
pub fn file_digest(path: &Path) -> Result<String, Error> {
    let mut file = File::open(path).map_err(Error::at(path))?;
    let (mut hash, mut buffer) = (BASIS, vec![0; BUFFER]);
    loop {
        match file.read(&mut buffer) {
            Ok(0) => return Ok(text(hash)),
            Ok(count) => hash = appended(hash, &buffer[..count]),
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(Error::at(path)(error)),
        }
    }
}

fn appended(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

fn text(hash: u64) -> String {
    format!("{hash:016x}")
}

/// A digest that distinguishes this build of the running program from other builds.
///
/// The digest is computed from the size of the program's file and the time at which it was written. Reading the whole
/// file would cost more and give no more information: a new build writes the file anew.
pub fn program_digest() -> Result<String, Error> {
    let fail = Error::at(Path::new("this program"));
    let identity = std::env::current_exe().and_then(std::fs::metadata).and_then(|data| {
        let written = data.modified()?;
        Ok(format!("{} {written:?}", data.len()))
    });
    Ok(digest(identity.map_err(fail)?.as_bytes()))
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
    fn the_digest_of_a_file_is_that_of_its_bytes() {
        let path = std::env::temp_dir().join(format!("resumable_digest_{}", std::process::id()));
        for length in [0, 1, BUFFER - 1, BUFFER, 3 * BUFFER + 7] {
            let bytes: Vec<u8> = (0..length).map(|at| (at * at % 251) as u8).collect();
            std::fs::write(&path, &bytes).unwrap();
            assert_eq!(file_digest(&path).unwrap(), digest(&bytes), "{length}");
        }
        std::fs::remove_file(&path).unwrap();
        assert!(file_digest(&path).is_err());
    }

    #[test]
    fn the_same_build_has_the_same_digest() {
        assert_eq!(program_digest().unwrap(), program_digest().unwrap());
    }
}
