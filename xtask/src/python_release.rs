//! `cargo xtask python-release [--check]`: the wheel and the source archive of the Python package, as they would be published.
//!
//! The wheels, for glibc and for musl, and the archive with the sources of all crates are built and looked at by the tools of the index. With `--check` the wheel
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

/// Builds and looks; with `--check` it also installs and tests.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let tests = match arguments {
        [] => false,
        [option] if option == "--check" => true,
        [option] if option == "--help" || option == "-h" => {
            say(
                "Usage: cargo xtask python-release [OPTIONS]\n\nOptions:\n      --check  Install each file, and run the tests there\n  -h, --help   Print help",
            )?;
            return Ok(ExitCode::SUCCESS);
        }
        [option, ..] => {
            return Err(Error::unknown_option("python-release", &option.to_string_lossy()));
        }
    };
    let root = repository();
    let (package, target) = (root.join("crates/both/python-package"), root.join("target/python"));
    let list = package.join("tests/release_requirements.txt");
    let Ok(tools) = environment_python(&first_python(), &target.join("release"), &list) else {
        return skip(RELEASE, "its tools cannot be installed; the messages stand above");
    };
    let release = Release { package, folder: target.join("dist"), target, tools };
    let files = release.build()?;
    release.look(&files)?;
    if tests {
        release.test(&files)?;
    }
    Ok(ExitCode::SUCCESS)
}

/// Where a release is made.
struct Release {
    package: PathBuf,
    target: PathBuf,
    /// The folder of the files.
    folder: PathBuf,
    /// The interpreter of the environment of tools.
    tools: PathBuf,
}

/// What is released: the wheel for glibc, that for musl if it can be built, and the source archive.
struct Files {
    wheel: PathBuf,
    musl: Option<PathBuf>,
    archive: PathBuf,
}

impl Files {
    fn wheels(&self) -> impl Iterator<Item = &PathBuf> {
        [&self.wheel].into_iter().chain(&self.musl)
    }

    fn all(&self) -> impl Iterator<Item = &PathBuf> {
        self.wheels().chain([&self.archive])
    }
}

impl Release {
    fn maturin(&self, arguments: &[&str]) -> Command {
        let mut command = self.module("maturin");
        command.args(arguments).arg("--out").arg(&self.folder);
        command.env("CARGO_TARGET_DIR", self.target.join("build")).current_dir(&self.package);
        // Maturin starts zig from the environment.
        command.env("PATH", with_programs(&self.tools));
        command
    }

    fn module(&self, name: &str) -> Command {
        let mut command = Command::new(&self.tools);
        command.args(["-m", name]);
        command
    }

    fn generator(&self, name: &str) -> Command {
        let mut command = Command::new(&self.tools);
        command.arg(repository().join("xtask/generators").join(name)).env("CARGO", cargo());
        command
    }

    fn build(&self) -> Result<Files, Error> {
        let mut notice = self.generator("notice.py");
        step(notice.arg("--check"), "the comparison of NOTICE with the crates that are linked")?;
        refuses_free_threads(&self.package, &self.target)?;
        if self.folder.exists() {
            std::fs::remove_dir_all(&self.folder).map_err(Error::at(&self.folder))?;
        }
        let portable = ["build", "--release", "--zig", "--compatibility", "manylinux2014"];
        step(&mut self.maturin(&portable), "the build of the wheel")?;
        let wheel = self.file(|name| name.ends_with(".whl"))?;
        let musl = match succeeds(Command::new("rustup").args(["target", "add", MUSL])) {
            true => {
                let musl = ["build", "--release", "--zig", "--compatibility", "musllinux_1_2"];
                step(
                    self.maturin(&musl).args(["--target", MUSL]),
                    "the build of the wheel for musl",
                )?;
                Some(self.file(|name| name.contains("musllinux"))?)
            }
            false => {
                skip("the wheel for musl", &format!("rustup cannot add the target {MUSL}"))?;
                None
            }
        };
        step(&mut self.maturin(&["sdist"]), "the build of the source archive")?;
        let archive = self.file(|name| name.ends_with(".gz"))?;
        let mut vendor = self.generator("vendored_sdist.py");
        step(vendor.arg(&archive), "the sources of the crates")?;
        Ok(Files { wheel, musl, archive })
    }

    /// The file of the folder with such a name.
    fn file(&self, is_it: impl Fn(&str) -> bool) -> Result<PathBuf, Error> {
        let entries = std::fs::read_dir(&self.folder).map_err(Error::at(&self.folder))?;
        for entry in entries {
            let entry = entry.map_err(Error::at(&self.folder))?;
            if is_it(&entry.file_name().to_string_lossy()) {
                return Ok(entry.path());
            }
        }
        Err(Error::new("maturin has left no file of the kind that it was asked for"))
    }

    /// The tools of the index.
    fn look(&self, files: &Files) -> Result<(), Error> {
        for file in files.all() {
            say(&format!("{} has {} bytes", file.display(), size_of_file(file)?))?;
        }
        // The wheel for musl is looked at by maturin alone: auditwheel asks the libraries of this system, which has another one.
        let mut audit = self.module("auditwheel");
        let shown = audit
            .arg("show")
            .arg(&files.wheel)
            .output()
            .map_err(Error::starting(audit.get_program()))?;
        let shown = String::from_utf8_lossy(&shown.stdout).into_owned();
        say(&shown)?;
        if !shown.contains("manylinux_2_17_x86_64") {
            return Err(Error::new(
                "auditwheel does not find the wheel consistent with manylinux_2_17",
            ));
        }
        // Two packages in one wheel are meant.
        let mut contents = Command::new(self.tools.with_file_name("check-wheel-contents"));
        step(contents.args(["--ignore", "W009"]).args(files.wheels()), "check-wheel-contents")?;
        step(self.module("twine").args(["check", "--strict"]).args(files.all()), "twine check")
    }

    /// Each file in an environment of its own; the wheel also beside an old NumPy.
    fn test(&self, files: &Files) -> Result<(), Error> {
        skip("the tests of the wheel for musl", "this system has glibc")?;
        let (usual, old) = ("requirements.txt", "old_numpy_requirements.txt");
        let kinds = [
            ("wheel", &files.wheel, usual),
            ("sdist", &files.archive, usual),
            ("old-numpy", &files.wheel, old),
        ];
        for (what, file, list) in kinds {
            say(&format!("the tests of {} in the environment {what}", file.display()))?;
            let own = self.target.join(format!("installed-{what}"));
            let list = self.package.join("tests").join(list);
            let Ok(inside) = environment_python(&first_python(), &own, &list) else {
                skip(
                    what,
                    "the packages of its environment cannot be installed; the messages stand above",
                )?;
                continue;
            };
            self.test_in(&inside, file, (what == "sdist", &own))?;
        }
        Ok(())
    }

    fn test_in(
        &self,
        inside: &Path,
        file: &Path,
        (is_archive, own): (bool, &Path),
    ) -> Result<(), Error> {
        // The tests of types take a while: the gate skips them aloud.
        let mut types = Command::new(inside);
        types.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
        if !succeeds(types.args(["mypy>=1.15", "pyright>=1.1.400"])) {
            skip("the tests of types", "mypy or pyright cannot be installed")?;
        }
        install(inside, file, is_archive, &self.target)?;
        // The tests lie beside no sources of the package: they import what is installed.
        let mut run = Command::new(inside);
        run.args(["-m", "pytest", "-p", "no:cacheprovider", "-q"]).arg(self.package.join("tests"));
        run.env("PYTHONDONTWRITEBYTECODE", "1").env_remove("HOPPER_PROGRAM");
        if !is_archive {
            run.env("PATH", without_cargo());
        }
        call(inside, run.current_dir(own))
    }
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

fn size_of_file(file: &Path) -> Result<u64, Error> {
    Ok(std::fs::metadata(file).map_err(Error::at(file))?.len())
}
