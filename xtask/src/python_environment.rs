//! Virtual environments for Python programs of the repository, each with the packages of a list.

use crate::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The interpreter that makes the environments: the variable `PYTHON`, or the usual name.
pub(crate) fn first_python() -> PathBuf {
    let usual = if cfg!(windows) { "python" } else { "python3" };
    std::env::var_os("PYTHON").map_or_else(|| usual.into(), PathBuf::from)
}

/// The interpreter of the environment in `folder` with the packages of `list`, which is made unless an earlier run
/// has made it.
///
/// A copy of the list of packages stands in the environment. It is written last: an installation that broke off has
/// none, and a changed list makes a new environment.
pub(crate) fn environment_python(
    python: &Path,
    folder: &Path,
    list: &Path,
) -> Result<PathBuf, Error> {
    let inside = folder.join(if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" });
    let wanted = std::fs::read_to_string(list).map_err(Error::at(list))?;
    let copy = folder.join("requirements.txt");
    if std::fs::read_to_string(&copy).is_ok_and(|there| there == wanted) {
        return Ok(inside);
    }
    // A closed standard error only loses this line.
    let _ = writeln!(std::io::stderr(), "making a Python environment in {}", folder.display());
    call(python, Command::new(python).args(["-m", "venv", "--clear"]).arg(folder))?;
    let install = ["-m", "pip", "install", "--quiet", "--disable-pip-version-check", "-r"];
    call(&inside, Command::new(&inside).args(install).arg(list))?;
    std::fs::write(&copy, wanted).map_err(Error::at(&copy))?;
    Ok(inside)
}

/// Runs a step to its end; its own messages stand above the error.
pub(crate) fn call(python: &Path, command: &mut Command) -> Result<(), Error> {
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(no_python(python, &status.to_string())),
        Err(source) => Err(no_python(python, &source.to_string())),
    }
}

pub(crate) fn no_python(python: &Path, reason: &str) -> Error {
    Error::new(format!(
        "{} failed ({reason}); install Python 3.11 or newer with its venv module and let pip reach a package index, or \
         name another interpreter with PYTHON=/path/to/python3",
        python.display()
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::repository::repository;

    #[test]
    fn without_python_the_error_names_the_remedy() {
        let folder = std::env::temp_dir().join(format!("no_python_{}", std::process::id()));
        let list = repository().join("xtask/generators/requirements.txt");
        let error = environment_python(Path::new("no-such-python"), &folder, &list);
        let text = error.unwrap_err().to_string();
        assert!(text.contains("no-such-python") && text.contains("PYTHON="), "{text}");
    }
}
