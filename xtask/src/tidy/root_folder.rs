//! The root of the repository holds known names only.

use super::breach::Breach;
use crate::error::Error;
use std::path::Path;

/// Names that are allowed in the root, besides files whose name begins with a dot.
const KNOWN: [&str; 8] =
    ["Cargo.toml", "Cargo.lock", "LICENSE", "README.md", "crates", "xtask", "docs", "target"];

/// Every name in the root is known.
pub(super) fn check(root: &Path, breaches: &mut Vec<Breach>) -> Result<(), Error> {
    for name in names(root)? {
        if !name.starts_with('.') && !KNOWN.contains(&name.as_str()) {
            let rule = "does not belong in the root: documents go to docs, code to crates";
            breaches.push(Breach::new(&name, 0, rule));
        }
    }
    Ok(())
}

/// The folders in the wings of `crates` that have a manifest, as `WING/NAME`, sorted.
pub(super) fn crates(root: &Path) -> Result<Vec<String>, Error> {
    let folder = root.join("crates");
    let mut all = Vec::new();
    for wing in names(&folder)? {
        all.extend(names(&folder.join(&wing))?.into_iter().map(|name| format!("{wing}/{name}")));
    }
    all.retain(|name| folder.join(name).join("Cargo.toml").exists());
    all.sort();
    Ok(all)
}

fn names(folder: &Path) -> Result<Vec<String>, Error> {
    let at = Error::at(folder);
    let entries = std::fs::read_dir(folder).map_err(&at)?;
    entries
        .map(|entry| Ok(entry.map_err(&at)?.file_name().to_string_lossy().into_owned()))
        .collect()
}
