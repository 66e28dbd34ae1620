//! `cargo xtask python-release`: the wheel and the source archive of the Python package, as they would be published.
//!
//! Both are built, looked at by the tools of the index, and installed each into an environment of its own: the wheel without Rust on the path. The
//! tests run there. It needs Python, a package index and the crates that bind Rust to Python; what cannot be had is said in a line that begins
//! with SKIPPED.

use crate::error::Error;
use crate::process::{say, skip, step};
use crate::python_environment::{call, environment_python, first_python};
use crate::repository::repository;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// What is skipped.
const RELEASE: &str = "the release of the Python package";

/// Builds, looks, installs, tests.
pub(crate) fn run() -> Result<ExitCode, Error> {
    let root = repository();
    let package = root.join("crates/both/python-package");
    let target = root.join("target/python");
    let list = package.join("tests/release_requirements.txt");
    let Ok(tools) = environment_python(&first_python(), &target.join("release"), &list) else {
        return skip(RELEASE, "its tools cannot be installed; the messages stand above");
    };
    let mut notice = Command::new(&tools);
    notice.arg(root.join("xtask/generators/notice.py")).arg("--check");
    step(&mut notice, "the comparison of NOTICE with the crates that are linked")?;
    let folder = target.join("dist");
    if folder.exists() {
        std::fs::remove_dir_all(&folder).map_err(Error::at(&folder))?;
    }
    let maturin = |arguments: &[&str]| {
        let mut command = Command::new(&tools);
        command.args(["-m", "maturin"]).args(arguments).arg("--out").arg(&folder);
        command.env("CARGO_TARGET_DIR", target.join("build")).current_dir(&package);
        // Maturin starts zig from the environment.
        command.env("PATH", with_programs(&tools));
        command
    };
    let portable = ["build", "--release", "--zig", "--compatibility", "manylinux2014"];
    step(&mut maturin(&portable), "the build of the wheel")?;
    step(&mut maturin(&["sdist"]), "the build of the source archive")?;
    let files = files_of(&folder)?;
    for file in &files {
        say(&format!("{} has {} bytes", file.display(), size_of_file(file)?))?;
    }
    let wheel = files.iter().find(|file| file.extension().is_some_and(|end| end == "whl"));
    let archive = files.iter().find(|file| file.extension().is_some_and(|end| end == "gz"));
    let (Some(wheel), Some(archive)) = (wheel, archive) else {
        return Err(Error::new("maturin has left no wheel, or no source archive"));
    };
    let module = |name: &str| {
        let mut command = Command::new(&tools);
        command.args(["-m", name]);
        command
    };
    step(module("auditwheel").arg("show").arg(wheel), "auditwheel")?;
    step(module("twine").args(["check", "--strict"]).args(&files), "twine check")?;
    let contents = tools.with_file_name("check-wheel-contents");
    // Two packages in one wheel are meant.
    step(Command::new(contents).args(["--ignore", "W009"]).arg(wheel), "check-wheel-contents")?;
    let tests = package.join("tests/requirements.txt");
    for (what, file) in [("wheel", wheel), ("sdist", archive)] {
        say(&format!("the tests of the {what}"))?;
        let own = target.join(format!("installed-{what}"));
        let inside = environment_python(&first_python(), &own, &tests)?;
        // The tests of types take a while: the gate skips them aloud.
        let types =
            ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "mypy>=1.15"];
        call(&inside, Command::new(&inside).args(types))?;
        install(&inside, file, what == "sdist", &target)?;
        // The tests lie beside no sources of the package: they import what is installed.
        let mut run = Command::new(&inside);
        run.args(["-m", "pytest", "-p", "no:cacheprovider", "-q"]).arg(package.join("tests"));
        run.env("PYTHONDONTWRITEBYTECODE", "1").env_remove("HOPPER_PROGRAM");
        if what == "wheel" {
            run.env("PATH", without_cargo());
        }
        call(&inside, run.current_dir(&own))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Installs a file; a source archive is built with the tools of its environment.
fn install(python: &Path, file: &Path, builds: bool, target: &Path) -> Result<(), Error> {
    let mut install = Command::new(python);
    install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]);
    install.args(["--force-reinstall", "--no-build-isolation"]).arg(file);
    match builds {
        true => {
            install.env("PATH", with_programs(python)).env("CARGO_TARGET_DIR", target.join("build"))
        }
        false => install.env("PATH", without_cargo()),
    };
    call(python, &mut install)
}

/// The search path with the programs of an environment first.
fn with_programs(python: &Path) -> OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let own = python.parent().map(PathBuf::from);
    let all = own.into_iter().chain(std::env::split_paths(&path));
    std::env::join_paths(all).unwrap_or(path)
}

/// The search path without the folders that have Rust.
fn without_cargo() -> OsString {
    let path = std::env::var_os("PATH").unwrap_or_default();
    let has_rust =
        |folder: &PathBuf| ["cargo", "rustc"].iter().any(|name| folder.join(name).exists());
    let others = std::env::split_paths(&path).filter(|folder| !has_rust(folder));
    std::env::join_paths(others).unwrap_or(path)
}

fn files_of(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let entries = std::fs::read_dir(folder).map_err(Error::at(folder))?;
    let mut files = Vec::new();
    for entry in entries {
        files.push(entry.map_err(Error::at(folder))?.path());
    }
    files.sort();
    Ok(files)
}

fn size_of_file(file: &Path) -> Result<u64, Error> {
    Ok(std::fs::metadata(file).map_err(Error::at(file))?.len())
}
