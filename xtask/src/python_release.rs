//! `cargo xtask python-release`: the wheel and the source archive of the Python package, as they would be published.
//!
//! The wheels, for glibc and for musl, and the archive with the sources of all crates are built and looked at by the tools of the index. The wheel
//! is installed without Rust on the path, also beside an old NumPy, and the archive is built without a network. The tests run there. What cannot be had is said in
//! a line that begins with SKIPPED.

use crate::error::Error;
use crate::process::{cargo, say, skip, step, succeeds};
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
    let wheel = first_with(&folder, "whl")?;
    match succeeds(Command::new("rustup").args(["target", "add", MUSL])) {
        true => {
            let musl = ["--compatibility", "musllinux_1_2", "--target", MUSL];
            let build = maturin(&["build", "--release", "--zig"]).args(musl).status();
            let built = build.is_ok_and(|status| status.success());
            if !built {
                return Err(Error::new("the build of the wheel for musl failed"));
            }
        }
        false => {
            skip("the wheel for musl", &format!("rustup cannot add the target {MUSL}"))?;
        }
    }
    step(&mut maturin(&["sdist"]), "the build of the source archive")?;
    let archive = first_with(&folder, "gz")?;
    let mut vendor = Command::new(&tools);
    vendor.arg(root.join("xtask/generators/vendored_sdist.py")).arg(&archive);
    step(vendor.env("CARGO", cargo()), "the sources of the crates")?;
    refuses_free_threads(&package, &target)?;
    let files = files_of(&folder)?;
    for file in &files {
        say(&format!("{} has {} bytes", file.display(), size_of_file(file)?))?;
    }
    let module = |name: &str| {
        let mut command = Command::new(&tools);
        command.args(["-m", name]);
        command
    };
    // The wheel for musl is checked by maturin alone: auditwheel asks the libraries of this system, which has another one.
    step(module("auditwheel").arg("show").arg(&wheel), "auditwheel")?;
    let contents = tools.with_file_name("check-wheel-contents");
    let wheels = files.iter().filter(|file| has_end(file, "whl"));
    // Two packages in one wheel are meant.
    step(Command::new(contents).args(["--ignore", "W009"]).args(wheels), "check-wheel-contents")?;
    step(module("twine").args(["check", "--strict"]).args(&files), "twine check")?;
    let tests = package.join("tests");
    let lists = [
        ("wheel", &wheel, "requirements.txt"),
        ("sdist", &archive, "requirements.txt"),
        ("old-numpy", &wheel, "old_numpy_requirements.txt"),
    ];
    for (what, file, list) in lists {
        say(&format!("the tests of {} in the environment {what}", file.display()))?;
        let own = target.join(format!("installed-{what}"));
        let Ok(inside) = environment_python(&first_python(), &own, &tests.join(list)) else {
            skip(
                &format!("the environment {what}"),
                "its packages cannot be installed; the messages stand above",
            )?;
            continue;
        };
        // The tests of types take a while: the gate skips them aloud.
        let types = [
            "-m",
            "pip",
            "install",
            "--quiet",
            "--disable-pip-version-check",
            "mypy>=1.15",
            "pyright>=1.1.400",
        ];
        call(&inside, Command::new(&inside).args(types))?;
        install(&inside, file, what == "sdist", &target)?;
        // The tests lie beside no sources of the package: they import what is installed.
        let mut run = Command::new(&inside);
        run.args(["-m", "pytest", "-p", "no:cacheprovider", "-q"]).arg(&tests);
        run.env("PYTHONDONTWRITEBYTECODE", "1").env_remove("HOPPER_PROGRAM");
        if what != "sdist" {
            run.env("PATH", without_cargo());
        }
        call(&inside, run.current_dir(&own))?;
    }
    Ok(ExitCode::SUCCESS)
}

/// The target of wheels for distributions with musl, such as Alpine.
const MUSL: &str = "x86_64-unknown-linux-musl";

/// An interpreter with free threads, as PyO3 is told of one that is not there.
const FREE_THREADED: &str = "implementation=CPython\nversion=3.14\nshared=true\nabi3=false\nlib_name=python3.14t\n\
                             pointer_width=64\nbuild_flags=Py_GIL_DISABLED\n\
                             suppress_build_script_link_lines=false\n";

/// Whether a build for free-threaded Python ends with the sentence that says why.
fn refuses_free_threads(package: &Path, target: &Path) -> Result<(), Error> {
    let told = target.join("free_threaded.txt");
    std::fs::write(&told, FREE_THREADED).map_err(Error::at(&told))?;
    let mut check = Command::new(cargo());
    check.args(["check", "--quiet", "--locked", "--release"]).current_dir(package);
    check.env("PYO3_CONFIG_FILE", &told).env("CARGO_TARGET_DIR", target.join("free-threaded"));
    let output = check.output().map_err(Error::starting(check.get_program()))?;
    let said = String::from_utf8_lossy(&output.stderr);
    match said.contains("not built for free-threaded Python") && !output.status.success() {
        true => say("a build for free-threaded Python ends with the reason"),
        false => Err(Error::new(format!(
            "a build for free-threaded Python does not end with the reason: {said}"
        ))),
    }
}

fn has_end(file: &Path, end: &str) -> bool {
    file.extension().is_some_and(|own| own == end)
}

/// The first file of a folder with this end.
fn first_with(folder: &Path, end: &str) -> Result<PathBuf, Error> {
    let found = files_of(folder)?.into_iter().find(|file| has_end(file, end));
    found.ok_or_else(|| Error::new(format!("maturin has left no file with the end {end}")))
}

/// Installs a file; a source archive is built with the tools of its environment.
fn install(python: &Path, file: &Path, builds: bool, target: &Path) -> Result<(), Error> {
    let mut install = Command::new(python);
    install.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-deps"]);
    install.args(["--force-reinstall", "--no-build-isolation"]).arg(file);
    match builds {
        // Of an empty folder Cargo knows no crates: all of them come from the archive.
        true => {
            let home = target.join("empty-cargo-home");
            install
                .env("PATH", with_programs(python))
                .env("CARGO_TARGET_DIR", target.join("build"));
            install.env("CARGO_HOME", home).env("CARGO_NET_OFFLINE", "true")
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
