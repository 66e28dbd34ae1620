//! The README says how many packages from outside each crate needs, so that the number does not grow unseen.

use super::breach::Breach;
use super::lock_file::{Package, reached};
use super::sources::Source;
use std::collections::BTreeSet;

/// The page with the table of crates.
const PAGE: &str = "README.md";

/// Compares the last column of the table with the lock file. Development dependencies do not count.
pub(super) fn check(
    page: &Source,
    manifests: &[&Source],
    packages: &[Package],
    breaches: &mut Vec<Breach>,
) {
    for manifest in manifests {
        let name = manifest.crate_name().unwrap_or_else(|| manifest.package());
        let count = count(name, manifests, packages);
        let row = (1..)
            .zip(page.text.lines())
            .find(|(_, line)| line.starts_with(&format!("| `{name}` |")));
        let Some((at, line)) = row else {
            let rule = format!(
                "the table of crates has no row for `{name}`: add it, with {count} packages"
            );
            breaches.push(Breach::new(PAGE, 0, rule));
            continue;
        };
        let said = line.trim_end_matches([' ', '|']).rsplit('|').next().unwrap_or_default().trim();
        if said != count.to_string() {
            let rule = format!(
                "`{name}` needs {count} packages from outside, not {said}: is that worth it? Then write {count}"
            );
            breaches.push(Breach::new(PAGE, at, rule));
        }
    }
}

/// The number of packages from outside that a crate needs, itself and through other crates of the workspace.
fn count(name: &str, manifests: &[&Source], packages: &[Package]) -> usize {
    let (mut open, mut seen) = (vec![name.to_owned()], BTreeSet::new());
    let mut outside = Vec::new();
    while let Some(name) = open.pop() {
        if !seen.insert(name.clone()) {
            continue;
        }
        match manifests.iter().find(|own| own.crate_name().unwrap_or(own.package()) == name) {
            Some(manifest) => open.extend(dependencies(&manifest.text)),
            None => outside.push(name),
        }
    }
    reached(packages, outside).len()
}

/// The dependencies of a manifest, without those for development.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut inside = false;
    let mut names = Vec::new();
    for line in manifest.lines() {
        if line.starts_with('[') {
            inside = line.ends_with("dependencies]") && !line.contains("dev-dependencies");
        } else if inside && line.starts_with(|c: char| c.is_ascii_alphanumeric()) {
            let name = line.split(['.', ' ', '=']).next().unwrap_or_default();
            names.push(name.to_owned());
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tidy::lock_file;

    #[test]
    fn a_number_that_grows_is_a_breach() {
        let outside = |name: &str| {
            format!("[[package]]\nname = \"{name}\"\nversion = \"1.0.0\"\nsource = \"r\"\n")
        };
        let lock = format!(
            "{}dependencies = [\n \"y\",\n]\n{}{}",
            outside("x"),
            outside("y"),
            outside("z")
        );
        let packages = lock_file::packages(&lock);
        let low = Source::new(
            "crates/low/Cargo.toml",
            "[dependencies]\nx.workspace = true\n\n[dev-dependencies]\nz = \"1\"\n",
        );
        let high = Source::new("crates/high/Cargo.toml", "[dependencies]\nlow.workspace = true\n");
        let found = |page: &str| {
            let mut breaches = Vec::new();
            check(&Source::new(PAGE, page), &[&low, &high], &packages, &mut breaches);
            breaches.into_iter().map(|breach| breach.rule).collect::<Vec<_>>()
        };
        assert_eq!(found("| `low` | text | 2 |\n| `high` | text | 2 |\n"), [""; 0]);
        let rules = found("| `low` | text | 1 |\n");
        assert!(rules[0].starts_with("`low` needs 2 packages from outside, not 1"), "{rules:?}");
        assert!(rules[1].contains("no row for `high`"));
    }
}
