//! The modules of a crate, by the files that hold them.

use super::sources::Source;

/// A module of a crate: its path from the crate's root, and its file.
#[derive(Debug, Clone)]
pub(super) struct Module<'a> {
    /// `["map", "orbit"]` for `crate::map::orbit`; empty for the root.
    pub(super) path: Vec<&'a str>,
    pub(super) source: &'a Source,
}

impl Module<'_> {
    /// The crate's root: `lib.rs`, or `main.rs` in a package without a library.
    pub(super) fn is_root(&self) -> bool {
        self.path.is_empty()
    }
}

/// The modules of a package's library; of its program, if it has no library.
///
/// Beside a library the programs, `main.rs` and `bin/`, are crates of their own: they import it by its name.
pub(super) fn modules(files: &[Source]) -> Vec<Module<'_>> {
    let inside = |source: &Source| source.in_src().map(str::to_owned);
    let has_library = files.iter().any(|source| inside(source).as_deref() == Some("lib.rs"));
    let library = |source: &&Source| {
        let is_program = |file: &str| file.starts_with("bin/") || has_library && file == "main.rs";
        inside(source).is_some_and(|file| !is_program(&file))
    };
    let module = |source| Module { path: path_of(source), source };
    files.iter().filter(library).map(module).collect()
}

/// The module path of a file: `src/map/orbit.rs` and `src/map/orbit/mod.rs` are both `map::orbit`.
fn path_of(source: &Source) -> Vec<&str> {
    let file = source.in_src().unwrap_or_default().trim_end_matches(".rs");
    let mut path: Vec<&str> = file.split('/').collect();
    if path.last() == Some(&"mod") || path == ["lib"] || path == ["main"] {
        path.pop();
    }
    path
}

/// The module that defines what `path` names: the longest part of the path that is a module.
pub(super) fn module_of<'m, 's>(
    modules: &'m [Module<'s>],
    path: &[String],
) -> Option<&'m Module<'s>> {
    let is = |module: &&Module, length: usize| {
        module.path.len() == length && module.path.iter().zip(path).all(|(a, b)| a == b)
    };
    (0..=path.len()).rev().find_map(|length| modules.iter().find(|module| is(module, length)))
}

#[cfg(test)]
pub(super) mod planted {
    use super::Source;

    /// Files of a crate `x`, by their names in `src`.
    pub(in super::super) fn files(files: &[(&str, &str)]) -> Vec<Source> {
        let source =
            |&(name, text): &(&str, &str)| Source::new(&format!("crates/x/src/{name}"), text);
        files.iter().map(source).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_modules_and_paths_lead_to_them() {
        let files = planted::files(&[
            ("lib.rs", ""),
            ("main.rs", ""),
            ("map/mod.rs", ""),
            ("map/orbit.rs", ""),
            ("error.rs", ""),
        ]);
        let modules = modules(&files);
        assert_eq!(modules.len(), 4); // not main.rs
        let file = |path: &[&str]| {
            let path: Vec<String> = path.iter().map(|name| (*name).to_owned()).collect();
            module_of(&modules, &path).map(|module| module.source.name.clone())
        };
        assert_eq!(file(&["map", "orbit", "Orbit"]).as_deref(), Some("crates/x/src/map/orbit.rs"));
        assert_eq!(file(&["map", "Map"]).as_deref(), Some("crates/x/src/map/mod.rs"));
        assert_eq!(file(&["Error"]).as_deref(), Some("crates/x/src/lib.rs"));
    }
}
