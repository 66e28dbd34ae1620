//! `cargo xtask check-certificates`: proves some theorems, and has a second program check their certificates.
//!
//! The second program is `generators/check_certificate.py`. It needs Python and python-flint from its package
//! index. If they cannot be had, a line that begins with SKIPPED is printed.

use crate::error::Error;
use crate::process::{cargo, profile, skip, step, steps};
use crate::python_environment::{environment_python, first_python};
use crate::repository::repository;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode, Stdio};

/// Random claims of each certificate: all of the short ones, and enough of the long ones for seconds. The manifest of
/// statements names a smaller number where a claim takes a second.
const SAMPLE: &str = "1000";

/// Random changes of each certificate. Twenty take 18 seconds; a thousand of each were tried once.
const CHANGES: &str = "20";

/// Arguments at which enclosures of functions are compared. They take 24 seconds.
const ARGUMENTS: &str = "300000";

/// Examples of validated-dynamics that write certificates, of the same name. `van_der_pol` takes twelve minutes.
const ANY_MODEL: [&str; 4] = ["rossler", "impact_oscillator", "spring_leg", "henon"];

/// The division of Hénon's window: the example's own takes four times as long to confirm.
const HENON: [&str; 2] = ["10", "20000"];

/// Random boxes that are compared with points in 30 digits. They take ten seconds; 10⁴ were compared once.
const BOXES: &str = "100";

/// Proves, checks, and falsifies.
pub(crate) fn run() -> Result<ExitCode, Error> {
    let folder = repository().join("target/certificates");
    let scripts = repository().join("xtask/generators");
    let list = scripts.join("certificate_requirements.txt");
    let Ok(python) = environment_python(&first_python(), &folder.join("environment"), &list) else {
        return skip(
            "the certificates",
            "python-flint cannot be installed; the messages stand above",
        );
    };
    // The files of an earlier run must not pass for new ones.
    certificates(&folder).iter().for_each(|file| drop(std::fs::remove_file(file)));
    let mut prove = Command::new(cargo());
    prove.args(["run", "--quiet", "--package", "hopper-studies"]).arg(profile());
    prove.args(["--", "prove", "--gate", "--out"]).arg(&folder).current_dir(repository());
    step(&mut prove, "prove")?;
    let files = certificates(&folder);
    let any_model = folder.join("any-model");
    std::fs::create_dir_all(&any_model).map_err(Error::at(&any_model))?;
    let own: Vec<PathBuf> =
        ANY_MODEL.iter().map(|name| any_model.join(format!("{name}.jsonl"))).collect();
    for (name, file) in ANY_MODEL.iter().zip(&own) {
        let mut example = Command::new(cargo());
        example.args(["run", "--quiet", "--package", "validated-dynamics"]).arg(profile());
        example.args(["--example", name, "--"]).arg(file).current_dir(repository());
        if *name == "henon" {
            example.args(HENON);
        }
        step(&mut example, name)?;
    }
    let boxes = folder.join("boxes.txt");
    let failed_at = Error::at(&boxes);
    let mut example = Command::new(cargo());
    example.args(["run", "--quiet", "--package", "validated-dynamics"]).arg(profile());
    example.args(["--example", "random_boxes", "--", BOXES]).current_dir(repository());
    example.stdout(std::fs::File::create(&boxes).map_err(&failed_at)?);
    step(&mut example, "random_boxes")?;
    let script = |name: &'static str, arguments: &[&str], files: &[PathBuf]| {
        let mut command = Command::new(&python);
        command.arg(scripts.join(name)).args(arguments).args(files);
        command.env("PYTHONDONTWRITEBYTECODE", "1");
        (command, name)
    };
    let (within, within_any_model) = ([folder.clone()], [any_model]);
    // Enclosures of functions. Both programs and all lemmas rest on sines and cosines.
    let mut enclosures = Command::new(cargo());
    enclosures.args(["run", "--quiet", "--package", "interval-arithmetic"]).arg(profile());
    enclosures
        .args(["--example", "function_enclosures", "--", ARGUMENTS])
        .current_dir(repository());
    let failed = Error::starting(cargo());
    let mut enclosures = enclosures.stdout(Stdio::piped()).spawn().map_err(&failed)?;
    let records = enclosures.stdout.take().map_or_else(Stdio::null, Stdio::from);
    let mut comparison = script("compare_functions.py", &[], &[]);
    comparison.0.stdin(records);
    let mut flows = script("compare_flows.py", &[], &[]);
    flows.0.stdin(std::fs::File::open(&boxes).map_err(&failed_at)?);
    // Each uses one processor.
    let compared = steps(vec![
        script("check_certificate.py", &["--sample", SAMPLE], &files),
        script("check_certificate.py", &["--sample", SAMPLE], &own),
        script("false_any_model.py", &[], &within_any_model),
        script("false_certificates.py", &[], &within),
        script("false_certificates.py", &["--random", CHANGES], &within),
        // The bound of Theorem 68, which no certificate rests on: a larger one, which takes seconds.
        script("left_remainder.py", &["1", "--bound", "40"], &[]),
        comparison,
        flows,
    ]);
    let written = enclosures.wait().map_err(failed)?;
    compared?;
    if written.success() {
        Ok(ExitCode::SUCCESS)
    } else {
        Err(Error::new("function_enclosures failed; its messages stand above"))
    }
}

/// The certificates in a folder. There is one for each theorem, or `false_certificates.py` fails.
fn certificates(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end == "jsonl"))
        .collect();
    files.sort();
    files
}
