//! Which crates may print, read files or use clocks.

use super::breach::Breach;
use CrateClass::{Computing, Files, Program, TestSupport};

/// The actions that a crate may take besides computing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CrateClass {
    /// No other actions: the same input gives the same result, on any machine and in a browser.
    Computing,
    /// Panic, like the tests that use it.
    TestSupport,
    /// Read and write files, without printing: its callers decide what a user sees.
    Files,
    /// Print, read, write, use clocks and start processes.
    Program,
}

/// Every crate, with its class and the reason for it.
const CLASSES: [(&str, CrateClass, &str); 19] = [
    ("hybrid-system", Computing, "executions are functions of the system and its start"),
    ("equations", Computing, "values are functions of formulas, time and state"),
    ("interval-arithmetic", Computing, "enclosures are functions of numbers"),
    ("hopper-proof", Computing, "proofs are functions of a window"),
    ("return-map", Computing, "maps and their fixed points are functions of a system"),
    ("validated-dynamics", Computing, "proofs are functions of equations and boxes"),
    ("basin-of-attraction", Computing, "random points come from a seed argument"),
    ("passive-hopper", Computing, "hops are functions of α and M"),
    ("hopper-asymptotics", Computing, "expansions are functions of n and M"),
    ("hopper-basin", Computing, "fates are functions of α and M"),
    ("example-systems", Computing, "models are functions of their parameters"),
    (
        "hopper-reference",
        TestSupport,
        "a reference value that is missing must fail the test that reads it",
    ),
    ("journal-figures", Computing, "figures are bytes; its font is part of the crate"),
    ("hopper-figures", Computing, "drawings are functions of what they show"),
    ("resumable-job", Files, "finished pieces must survive a kill, so they are on disk"),
    ("passive-hopper-cli", Program, "the program for users: it reads, prints and writes"),
    ("hopper-studies", Program, "writes figures and reports, looks at clocks, and says what holds"),
    (
        "hopper-explorer",
        Computing,
        "a front for the browser: it converts, and computes nothing itself",
    ),
    ("python-package", Computing, "a front for Python: it converts, and computes nothing itself"),
];

/// Crates that any other system could use. They do not contain the word hopper.
pub(super) const GENERIC: [&str; 8] = [
    "hybrid-system",
    "equations",
    "interval-arithmetic",
    "return-map",
    "validated-dynamics",
    "basin-of-attraction",
    "journal-figures",
    "resumable-job",
];

/// The class of a crate; `None` if the table does not have it.
pub(super) fn class_of(name: &str) -> Option<CrateClass> {
    CLASSES.iter().find(|(known, ..)| *known == name).map(|&(_, class, _)| class)
}

/// Every crate has a class.
pub(super) fn check(crates: &[String], breaches: &mut Vec<Breach>) {
    let name_of = |path: &String| path.rsplit('/').next().map(str::to_owned).unwrap_or_default();
    for name in crates.iter().filter(|path| class_of(&name_of(path)).is_none()) {
        breaches.push(Breach::new(
            &format!("crates/{name}/Cargo.toml"),
            0,
            "the crate has no class: add it to CLASSES in xtask/src/tidy/crate_classes.rs, with the reason",
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crate_without_a_class_is_a_breach() {
        let mut breaches = Vec::new();
        check(&["any-system/return-map".into(), "both/new-crate".into()], &mut breaches);
        assert_eq!(breaches.len(), 1);
        assert_eq!(breaches[0].file, "crates/both/new-crate/Cargo.toml");
    }

    #[test]
    fn generic_crates_have_a_class() {
        assert!(GENERIC.iter().all(|name| class_of(name).is_some()));
    }
}
