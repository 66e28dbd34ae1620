//! `tidy`: the rules of the repository.

use crate::Error;
use crate::output::{read, repository};
use std::path::{Path, PathBuf};

/// Crates that must not know the hopper.
const GENERIC: [&str; 3] = ["hybrid-system", "return-map", "basin-of-attraction"];
/// Calls of loops that are compiled for wider vectors.
const WITH_UNSAFE_CODE: &str = "crates/passive-hopper/src/kernel/batch/simd.rs";
/// A file holds one concept.
const LONGEST_FILE: usize = 400;

/// A breach of a rule.
#[derive(Debug, Clone, PartialEq)]
pub struct Breach {
    /// File, relative to the root.
    pub file: PathBuf,
    /// Line, from one; zero for the whole file.
    pub line: usize,
    /// What is wrong, and what to do.
    pub rule: String,
}

/// Prints every breach.
pub fn run() -> Result<(), Error> {
    let breaches = breaches(&repository())?;
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    for breach in &breaches {
        writeln!(out, "{}:{}: {}", breach.file.display(), breach.line, breach.rule)
            .map_err(|source| Error::File { path: "standard output".into(), source })?;
    }
    match breaches.len() {
        0 => Ok(()),
        count => Err(Error::CheckFailed(format!("{count} breaches of the repository's rules"))),
    }
}

/// All breaches in the repository at `root`.
pub fn breaches(root: &Path) -> Result<Vec<Breach>, Error> {
    let mut breaches = Vec::new();
    let mut files = Vec::new();
    for folder in ["crates", "xtask"] {
        collect(&root.join(folder), &mut files)?;
    }
    files.sort();
    for path in files {
        let file = path.strip_prefix(root).unwrap_or(&path).to_path_buf();
        check_file(&file, &read(&path)?, &mut breaches);
    }
    check_root(root, &mut breaches)?;
    Ok(breaches)
}

fn collect(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), Error> {
    let at = |source| Error::File { path: folder.into(), source };
    for entry in std::fs::read_dir(folder).map_err(at)? {
        let path = entry.map_err(at)?.path();
        if path.is_dir() && path.file_name().is_some_and(|name| name != "target") {
            collect(&path, files)?;
        } else if path.extension().is_some_and(|e| e == "rs" || e == "toml") {
            files.push(path);
        }
    }
    Ok(())
}

fn check_file(file: &Path, text: &str, breaches: &mut Vec<Breach>) {
    let name = file.to_string_lossy().replace('\\', "/");
    let is_rust = name.ends_with(".rs");
    let in_crate = name.strip_prefix("crates/").and_then(|rest| rest.split('/').next());
    let is_library = in_crate.is_some() && name.contains("/src/") && is_rust;
    let mut breach = |line: usize, rule: &str| {
        breaches.push(Breach { file: file.to_path_buf(), line, rule: rule.to_owned() });
    };
    if is_rust && text.lines().count() > LONGEST_FILE {
        breach(0, "over 400 lines: one concept a file");
    }
    if is_library && !text.starts_with("//!") {
        breach(1, "a library file starts with what it holds: //!");
    }
    // The fuzz targets are no part of the workspace: they need another compiler.
    if name.ends_with("Cargo.toml") && !name.contains("/fuzz/") {
        let mut in_dependencies = false;
        for (index, line) in text.lines().enumerate() {
            if line.starts_with('[') {
                in_dependencies = line.ends_with("dependencies]");
            } else if in_dependencies && line.contains('=') && !line.contains("workspace = true") {
                breach(index + 1, "versions live in the workspace table");
            }
        }
        return;
    }
    // Tests at the end of a file may do what libraries may not.
    let mut in_tests = false;
    for (index, line) in text.lines().enumerate() {
        let at = index + 1;
        in_tests |= line.starts_with("#[cfg(test)]");
        let code = line.trim_start();
        let comment = code.starts_with("//");
        if in_crate.is_some_and(|name| GENERIC.contains(&name))
            && line.to_lowercase().contains("hopper")
        {
            breach(at, "a generic crate does not know the hopper");
        }
        if ["TODO", "FIXME", "XXX"].iter().any(|word| line.contains(word))
            && !name.ends_with("tidy.rs")
        {
            breach(at, "unfinished: finish it, or file an issue");
        }
        if !is_library || comment || in_tests {
            continue;
        }
        if ["print!(", "println!(", "eprint!(", "eprintln!(", "dbg!("]
            .iter()
            .any(|m| code.contains(m))
        {
            breach(at, "libraries do not print");
        }
        if ["std::fs", "std::env", "std::net", "std::process", "rand::", "SystemTime", "Instant"]
            .iter()
            .any(|m| code.contains(m))
        {
            breach(at, "libraries read no files, clocks, environment or random numbers");
        }
        if [
            ".unwrap()",
            ".expect(",
            "panic!(",
            "unreachable!(",
            "todo!(",
            "unimplemented!(",
            "assert!(",
            "assert_eq!(",
        ]
        .iter()
        .any(|m| code.contains(m))
        {
            breach(at, "libraries return errors as values");
        }
        if (code.contains("unsafe ") || code.contains("unsafe{") || code.contains("unsafe_code"))
            && name != WITH_UNSAFE_CODE
        {
            breach(at, "unsafe code is in passive-hopper/src/kernel/batch/simd.rs alone");
        }
        if code.contains("roots::")
            && !name.ends_with("hybrid-system/src/crossing/bracketed_root.rs")
        {
            breach(at, "only hybrid-system/src/crossing/bracketed_root.rs uses the roots crate");
        }
    }
}

fn check_root(root: &Path, breaches: &mut Vec<Breach>) -> Result<(), Error> {
    const KNOWN: [&str; 8] =
        ["Cargo.toml", "Cargo.lock", "LICENSE", "README.md", "crates", "xtask", "docs", "target"];
    let at = |source| Error::File { path: root.into(), source };
    for entry in std::fs::read_dir(root).map_err(at)? {
        let name = entry.map_err(at)?.file_name().to_string_lossy().into_owned();
        if !name.starts_with('.') && !KNOWN.contains(&name.as_str()) {
            breaches.push(Breach {
                file: name.into(),
                line: 0,
                rule: "does not belong in the root".into(),
            });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(file: &str, text: &str) -> Vec<String> {
        let mut breaches = Vec::new();
        check_file(Path::new(file), text, &mut breaches);
        breaches.into_iter().map(|breach| breach.rule).collect()
    }

    #[test]
    fn the_repository_is_tidy() {
        assert_eq!(breaches(&repository()).unwrap(), []);
    }

    #[test]
    fn breaches_are_found() {
        let generic = "crates/return-map/src/x.rs";
        assert_eq!(
            rules(generic, "//! Of the Hopper.\n"),
            ["a generic crate does not know the hopper"]
        );
        assert_eq!(
            rules(generic, "//! X.\nlet y = x.unwrap();\n"),
            ["libraries return errors as values"]
        );
        assert_eq!(rules(generic, "//! X.\nuse roots::find_root_brent;\n").len(), 1);
        assert_eq!(rules(generic, "//! X.\nprintln!(\"{x}\");\n").len(), 1);
        assert_eq!(rules(generic, "//! X.\n#![allow(unsafe_code)]\nunsafe { x() };\n").len(), 2);
        assert!(rules(WITH_UNSAFE_CODE, "//! X.\nunsafe { x() };\n").is_empty());
        assert_eq!(rules("crates/x/Cargo.toml", "[dependencies]\nserde = \"1\"\n").len(), 1);
        assert!(rules("xtask/src/x.rs", &"\n".repeat(401)).len() == 1);
        assert!(rules(generic, "//! X.\n/// x.unwrap()\n#[cfg(test)]\nassert!(x);\n").is_empty());
    }
}
