//! The folder of the explorer: its page, and the core compiled to WebAssembly.

use crate::error::Error;
use crate::process::{cargo, step, succeeds};
use crate::repository::repository;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The target of the core.
const TARGET: &str = "wasm32-unknown-unknown";

/// The command that installs it.
pub(crate) const INSTALL: &str = "rustup target add wasm32-unknown-unknown";

/// Flags of the compiler for the page's core.
///
/// - simd128: two doubles at a time, for which a tile takes four fifths of the time. All browsers have had it since
///   2023.
/// - inline-threshold: at the level of the profile the compiler inlines next to nothing. With 40 a tile takes four
///   fifths of the time. With 30 it takes as long as with 40, and the core has 1 kB less.
/// - compress-relocations: numbers of functions as short as they are, 2 % of the bytes.
const FLAGS: (&str, &str) = (
    "CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUSTFLAGS",
    "-C target-feature=+simd128 -C llvm-args=-inline-threshold=30 -C link-arg=--compress-relocations",
);

/// The modules of the page: what it needs for its first picture, and what is loaded when it is asked for.
const CORES: [(&str, &[&str]); 3] = [
    ("core.wasm", &["--no-default-features"]),
    ("deep.wasm", &[]),
    ("systems.wasm", &["--no-default-features", "--features", "systems"]),
];

/// The profile in the manifest.
const PROFILE: &str = "page";

/// Where builds go: the variable of cargo, or its usual folder.
pub(crate) fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| repository().join("target"), PathBuf::from)
}

/// The manifest of the explorer's core.
pub(crate) fn manifest() -> PathBuf {
    repository().join("crates/hopper/hopper-explorer/Cargo.toml")
}

/// Whether the target's standard library is here; if not, rustup is asked to install it.
pub(crate) fn target_is_here() -> bool {
    let here = || {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let found =
            Command::new(rustc).args(["--print", "target-libdir", "--target", TARGET]).output();
        found.is_ok_and(|out| Path::new(String::from_utf8_lossy(&out.stdout).trim()).exists())
    };
    here() || (succeeds(Command::new("rustup").args(["target", "add", TARGET])) && here())
}

/// Builds the cores and copies them with the page into a folder.
pub(crate) fn build(folder: &Path) -> Result<(), Error> {
    if !target_is_here() {
        return Err(Error::new(format!(
            "the target {TARGET} is missing and could not be installed; run `{INSTALL}`"
        )));
    }
    std::fs::create_dir_all(folder).map_err(Error::at(folder))?;
    for (name, features) in CORES {
        core(&folder.join(name), features)?;
    }
    for page in page_files()? {
        let to = folder.join(page.file_name().unwrap_or_default());
        let text = std::fs::read_to_string(&page).map_err(Error::at(&page))?;
        std::fs::write(&to, without_comments(&text)).map_err(Error::at(&to))?;
    }
    Ok(())
}

/// Builds the core with these arguments of cargo, and copies it.
fn core(to: &Path, features: &[&str]) -> Result<(), Error> {
    let target = target_folder();
    let mut command = Command::new(cargo());
    // Of the crate's two types only this one: with a Rust library beside it the linker does not see the crates as one.
    command.args(["rustc", "--quiet", "--lib", "--crate-type", "cdylib", "--locked"]);
    command.args(["--profile", PROFILE, "--target", TARGET]).args(features);
    command.arg("--manifest-path").arg(manifest()).arg("--target-dir").arg(&target);
    command.env(FLAGS.0, FLAGS.1);
    step(&mut command, "the explorer's core")?;
    let built = target.join(TARGET).join(PROFILE).join("hopper_explorer.wasm");
    std::fs::copy(built, to).map_err(Error::at(to))?;
    Ok(())
}

/// A file of the page without lines that are comments and without indentation: a seventh less to load.
fn without_comments(text: &str) -> String {
    let is_comment =
        |line: &str| line.starts_with("//") || (line.starts_with("/*") && line.ends_with("*/"));
    let lines = text.lines().map(str::trim).filter(|line| !is_comment(line));
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// The files of the page.
pub(crate) fn page_files() -> Result<Vec<PathBuf>, Error> {
    let path = repository().join("crates/hopper/hopper-explorer/page");
    let at = Error::at(&path);
    let entries = std::fs::read_dir(&path).map_err(&at)?;
    let mut files =
        entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<_>, _>>().map_err(at)?;
    files.sort();
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_file_of_the_page_works_offline() {
        let files = page_files().unwrap();
        let worker = files.iter().find(|file| file.ends_with("sw.js")).unwrap();
        let kept = std::fs::read_to_string(worker).unwrap();
        for file in files.iter().filter(|file| !file.ends_with("sw.js")) {
            let name = file.file_name().unwrap().to_string_lossy();
            assert!(kept.contains(&format!("\"{name}\"")), "{name} is not in the list of sw.js");
        }
    }

    #[test]
    fn lines_that_are_comments_are_left_out() {
        let text = "// What.\n/** Why. */\nif (a) {\n  b(\"//\"); // here\n\n}\n";
        assert_eq!(without_comments(text), "if (a) {\nb(\"//\"); // here\n\n}\n");
    }

    #[test]
    fn a_file_of_the_page_is_short() {
        for file in page_files().unwrap() {
            let lines = std::fs::read_to_string(&file).unwrap().lines().count();
            assert!(lines <= 400, "{} has {lines} lines: one concept a file", file.display());
        }
    }
}
