//! Where the repository is.

use std::path::{Path, PathBuf};

/// The root of the repository: the folder above the one in which this program was built.
pub(crate) fn repository() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.parent().unwrap_or(package).to_path_buf()
}
