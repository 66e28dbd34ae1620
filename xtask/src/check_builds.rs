//! `cargo xtask check-builds`: builds that `cargo test --workspace` does not try.
//!
//! In a build of the whole workspace, a crate has the features that any other crate asks for. It may therefore rest
//! on a feature that its own manifest does not name. This command checks
//!
//! - each crate alone: its library as another project gets it, and all its targets; with and without its features;
//! - the code of the fuzz targets, each of which is a workspace of its own;
//! - the whole workspace with the oldest Rust that `Cargo.toml` promises.
//!
//! The last two need a package and a toolchain that may be missing. The command then prints a line that begins with
//! SKIPPED.

use crate::error::Error;
use crate::process::{cargo, say, skip, succeeds};
use crate::repository::repository;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::time::Instant;

/// The packages of the fuzz targets.
const FUZZ: [&str; 2] = ["crates/any-system/hybrid-system/fuzz", "crates/hopper/hopper-basin/fuzz"];

/// A build to try.
struct Build {
    name: String,
    /// Arguments after `cargo`.
    arguments: Vec<OsString>,
    /// A variable of the environment.
    variable: Option<(&'static str, &'static str)>,
}

/// Tries all builds; an error if one fails.
pub(crate) fn run() -> Result<ExitCode, Error> {
    let root = repository();
    let read = |path: PathBuf| std::fs::read_to_string(&path).map_err(Error::at(path));
    let manifest = read(root.join("Cargo.toml"))?;
    let mut builds = Vec::new();
    for folder in members(&manifest) {
        let package = read(root.join(&folder).join("Cargo.toml"))?;
        builds.extend(builds_alone(folder.rsplit('/').next().unwrap_or(&folder), &package));
    }
    for folder in FUZZ {
        builds.extend(fuzz_target(&root, folder)?);
    }
    builds.extend(oldest_rust(&root, &manifest)?);
    let failed = builds.iter().map(try_build).collect::<Result<Vec<_>, _>>()?;
    match failed.iter().filter(|failed| **failed).count() {
        0 => Ok(ExitCode::SUCCESS),
        count => Err(Error::new(format!("{count} builds failed"))),
    }
}

/// Runs a build and prints its time; true if it fails. The messages of the compiler stand above the line.
fn try_build(build: &Build) -> Result<bool, Error> {
    let begin = Instant::now();
    // `rustup run` needs its own cargo. All other builds use the cargo that started this program.
    let program = if build.arguments[0] == "run" { OsString::from("rustup") } else { cargo() };
    let mut command = Command::new(&program);
    command.args(&build.arguments).envs(build.variable).current_dir(repository());
    let status = command.status().map_err(Error::starting(&program))?;
    let verdict = if status.success() { "ok" } else { "FAILED" };
    say(&format!("{verdict:6} {:6.1} s  {}", begin.elapsed().as_secs_f64(), build.name))?;
    Ok(!status.success())
}

/// The builds of one crate: its library and programs, then all targets, for each set of features.
///
/// The first build has no dependencies of tests, whose features would be added to those of the library.
fn builds_alone(name: &str, manifest: &str) -> Vec<Build> {
    let has_features = manifest.lines().any(|line| line.trim() == "[features]");
    let features: &[&[&str]] =
        if has_features { &[&["--no-default-features"], &["--all-features"]] } else { &[&[]] };
    let targets: &[&[&str]] = &[&[], &["--all-targets"]];
    let both = features.iter().flat_map(|features| targets.iter().map(move |t| (features, t)));
    both.map(|(features, targets)| {
        let arguments = [&["check", "--quiet", "--package", name], *features, *targets].concat();
        let options = [*features, *targets].concat().join(" ");
        Build {
            name: format!("{name} alone {options}").trim_end().to_owned(),
            arguments: arguments.into_iter().map(OsString::from).collect(),
            variable: None,
        }
    })
    .collect()
}

/// The members of the workspace.
fn members(manifest: &str) -> Vec<String> {
    let after = manifest.split_once("\nmembers = [").map_or("", |(_, after)| after);
    let list = after.split(']').next().unwrap_or_default();
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// The check of a fuzz target's code; `None` if its packages are not here and cannot be had.
fn fuzz_target(root: &Path, folder: &str) -> Result<Option<Build>, Error> {
    let name = format!("the fuzz target of {folder}");
    let folder = root.join(folder);
    // The fuzz crate has no committed lock file. With the workspace's own, it gets the versions that the tests use.
    let (from, to) = (root.join("Cargo.lock"), folder.join("Cargo.lock"));
    std::fs::copy(&from, &to).map_err(Error::at(to))?;
    let manifest = folder.join("Cargo.toml");
    let mut fetch = Command::new(cargo());
    if !succeeds(fetch.args(["fetch", "--quiet", "--manifest-path"]).arg(&manifest)) {
        skip(&name, "its packages cannot be had (cargo fetch fails in its folder)")?;
        return Ok(None);
    }
    let arguments = ["check", "--quiet", "--manifest-path"].map(OsString::from);
    Ok(Some(Build {
        name,
        arguments: arguments.into_iter().chain([manifest.into()]).collect(),
        // A check links nothing. With this variable the package does not build the fuzzer itself, which needs a C++
        // compiler.
        variable: Some(("CUSTOM_LIBFUZZER_PATH", "none/libfuzzer.a")),
    }))
}

/// The check of the workspace with the promised Rust; `None` if this toolchain is not installed.
fn oldest_rust(root: &Path, manifest: &str) -> Result<Option<Build>, Error> {
    let version = rust_version(manifest).ok_or_else(|| {
        Error::new("Cargo.toml has no rust-version; write the oldest Rust that is supported")
    })?;
    let mut probe = Command::new("rustup");
    if !succeeds(probe.args(["run", version, "rustc", "--version"])) {
        let what = format!("Rust {version}, the oldest that Cargo.toml promises");
        skip(&what, &format!("`rustup toolchain install {version}`"))?;
        return Ok(None);
    }
    let target =
        std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let arguments = ["run", version, "cargo", "check", "--quiet", "--workspace", "--all-targets"];
    // Its own folder, so that another `cargo` does not wait for this one.
    let folder = [OsString::from("--target-dir"), target.join("oldest-rust").into()];
    Ok(Some(Build {
        name: format!("the workspace with Rust {version}"),
        arguments: arguments.map(OsString::from).into_iter().chain(folder).collect(),
        variable: None,
    }))
}

/// The value of `rust-version`.
fn rust_version(manifest: &str) -> Option<&str> {
    manifest.lines().find_map(|line| line.strip_prefix("rust-version = \"")?.strip_suffix('"'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_manifest_tells_members_and_the_oldest_rust() {
        let manifest = std::fs::read_to_string(repository().join("Cargo.toml")).unwrap();
        let members = members(&manifest);
        assert!(members.contains(&"crates/any-system/hybrid-system".to_owned()), "{members:?}");
        assert!(members.iter().all(|m| repository().join(m).join("Cargo.toml").exists()));
        let version = rust_version(&manifest).unwrap();
        assert!(version.starts_with("1.") && version.len() > 3, "{version}");
    }

    #[test]
    fn a_crate_with_features_is_built_with_and_without_them() {
        let names = |manifest| -> Vec<String> {
            builds_alone("x", manifest).into_iter().map(|build| build.name).collect()
        };
        assert_eq!(names("[package]\n"), ["x alone", "x alone --all-targets"]);
        let both = names("[features]\node = []\n");
        assert_eq!(both.len(), 4, "{both:?}");
        assert!(both.contains(&"x alone --no-default-features --all-targets".to_owned()));
    }
}
