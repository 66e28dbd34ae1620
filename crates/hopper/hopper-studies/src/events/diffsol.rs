//! The program that uses diffsol. It is a package outside the workspace.

use crate::error::Error;
use crate::peers::call;
use crate::repository::repository;
use std::path::Path;

/// The package.
const PACKAGE: &str = "crates/hopper/hopper-studies/peers-diffsol";

/// Builds the program in `folder` and runs it with these files. It writes its results to the first one.
///
/// # Errors
/// [`Error::Peers`] if its packages cannot be had, or if it fails.
pub(crate) fn run_diffsol(folder: &Path, files: &[&Path]) -> Result<(), Error> {
    let manifest = repository().join(PACKAGE).join("Cargo.toml");
    let target = folder.join("diffsol");
    let text = |path: &Path| path.to_string_lossy().into_owned();
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let build = ["build", "--quiet", "--release", "--manifest-path", &text(&manifest)];
    let build: Vec<_> =
        build.into_iter().chain(["--target-dir", &text(&target)]).map(str::to_owned).collect();
    call(Path::new(&cargo), &build, "the program with diffsol could not be built")?;
    let program =
        target.join("release").join(format!("peers-diffsol{}", std::env::consts::EXE_SUFFIX));
    let files: Vec<_> = files.iter().map(|file| text(file)).collect();
    call(&program, &files, "the program with diffsol failed")
}
