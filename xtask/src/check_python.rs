//! `cargo xtask check-python`: builds the Python package in an environment of its own, and runs its tests.
//!
//! It needs Python 3.10 or newer, a package index, and the crates that bind Rust to Python. If one of them cannot
//! be had, it prints a line that begins with SKIPPED.

use crate::error::Error;
use crate::process::{cargo, skip, step, succeeds};
use crate::python_environment::{call, environment_python, first_python};
use crate::repository::repository;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

/// Builds, installs, tests.
pub(crate) fn run() -> Result<ExitCode, Error> {
    let root = repository();
    let package = root.join("crates/both/python-package");
    let target = root.join("target/python");
    let python = first_python();
    if !succeeds(Command::new(&python).args(["-c", NEW_ENOUGH])) {
        return skip(
            PACKAGE,
            "Python 3.10 or newer is not there; name one with PYTHON=/path/to/python3",
        );
    }
    let mut fetch = Command::new(cargo());
    fetch.args(["fetch", "--quiet", "--locked", "--manifest-path"]).arg(package.join("Cargo.toml"));
    if !succeeds(&mut fetch) {
        return skip(
            PACKAGE,
            "its crates cannot be had (cargo fetch fails in crates/both/python-package)",
        );
    }
    let list = package.join("tests/requirements.txt");
    let Ok(inside) = environment_python(&python, &target.join("environment"), &list) else {
        return skip(
            PACKAGE,
            "the packages of its tests cannot be installed; its messages stand above",
        );
    };
    let mut install = Command::new(&inside);
    install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    install.args(["--no-build-isolation", "--no-deps", "--force-reinstall"]).arg(&package);
    // The build starts the program `maturin` of the environment.
    let programs = inside.parent().map(PathBuf::from);
    let path = std::env::var_os("PATH").unwrap_or_default();
    let all = programs.into_iter().chain(std::env::split_paths(&path));
    if let Ok(path) = std::env::join_paths(all) {
        install.env("PATH", path);
    }
    call(&inside, install.env("CARGO_TARGET_DIR", target.join("build")).current_dir(&root))?;
    let program = hopper_program()?;
    let mut tests = Command::new(&inside);
    tests.env("HOPPER_PROGRAM", program);
    // Without this, Python would write its compiled files into the repository.
    tests.args(["-m", "pytest", "-p", "no:cacheprovider"]).env("PYTHONDONTWRITEBYTECODE", "1");
    call(&inside, tests.current_dir(package))?;
    Ok(ExitCode::SUCCESS)
}

/// The program `hopper`, built: a test compares its files with those of the package.
fn hopper_program() -> Result<PathBuf, Error> {
    let mut build = Command::new(cargo());
    build
        .args(["build", "--quiet", "--locked", "--package", "passive-hopper-cli"])
        .current_dir(repository());
    step(&mut build, "the build of the program hopper")?;
    // Cargo has put it beside this program, which has the same profile.
    let own = std::env::current_exe().map_err(Error::at("xtask"))?;
    Ok(own.with_file_name(format!("hopper{}", std::env::consts::EXE_SUFFIX)))
}

/// What is skipped.
const PACKAGE: &str = "the Python package";

/// Ends with an error in a Python that is too old, or has no virtual environments.
const NEW_ENOUGH: &str = "import sys, venv; sys.exit(sys.version_info < (3, 10))";
