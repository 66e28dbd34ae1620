//! Every file of tests runs: where a package turns off the search for tests, `tests/all.rs` or the manifest names them.
//!
//! One program of tests compiles what its files share once. A file that nobody names would never run, without a word.

use super::breach::Breach;
use super::sources::Source;

/// A file directly in `tests` of a package without the search for tests is named.
pub(super) fn check(sources: &[Source], breaches: &mut Vec<Breach>) {
    let text = |name: String| {
        sources.iter().find(|source| source.name == name).map_or("", |source| &source.text)
    };
    for source in sources {
        let Some(name) = test_file(source) else { continue };
        let manifest = text(format!("{}/Cargo.toml", source.package()));
        if !manifest.contains("autotests = false") {
            continue;
        }
        let all = text(format!("{}/tests/all.rs", source.package()));
        let is_target = manifest.contains(&format!("[[test]]\nname = \"{name}\"\n"));
        if !is_target && !all.contains(&format!("mod {name};\n")) {
            let rule = format!("no test of this file runs: add `mod {name};` to `tests/all.rs`");
            breaches.push(Breach::new(&source.name, 0, rule));
        }
    }
}

/// The name of a file directly in `tests`.
fn test_file(source: &Source) -> Option<&str> {
    let inside = source.name.strip_prefix(source.package())?.strip_prefix("/tests/")?;
    inside.strip_suffix(".rs").filter(|name| !name.contains('/'))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_of_tests_that_nobody_names_is_a_breach() {
        let found = |manifest: &str, all: &str| {
            let files = [
                ("crates/w/a/Cargo.toml", manifest),
                ("crates/w/a/tests/all.rs", all),
                ("crates/w/a/tests/x.rs", ""),
                ("crates/w/a/tests/data/y.rs", ""),
            ];
            let mut breaches = Vec::new();
            check(&files.map(|(name, text)| Source::new(name, text)), &mut breaches);
            breaches.into_iter().map(|breach| breach.file).collect::<Vec<_>>()
        };
        let one = "autotests = false\n[[test]]\nname = \"all\"\n";
        assert_eq!(found(one, "mod x;\n"), [""; 0]);
        assert_eq!(found(one, "mod other;\n"), ["crates/w/a/tests/x.rs"]);
        let own = format!("{one}[[test]]\nname = \"x\"\n");
        assert_eq!(found(&own, ""), [""; 0]);
        assert_eq!(found("autotests = false\n", "mod x;\n"), ["crates/w/a/tests/all.rs"]);
        assert_eq!(found("", ""), [""; 0]);
    }
}
