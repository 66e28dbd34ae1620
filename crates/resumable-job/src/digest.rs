//! Digests that identify bytes, and builds of a program.

use crate::error::Error;
use std::path::Path;

/// The 64-bit FNV-1a digest of some bytes, as 16 hexadecimal digits.
///
/// A test of the lift-off map hashes a million results with a variant of its own. It takes a 64-bit word in a step, where
/// this function takes a byte, and so gives other digests.
pub fn digest(bytes: &[u8]) -> String {
    // Offset basis and prime of the 64-bit variant: RFC 9923, section 5.
    const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0000_0100_0000_01b3;
    let step = |hash: u64, &byte: &u8| (hash ^ u64::from(byte)).wrapping_mul(PRIME);
    format!("{:016x}", bytes.iter().fold(BASIS, step))
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
    fn the_same_build_has_the_same_digest() {
        assert_eq!(program_digest().unwrap(), program_digest().unwrap());
    }
}
