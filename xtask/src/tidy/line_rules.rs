//! Code that files and lines may not contain.

use super::breach::Breach;
use super::crate_classes::{CrateClass, GENERIC, class_of};
use super::sources::Source;

/// The crate and the file that look for Ctrl-C now and then. No result depends on the clock.
const WITH_CLOCK: (&str, &str) = ("python-package", "interruptible.rs");
/// The crates and the file with calls of loops compiled for wider vectors, after a check of the processor, and with calls of functions of C.
const WITH_UNSAFE_CODE: [(&str, &str); 3] =
    [("passive-hopper", "simd.rs"), ("equations", "simd.rs"), ("python-package", "c_function.rs")];
/// The crate and the file with calls of the root finder of the `roots` crate, on brackets that are certain.
const WITH_ROOTS: (&str, &str) = ("interval-arithmetic", "bracketed_root.rs");
/// Largest number of lines of a file. The numerical crates that were read as examples stay below it. In this project
/// each longer file contained more than one concept.
const LONGEST_FILE: usize = 400;

const PRINTING: [&str; 5] = ["print!(", "println!(", "eprint!(", "eprintln!(", "dbg!("];
const FILES: [&str; 3] = ["std::fs", "std::env", "std::process"];
const OUTSIDE: [&str; 4] = ["std::net", "rand::", "SystemTime", "Instant"];
const PANICS: [&str; 8] = [
    ".unwrap()",
    ".expect(",
    "panic!(",
    "unreachable!(",
    "todo!(",
    "unimplemented!(",
    "assert!(",
    "assert_eq!(",
];

/// Checks one file.
pub(super) fn check(source: &Source, breaches: &mut Vec<Breach>) {
    let (name, text) = (source.name.as_str(), source.text.as_str());
    let mut breach = |line: usize, rule: &str| breaches.push(Breach::new(name, line, rule));
    if name.ends_with(".toml") {
        // A fuzz crate is not part of the workspace, since it needs another compiler; nor is a program that other
        // software is compared with. Therefore they have their own versions.
        let outside = ["/fuzz/", "/peers-diffsol/"].iter().any(|folder| name.contains(folder));
        if name.ends_with("Cargo.toml") && !outside {
            check_manifest(text, &mut breach);
        }
        return;
    }
    if text.lines().count() > LONGEST_FILE {
        breach(0, "over 400 lines: one concept a file");
    }
    let in_crate = source.crate_name();
    if in_crate.is_some() && source.in_src().is_some() && !text.starts_with("//!") {
        breach(1, "a library file starts with what it holds: //!");
    }
    // A crate without a class is treated like the strictest class; `crate_classes` reports it.
    let class = in_crate.map(|name| class_of(name).unwrap_or(CrateClass::Computing));
    for (at, line) in (1..).zip(text.lines()) {
        let code = line.trim_start();
        if in_crate.is_some_and(|name| GENERIC.contains(&name))
            && line.to_lowercase().contains("hopper")
        {
            breach(at, "a generic crate does not know the hopper");
        }
        // This file itself contains the words.
        if has(code, &["TODO", "FIXME", "XXX"]) && !name.ends_with("tidy/line_rules.rs") {
            breach(at, "unfinished: finish it, or file an issue");
        }
    }
    // Tests may contain code that a library may not contain.
    let Some(class) = class.filter(|_| source.in_src().is_some()) else { return };
    for (at, line) in source.lines_before_tests() {
        let code = line.trim_start();
        if code.starts_with("//") {
            continue;
        }
        if class != CrateClass::Program && has(code, &PRINTING) {
            breach(at, "libraries do not print");
        }
        if class != CrateClass::Program && has(code, &OUTSIDE) && !is(source, WITH_CLOCK)
            || matches!(class, CrateClass::Computing | CrateClass::TestSupport) && has(code, &FILES)
        {
            breach(at, "libraries read no files, clocks, environment or random numbers");
        }
        // An assertion of constants fails when the crate is compiled, never when it runs.
        let compiled = code.starts_with("const { assert!(");
        if class != CrateClass::TestSupport && has(code, &PANICS) && !compiled {
            breach(at, "libraries return errors as values");
        }
        let may_be_unsafe = WITH_UNSAFE_CODE.iter().any(|place| is(source, *place));
        if has(code, &["unsafe ", "unsafe{", "unsafe_code"]) && !may_be_unsafe {
            breach(
                at,
                "unsafe code is in simd.rs of passive-hopper and of equations, and in c_function.rs of python-package, alone",
            );
        }
        if code.contains("roots::") && !is(source, WITH_ROOTS) {
            breach(at, "only bracketed_root.rs of interval-arithmetic uses the roots crate");
        }
    }
}

/// Whether a file is the one of that name in a crate, in any folder.
fn is(source: &Source, (in_crate, file): (&str, &str)) -> bool {
    source.crate_name() == Some(in_crate) && source.name.rsplit('/').next() == Some(file)
}

fn has(code: &str, words: &[&str]) -> bool {
    words.iter().any(|word| code.contains(word))
}

fn check_manifest(text: &str, breach: &mut impl FnMut(usize, &str)) {
    // A package that is a workspace of its own has no other table.
    if text.lines().any(|line| line == "[workspace]") {
        return;
    }
    let mut in_dependencies = false;
    for (index, line) in text.lines().enumerate() {
        if line.starts_with('[') {
            in_dependencies = line.ends_with("dependencies]");
        } else if in_dependencies && line.contains('=') && !line.contains("workspace = true") {
            breach(index + 1, "versions live in the workspace table");
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(name: &str, text: &str) -> Vec<String> {
        let mut breaches = Vec::new();
        check(&Source::new(name, text), &mut breaches);
        breaches.into_iter().map(|breach| breach.rule).collect()
    }

    #[test]
    fn breaches_are_found() {
        let generic = "crates/any-system/return-map/src/x.rs";
        assert_eq!(
            rules(generic, "//! Of the Hopper.\n"),
            ["a generic crate does not know the hopper"]
        );
        assert_eq!(
            rules(generic, "//! X.\nlet y = x.unwrap();\n"),
            ["libraries return errors as values"]
        );
        assert!(rules(generic, "//! X.\nconst { assert!(N > 1) };\n").is_empty());
        assert_eq!(rules(generic, "//! X.\nuse roots::find_root_brent;\n").len(), 1);
        assert_eq!(rules(generic, "//! X.\nprintln!(\"{x}\");\n").len(), 1);
        assert_eq!(rules(generic, "//! X.\n#![allow(unsafe_code)]\nunsafe { x() };\n").len(), 2);
        assert!(
            rules("crates/hopper/passive-hopper/src/kernel/simd.rs", "//! X.\nunsafe { x() };\n")
                .is_empty()
        );
        assert_eq!(rules("crates/both/x/Cargo.toml", "[dependencies]\nserde = \"1\"\n").len(), 1);
        assert!(rules("xtask/src/x.rs", &"\n".repeat(401)).len() == 1);
        assert!(
            rules(generic, "//! X.\n/// x.unwrap()\n#[cfg(test)]\nmod tests {\nassert!(x);\n")
                .is_empty()
        );
    }

    #[test]
    fn a_class_decides_about_files_and_printing() {
        let (files, print) = ("//! X.\nuse std::fs::File;\n", "//! X.\nprintln!(\"{x}\");\n");
        assert_eq!(rules("crates/hopper/passive-hopper/src/x.rs", files).len(), 1);
        assert_eq!(rules("crates/both/resumable-job/src/x.rs", files).len(), 0);
        assert_eq!(rules("crates/both/resumable-job/src/x.rs", print).len(), 1);
        assert_eq!(rules("crates/hopper/hopper-studies/src/x.rs", print).len(), 0);
        assert_eq!(rules("crates/both/without-a-class/src/x.rs", files).len(), 1);
    }
}
