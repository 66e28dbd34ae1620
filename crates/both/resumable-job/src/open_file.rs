//! Whether a name still belongs to an open file.
//!
//! A process can open a file, and another process can remove or replace the file before the first one locks it. The
//! lock then belongs to a file without a name and protects nothing. Therefore the name is checked after each lock.

use std::fs::File;
use std::io;
use std::path::Path;

/// True if `path` names the open `file` itself; false if the name is gone or names another file.
pub(crate) fn is_named(file: &File, path: &Path) -> io::Result<bool> {
    match std::fs::metadata(path) {
        Ok(named) => is_same(file, &named),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(false),
        Err(error) => Err(error),
    }
}

#[cfg(unix)]
fn is_same(file: &File, named: &std::fs::Metadata) -> io::Result<bool> {
    use std::os::unix::fs::MetadataExt;
    let open = file.metadata()?;
    Ok((open.dev(), open.ino()) == (named.dev(), named.ino()))
}

/// Without inode numbers only the existence of the name is checked. Lock files are not removed on such systems
/// (`lock.rs`).
#[cfg(not(unix))]
fn is_same(_: &File, _: &std::fs::Metadata) -> io::Result<bool> {
    Ok(true)
}
