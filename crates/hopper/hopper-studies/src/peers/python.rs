//! A Python interpreter with the compared packages, in a separate virtual environment.

use crate::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The compared versions, fixed so that two runs measure the same software.
const PACKAGES: [&str; 4] = ["heyoka==7.13.2", "scipy==1.17.1", "numba==0.68.1", "numpy==2.4.6"];

/// An interpreter that has all of [`PACKAGES`].
#[derive(Debug, Clone)]
pub(crate) struct Python(PathBuf);

impl Python {
    /// The environment in `folder`.
    ///
    /// The interpreter `python` makes the environment, unless an earlier run has made it with the same packages. A note
    /// in the environment lists the packages. The note is written last, so that a broken installation has none.
    pub(crate) fn with_packages(python: &str, folder: &Path) -> Result<Self, Error> {
        let environment = folder.join("venv");
        let inside =
            environment.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
        let wanted = PACKAGES.join(" ");
        let note = environment.join("packages.txt");
        if std::fs::read_to_string(&note).is_ok_and(|text| text == wanted) {
            return Ok(Python(inside));
        }
        // The packages are about 700 MB. Without this line the program would be silent for minutes.
        let _ = writeln!(std::io::stderr(), "installing {wanted} in {}", environment.display());
        let make = ["-m", "venv", "--clear", &environment.to_string_lossy()].map(str::to_owned);
        call(
            Path::new(python),
            &make,
            "a virtual environment could not be made; is Python installed?",
        )?;
        let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check"];
        let install: Vec<_> =
            install.iter().chain(&PACKAGES).map(|&word| word.to_owned()).collect();
        call(&inside, &install, &format!("{wanted} could not be installed"))?;
        std::fs::write(&note, wanted)
            .map_err(|source| crate::error::Error::File { path: note.clone(), source })?;
        Ok(Python(inside))
    }

    /// Builds this repository's own Python package, and installs it beside the others.
    pub(crate) fn with_own_package(self, package: &Path, build: &Path) -> Result<Self, Error> {
        let mut command = Command::new(&self.0);
        command.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
        command.args(["--no-deps", "--force-reinstall"]).arg(package);
        command.env("CARGO_TARGET_DIR", build);
        finish(&mut command, "passive_hopper could not be built and installed")?;
        Ok(self)
    }

    /// Runs a script with these arguments.
    pub(crate) fn run(&self, script: &str, arguments: &[&Path]) -> Result<(), Error> {
        let mut words = vec!["-c".to_owned(), script.to_owned()];
        words.extend(arguments.iter().map(|path| path.to_string_lossy().into_owned()));
        call(&self.0, &words, "the peers' script failed")
    }
}

/// The results that a program has written as JSON.
pub(crate) fn results<T: serde::de::DeserializeOwned>(path: &Path) -> Result<T, Error> {
    serde_json::from_str(&crate::repository::read(path)?)
        .map_err(|error| Error::Peers { reason: error.to_string() })
}

/// Runs a program to its end. The last lines of its messages are part of the error.
pub(crate) fn call(program: &Path, arguments: &[String], what: &str) -> Result<(), Error> {
    finish(Command::new(program).args(arguments), what)
}

fn finish(command: &mut Command, what: &str) -> Result<(), Error> {
    let program = PathBuf::from(command.get_program());
    let reason = |why: String| Error::Peers { reason: format!("{what} ({why})") };
    let output = command.output().map_err(|e| reason(format!("{}: {e}", program.display())))?;
    if output.status.success() {
        return Ok(());
    }
    // pip and venv write some of their errors to standard output.
    let silent = output.stderr.trim_ascii().is_empty();
    let complaint = if silent { &output.stdout } else { &output.stderr };
    let complaint = String::from_utf8_lossy(complaint.trim_ascii());
    // The cause comes last: three lines contain it without filling the screen.
    let last: Vec<_> = complaint.lines().rev().take(3).collect();
    let last = last.into_iter().rev().collect::<Vec<_>>().join(" / ");
    Err(reason(format!("{}: {}, {last}", program.display(), output.status)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_python_is_an_error_that_says_so() {
        let folder = std::env::temp_dir().join(format!("hopper_peers_{}", std::process::id()));
        let error = Python::with_packages("no-such-python", &folder).unwrap_err().to_string();
        assert!(error.contains("no-such-python") && error.contains("Python"), "{error}");
    }

    #[test]
    fn complaints_of_a_program_are_told() {
        let error =
            call(Path::new("cargo"), &["no-such-command".to_owned()], "it failed").unwrap_err();
        assert!(error.to_string().contains("no-such-command"), "{error}");
    }
}
