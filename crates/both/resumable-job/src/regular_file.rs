//! Reading a file that may be none.

use crate::error::Error;
use std::io::ErrorKind;
use std::path::Path;

/// What a name has.
#[derive(Debug, PartialEq, Eq)]
pub enum Contents {
    /// The bytes of a regular file, or of one to which a link leads.
    Bytes(Vec<u8>),
    /// No file.
    Missing,
    /// A folder, a named pipe, a device: opening a pipe would wait for a writer, for ever.
    NoFile,
}

/// The contents of a regular file.
///
/// # Errors
/// [`Error::File`] if it cannot be read.
pub fn read_regular(path: &Path) -> Result<Contents, Error> {
    let missing = |error: std::io::Error| match error.kind() {
        ErrorKind::NotFound => Ok(Contents::Missing),
        _ => Err(Error::at(path)(error)),
    };
    // Asked before the file is opened.
    match std::fs::metadata(path) {
        Ok(data) if data.is_file() => std::fs::read(path).map(Contents::Bytes).or_else(missing),
        Ok(_) => Ok(Contents::NoFile),
        Err(error) => missing(error),
    }
}
