//! `cargo xtask check-formal`: builds the formal proofs of `formal/`, where Coq is installed, and looks at their axioms.

use crate::error::Error;
use crate::process::{print, skip, step};
use crate::repository::repository;
use std::path::Path;
use std::process::{Command, ExitCode};

/// The classical axioms of the real numbers of Coq's library. Proofs may rest on no others.
const AXIOMS: [&str; 4] = [
    "ClassicalDedekindReals.sig_not_dec",
    "ClassicalDedekindReals.sig_forall_dec",
    "FunctionalExtensionality.functional_extensionality_dep",
    "Classical_Prop.classic",
];

/// What the formal proofs need, in Debian.
const PACKAGES: &str = "coqc is not installed (Debian: coq libcoq-interval libcoq-coquelicot)";

/// Builds in a copy, so that the sources stay alone in their folder.
pub(crate) fn run() -> Result<ExitCode, Error> {
    if !Command::new("coqc").arg("--version").output().is_ok_and(|found| found.status.success()) {
        return skip("the formal proofs", PACKAGES);
    }
    let folder = repository().join("target/formal");
    std::fs::create_dir_all(&folder).map_err(Error::at(&folder))?;
    let sources = repository().join("xtask/formal");
    for entry in std::fs::read_dir(&sources).map_err(Error::at(&sources))?.flatten() {
        check_source(&entry.path())?;
        copy_if_changed(&entry.path(), &folder.join(entry.file_name()))?;
    }
    let mut makefile = Command::new("coq_makefile");
    step(
        makefile.args(["-f", "_CoqProject", "-o", "Makefile"]).current_dir(&folder),
        "coq_makefile",
    )?;
    step(Command::new("make").args(["-j2", "--silent"]).current_dir(&folder), "the formal proofs")?;
    let mut last = Command::new("coqc");
    last.args(["-w", "-ambiguous-paths", "-Q", ".", "Hopper", "Assumptions.v"]);
    let printed = last.current_dir(&folder).output().map_err(Error::starting("coqc"))?;
    let text = String::from_utf8_lossy(&printed.stdout).into_owned();
    let axioms = axioms(&text);
    let other: Vec<&str> = axioms.iter().copied().filter(|axiom| !AXIOMS.contains(axiom)).collect();
    if !printed.status.success() || axioms.is_empty() || !other.is_empty() {
        return Err(Error::new(format!("the formal proofs rest on {other:?}:\n{text}")));
    }
    let axioms = AXIOMS.len();
    print(&format!("the formal proofs hold; they rest on {axioms} axioms of the real numbers"))
}

/// Words by which a source would leave a proof out.
const HOLES: [&str; 5] = ["Admitted", "admit", "Axiom", "Parameter", "Conjecture"];

/// An error for a proof that is left out: the axioms of theorems that `Assumptions.v` does not name are not printed.
fn check_source(path: &Path) -> Result<(), Error> {
    if path.extension().is_none_or(|end| end != "v") {
        return Ok(());
    }
    let text = std::fs::read_to_string(path).map_err(Error::at(path))?;
    let words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    match words.into_iter().find(|word| HOLES.contains(word)) {
        Some(word) => Err(Error::new(format!("{}: {word}", path.display()))),
        None => Ok(()),
    }
}

/// Leaves a file alone that is there already: what is built of it stays newer.
fn copy_if_changed(from: &Path, to: &Path) -> Result<(), Error> {
    let own = std::fs::read(from).map_err(Error::at(from))?;
    if std::fs::read(to).is_ok_and(|before| before == own) {
        return Ok(());
    }
    std::fs::write(to, own).map_err(Error::at(to))
}

/// The names of the axioms in what `Print Assumptions` prints: "Axioms:", then a name with its type, whose further lines are indented.
fn axioms(text: &str) -> Vec<&str> {
    let names = text.lines().filter(|line| !line.starts_with(' ') && *line != "Axioms:");
    names.filter_map(|line| line.split_whitespace().next()).collect()
}

#[cfg(test)]
mod tests {
    use super::axioms;

    #[test]
    fn names_of_axioms_are_read() {
        let text = "Axioms:\nClassical_Prop.classic : forall P : Prop, P \\/ ~ P\nother.axiom\n  : forall x : R,\n    x = x\n";
        assert_eq!(axioms(text), ["Classical_Prop.classic", "other.axiom"]);
    }
}
