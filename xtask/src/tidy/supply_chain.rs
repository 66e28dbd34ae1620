//! Packages from outside come from one registry, and each has one version. Exceptions are named in `.deny.toml`, which `cargo deny`
//! reads as well.

use super::breach::Breach;
use super::lock_file::Package;
use super::sources::Source;
use std::collections::BTreeMap;

/// The file of the rules on packages from outside.
pub(super) const RULES: &str = ".deny.toml";

/// The registry that all packages come from.
const REGISTRY: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Checks the packages of the lock file.
pub(super) fn check(rules: &Source, packages: &[Package], breaches: &mut Vec<Breach>) {
    let outside = || packages.iter().filter(|package| package.source.is_some());
    for package in outside().filter(|package| package.source.as_deref() != Some(REGISTRY)) {
        let rule =
            format!("{} does not come from crates.io: take a published version", package.name);
        breaches.push(Breach::new("Cargo.lock", package.line, rule));
    }
    let mut versions: BTreeMap<&str, Vec<&Package>> = BTreeMap::new();
    outside().for_each(|package| versions.entry(&package.name).or_default().push(package));
    let skipped = skipped(&rules.text);
    let is_skipped = |package: &Package| {
        let own = format!("{}@{}", package.name, package.version);
        skipped.iter().any(|(_, name)| *name == own)
    };
    for (name, all) in &versions {
        let kept: Vec<_> = all.iter().filter(|package| !is_skipped(package)).collect();
        if let [_, second, ..] = kept[..] {
            let rule = format!(
                "{name} has {} versions: unite them, or name the older ones with the reason in `skip` of {RULES}",
                kept.len()
            );
            breaches.push(Breach::new("Cargo.lock", second.line, rule));
        }
    }
    for (line, exception) in &skipped {
        let is_there = outside().any(|p| format!("{}@{}", p.name, p.version) == *exception);
        let name = exception.split('@').next().unwrap_or_default();
        if !is_there || versions.get(name).is_none_or(|all| all.len() < 2) {
            let rule = format!("{exception} has no second version any more: remove the exception");
            breaches.push(Breach::new(RULES, *line, rule));
        }
    }
}

/// The exceptions, `name@version`, with their lines.
fn skipped(rules: &str) -> Vec<(usize, &str)> {
    let entries = (1..).zip(rules.lines()).filter_map(|(at, line)| {
        let rest = line.trim().strip_prefix("{ crate = \"")?;
        Some((at, rest.split_once('"')?.0))
    });
    entries.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn package(name: &str, version: &str, source: Option<&str>) -> Package {
        let source = source.map(str::to_owned);
        Package {
            name: name.into(),
            version: version.into(),
            source,
            dependencies: vec![],
            line: 7,
        }
    }

    fn rules(exceptions: &str, packages: &[Package]) -> Vec<String> {
        let mut breaches = Vec::new();
        check(&Source::new(RULES, exceptions), packages, &mut breaches);
        breaches.into_iter().map(|breach| breach.rule).collect()
    }

    #[test]
    fn a_second_version_needs_an_exception() {
        let two = ["1.0.0", "2.0.0"].map(|version| package("a", version, Some(REGISTRY)));
        assert!(rules("", &two)[0].contains("a has 2 versions"));
        assert_eq!(rules("    { crate = \"a@1.0.0\", reason = \"b needs it\" },\n", &two), [""; 0]);
        let one = &two[1..];
        assert!(rules("{ crate = \"a@2.0.0\" },\n", one)[0].contains("remove the exception"));
        assert_eq!(rules("{ crate = \"a@3.0.0\" },\n", one).len(), 1);
    }

    #[test]
    fn a_package_from_elsewhere_is_a_breach() {
        let own = package("own", "0.2.0", None);
        let git = package("a", "1.0.0", Some("git+https://example.org/a"));
        assert!(rules("", &[own, git])[0].contains("a does not come from crates.io"));
    }
}
