//! `cargo xtask check-certificates`: proves some theorems, and has a second program check their certificates.
//!
//! The second program is `generators/check_certificate.py`. It needs Python and python-flint from its package index. If they cannot be had,
//! a line that begins with SKIPPED is printed.

use crate::error::Error;
use crate::python_environment::{call, environment_python, first_python};
use crate::repository::repository;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, ExitCode, Stdio};

/// Theorems that take seconds, and small rasters of pixels.
const PROVED: [&[&str]; 3] = [
    &["one-sudden", "one-sided", "crisis", "traps", "everything-hops", "rising"],
    &["fig6-points", "--size", "16"],
    &["fig6-cells", "--size", "4"],
];

/// Random claims of each certificate: all of the short ones, and enough of the long ones for seconds.
const SAMPLE: &str = "1000";

/// Arguments at which enclosures of functions are compared. A million take ten seconds.
const ARGUMENTS: &str = "300000";

/// Proves, checks, and falsifies.
pub(crate) fn run() -> Result<ExitCode, Error> {
    let folder = repository().join("target/certificates");
    let scripts = repository().join("xtask/generators");
    let list = scripts.join("certificate_requirements.txt");
    let Ok(python) = environment_python(&first_python(), &folder.join("environment"), &list) else {
        return skip("python-flint cannot be installed; the messages stand above");
    };
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut files = Vec::new();
    for theorems in PROVED {
        let mut prove = Command::new(&cargo);
        prove.args(["run", "--quiet", "--release", "--package", "hopper-paper", "--", "prove"]);
        prove.args(theorems).arg("--out").arg(&folder).current_dir(repository());
        // A raster of so few cells leaves more of its area open than the theorem allows. What is claimed of the rest is checked.
        let status = prove.status();
        status.map_err(|source| Error::Cargo { program: cargo.clone(), source })?;
        let names = theorems.iter().take_while(|name| !name.starts_with("--"));
        files.extend(names.map(|name| folder.join(format!("{name}.jsonl"))));
    }
    let script = |name: &str| {
        let mut command = Command::new(&python);
        command.arg(scripts.join(name)).env("PYTHONDONTWRITEBYTECODE", "1");
        command
    };
    call(&python, script("check_certificate.py").args(["--sample", SAMPLE]).args(&files))?;
    call(&python, script("false_certificates.py").arg(&folder))?;
    // Sines and cosines, which both programs and all lemmas rest on.
    let mut enclosures = Command::new(&cargo);
    enclosures.args(["run", "--quiet", "--release", "--package", "interval-arithmetic"]);
    enclosures.args(["--example", "wave_enclosures", "--", ARGUMENTS]).current_dir(repository());
    let failed = |source| Error::Cargo { program: cargo.clone(), source };
    let mut enclosures = enclosures.stdout(Stdio::piped()).spawn().map_err(failed)?;
    let records = enclosures.stdout.take().map_or_else(Stdio::null, Stdio::from);
    let compared = call(&python, script("compare_functions.py").stdin(records));
    let written = enclosures.wait().map_err(failed)?;
    compared?;
    if written.success() { Ok(ExitCode::SUCCESS) } else { Err(Error::Builds(1)) }
}

fn skip(reason: &str) -> Result<ExitCode, Error> {
    let at = |source| Error::File { path: PathBuf::from("standard output"), source };
    writeln!(std::io::stdout(), "SKIPPED the certificates: {reason}").map_err(at)?;
    Ok(ExitCode::SUCCESS)
}
