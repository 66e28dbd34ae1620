//! The files that the rules look at.

use crate::error::Error;
use std::path::Path;

/// A Rust file or a manifest.
#[derive(Debug, Clone)]
pub(super) struct Source {
    /// Path from the root, with `/` between folders.
    pub(super) name: String,
    /// Contents.
    pub(super) text: String,
}

impl Source {
    /// The folder of the package: `crates/NAME`, or `xtask`.
    pub(super) fn package(&self) -> &str {
        let folders = if self.name.starts_with("crates/") { 2 } else { 1 };
        self.name.match_indices('/').nth(folders - 1).map_or(&self.name, |(at, _)| &self.name[..at])
    }

    /// The crate's name, if the file is in `crates/`.
    pub(super) fn crate_name(&self) -> Option<&str> {
        self.package().strip_prefix("crates/")
    }

    /// The path inside `src`, if the file is Rust and part of a library or program there.
    pub(super) fn in_src(&self) -> Option<&str> {
        let inside = self.name.strip_prefix(self.package())?.strip_prefix("/src/")?;
        inside.ends_with(".rs").then_some(inside)
    }
}

/// All Rust files and manifests in `crates` and `xtask`, sorted by name.
pub(super) fn collect(root: &Path) -> Result<Vec<Source>, Error> {
    let mut names = Vec::new();
    for folder in ["crates", "xtask"] {
        collect_in(root, folder, &mut names)?;
    }
    names.sort();
    names.iter().map(|name| read(root, name)).collect()
}

fn collect_in(root: &Path, folder: &str, names: &mut Vec<String>) -> Result<(), Error> {
    let path = root.join(folder);
    let at = |source| Error::File { path: path.clone(), source };
    for entry in std::fs::read_dir(&path).map_err(at)? {
        let entry = entry.map_err(at)?;
        let file = entry.file_name().to_string_lossy().into_owned();
        let name = format!("{folder}/{file}");
        if entry.path().is_dir() {
            // Build results: a fuzz crate has a `target` of its own.
            if file != "target" {
                collect_in(root, &name, names)?;
            }
        } else if name.ends_with(".rs") || name.ends_with(".toml") {
            names.push(name);
        }
    }
    Ok(())
}

/// The file of that name.
pub(super) fn read(root: &Path, name: &str) -> Result<Source, Error> {
    let path = root.join(name);
    let text = std::fs::read_to_string(&path).map_err(|source| Error::File { path, source })?;
    Ok(Source { name: name.to_owned(), text })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_knows_its_package() {
        let source = |name: &str| Source { name: name.into(), text: String::new() };
        let library = source("crates/return-map/src/orbit/mod.rs");
        assert_eq!(library.package(), "crates/return-map");
        assert_eq!(library.crate_name(), Some("return-map"));
        assert_eq!(library.in_src(), Some("orbit/mod.rs"));
        let test = source("crates/return-map/tests/src/x.rs");
        assert_eq!((test.package(), test.in_src()), ("crates/return-map", None));
        let task = source("xtask/src/main.rs");
        assert_eq!((task.package(), task.crate_name()), ("xtask", None));
        assert_eq!(task.in_src(), Some("main.rs"));
    }
}
