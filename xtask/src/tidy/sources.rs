//! The files that the rules check.

use crate::error::Error;
use std::path::Path;

/// A Rust file or a manifest.
#[derive(Debug, Clone)]
pub(super) struct Source {
    /// Path from the root, with `/` between folders.
    pub(super) name: String,
    /// Contents.
    pub(super) text: String,
    /// Whether the whole file is a test: its parent declares it as `#[cfg(test)] mod NAME;`.
    pub(super) is_test: bool,
}

impl Source {
    /// The folder of the package: `crates/WING/NAME`, or `xtask`.
    pub(super) fn package(&self) -> &str {
        let folders = if self.name.starts_with("crates/") { 3 } else { 1 };
        self.name.match_indices('/').nth(folders - 1).map_or(&self.name, |(at, _)| &self.name[..at])
    }

    /// The crate's name, if the file is in `crates/`.
    pub(super) fn crate_name(&self) -> Option<&str> {
        Some(self.package().strip_prefix("crates/")?.split_once('/')?.1)
    }

    /// The path inside `src`, if the file is Rust and part of a library or program there.
    pub(super) fn in_src(&self) -> Option<&str> {
        let inside = self.name.strip_prefix(self.package())?.strip_prefix("/src/")?;
        inside.ends_with(".rs").then_some(inside)
    }
}

impl Source {
    /// A file that is no test.
    pub(super) fn new(name: &str, text: &str) -> Self {
        Source { name: name.to_owned(), text: text.to_owned(), is_test: false }
    }

    /// The lines of the file that are not tests, each with its number from one. They end before `#[cfg(test)]` and `mod
    /// tests {`, which end a file.
    pub(super) fn lines_before_tests(&self) -> impl Iterator<Item = (usize, &str)> {
        let mut lines = (1..).zip(self.text.lines()).peekable();
        let is_test = self.is_test;
        std::iter::from_fn(move || {
            let (at, line) = lines.next().filter(|_| !is_test)?;
            let next = lines.peek().map_or("", |(_, next)| next);
            // A declaration such as `#[cfg(test)] mod planted;` does not end the file: code may follow.
            let ends =
                line.starts_with("#[cfg(test)]") && next.contains("mod ") && next.ends_with('{');
            (!ends).then_some((at, line))
        })
        .fuse()
    }

    /// The names of the files that this one declares as tests.
    fn test_modules(&self) -> Vec<String> {
        let folder = match self.name.rsplit_once('/') {
            Some((folder, "mod.rs" | "lib.rs" | "main.rs")) => folder.to_owned(),
            _ => self.name.trim_end_matches(".rs").to_owned(),
        };
        let pairs = self.text.lines().zip(self.text.lines().skip(1));
        let declared = pairs.filter(|(line, _)| line.trim() == "#[cfg(test)]");
        let name = |(_, next): (&str, &str)| {
            next.trim().strip_suffix(';')?.rsplit_once("mod ").map(|(_, name)| name.to_owned())
        };
        declared
            .filter_map(name)
            .flat_map(|name| [format!("{folder}/{name}.rs"), format!("{folder}/{name}/mod.rs")])
            .collect()
    }
}

/// All Rust files and manifests in `crates` and `xtask`, sorted by name.
pub(super) fn collect(root: &Path) -> Result<Vec<Source>, Error> {
    let mut names = Vec::new();
    for folder in ["crates", "xtask"] {
        collect_in(
            root,
            folder,
            &|name| name.ends_with(".rs") || name.ends_with(".toml"),
            &mut names,
        )?;
    }
    names.sort();
    let mut sources: Vec<Source> =
        names.iter().map(|name| read(root, name)).collect::<Result<_, _>>()?;
    mark_tests(&mut sources);
    Ok(sources)
}

/// `README.md` and all Markdown files in `crates`, `docs` and `xtask`, sorted by name.
pub(super) fn documents(root: &Path) -> Result<Vec<Source>, Error> {
    let mut names = vec!["README.md".to_owned()];
    for folder in ["crates", "docs", "xtask"] {
        collect_in(root, folder, &|name| name.ends_with(".md"), &mut names)?;
    }
    names.sort();
    names.iter().map(|name| read(root, name)).collect()
}

/// Whether a document is a page for readers: `README.md`, a page in `docs`, or a page beside the code it explains.
pub(super) fn is_page(document: &Source) -> bool {
    let name = &document.name;
    let beside_code =
        name.starts_with("crates/") && name.contains("/src/") && name.ends_with("/README.md");
    name == "README.md" || name.starts_with("docs/") || beside_code
}

/// Marks the files that others declare as tests.
fn mark_tests(sources: &mut [Source]) {
    let tests: Vec<String> = sources.iter().flat_map(Source::test_modules).collect();
    sources.iter_mut().for_each(|source| source.is_test = tests.contains(&source.name));
}

fn collect_in(
    root: &Path,
    folder: &str,
    chosen: &impl Fn(&str) -> bool,
    names: &mut Vec<String>,
) -> Result<(), Error> {
    let path = root.join(folder);
    let at = Error::at(&path);
    for entry in std::fs::read_dir(&path).map_err(&at)? {
        let entry = entry.map_err(&at)?;
        let file = entry.file_name().to_string_lossy().into_owned();
        let name = format!("{folder}/{file}");
        if entry.path().is_dir() {
            // Build results: a fuzz crate has its own `target`.
            if file != "target" {
                collect_in(root, &name, chosen, names)?;
            }
        } else if chosen(&name) {
            names.push(name);
        }
    }
    Ok(())
}

/// The file of that name.
pub(super) fn read(root: &Path, name: &str) -> Result<Source, Error> {
    let path = root.join(name);
    let text = std::fs::read_to_string(&path).map_err(Error::at(path))?;
    Ok(Source::new(name, &text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_knows_its_package() {
        let source = |name: &str| Source::new(name, "");
        let library = source("crates/any-system/return-map/src/orbit/mod.rs");
        assert_eq!(library.package(), "crates/any-system/return-map");
        assert_eq!(library.crate_name(), Some("return-map"));
        assert_eq!(library.in_src(), Some("orbit/mod.rs"));
        let test = source("crates/any-system/return-map/tests/src/x.rs");
        assert_eq!((test.package(), test.in_src()), ("crates/any-system/return-map", None));
        let task = source("xtask/src/main.rs");
        assert_eq!((task.package(), task.crate_name()), ("xtask", None));
        assert_eq!(task.in_src(), Some("main.rs"));
    }

    #[test]
    fn tests_are_left_out() {
        let text = "a\n#[cfg(test)]\nmod planted;\nb\n#[cfg(test)]\nmod tests {\n    c\n}\n";
        let mut sources = [
            Source::new("crates/both/x/src/y.rs", text),
            Source::new("crates/both/x/src/y/planted.rs", "d\n"),
        ];
        let lines = |source: &Source| {
            source.lines_before_tests().map(|(at, line)| format!("{at} {line}")).collect::<Vec<_>>()
        };
        assert_eq!(lines(&sources[0]), ["1 a", "2 #[cfg(test)]", "3 mod planted;", "4 b"]);
        assert_eq!(lines(&sources[1]), ["1 d"]);
        mark_tests(&mut sources);
        assert_eq!(lines(&sources[1]), [""; 0]);
    }
}
