//! Every package has a licence that `.deny.toml` allows.
//!
//! The licences are in the manifests of the packages, which `cargo metadata` reads.

use super::breach::Breach;
use super::sources::Source;
use super::supply_chain::RULES;
use std::path::Path;
use std::process::Command;

/// Checks the licences of all packages.
pub(super) fn check(root: &Path, rules: &Source, breaches: &mut Vec<Breach>) {
    match all_packages(root).or_else(|| packages_of_this_platform(root)) {
        Some(metadata) => check_all(&metadata, &rules.text, breaches),
        None => {
            let rule = "the licences of the packages cannot be read: run `cargo fetch` once";
            breaches.push(Breach::new("Cargo.lock", 0, rule));
        }
    }
}

/// The packages of all platforms. A build for one platform has not downloaded those of the others: they are downloaded now.
fn all_packages(root: &Path) -> Option<String> {
    metadata(root, &["--offline"]).or_else(|| metadata(root, &["--config", "net.retry=0"]))
}

/// The packages that a build on this machine has, where there is no network: the licences of other platforms' packages are then not seen.
fn packages_of_this_platform(root: &Path) -> Option<String> {
    let version = output(Command::new("rustc").arg("-vV").current_dir(root))?;
    let platform = version.lines().find_map(|line| line.strip_prefix("host: "))?;
    metadata(root, &["--offline", "--filter-platform", platform])
}

fn metadata(root: &Path, options: &[&str]) -> Option<String> {
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut cargo = Command::new(program);
    cargo.args(["metadata", "--locked", "--format-version", "1"]).args(options).current_dir(root);
    output(&mut cargo)
}

/// What a command prints; `None` if it fails.
fn output(command: &mut Command) -> Option<String> {
    let done = command.output().ok().filter(|done| done.status.success())?;
    Some(String::from_utf8_lossy(&done.stdout).into_owned())
}

fn check_all(metadata: &str, rules: &str, breaches: &mut Vec<Breach>) {
    let allowed = allowed(rules);
    for (package, licence) in licences(metadata) {
        let fine = licence.is_some_and(|licence| is_allowed(licence, &allowed));
        if !fine {
            let licence = licence.unwrap_or("none");
            let rule = format!(
                "the licence of {package} is {licence}: allow it in {RULES}, or do without"
            );
            breaches.push(Breach::new("Cargo.lock", 0, rule));
        }
    }
}

/// The names of the packages with their licences. In the text of `cargo metadata` a package begins with these four fields.
fn licences(metadata: &str) -> impl Iterator<Item = (&str, Option<&str>)> {
    metadata.split("{\"name\":\"").filter_map(|text| {
        let (name, rest) = text.split_once("\",\"version\":\"")?;
        let (_, rest) = rest.split_once("\",\"id\":\"")?;
        let (_, rest) = rest.split_once("\",\"license\":")?;
        let quoted = rest.strip_prefix('"').and_then(|rest| rest.split_once('"'));
        Some((name, quoted.map(|(licence, _)| licence)))
    })
}

/// The strings of `allow`.
fn allowed(rules: &str) -> Vec<&str> {
    let list = rules.split_once("\nallow = [").and_then(|(_, rest)| rest.split_once(']'));
    let text = list.map_or("", |(list, _)| list);
    // Every second part is between quotes.
    text.split('"').skip(1).step_by(2).collect()
}

/// Whether an SPDX expression can be fulfilled with the allowed licences. Old manifests write "/" for OR.
fn is_allowed(expression: &str, allowed: &[&str]) -> bool {
    let spaced = expression.replace('/', " OR ").replace('(', " ( ").replace(')', " ) ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    let mut at = 0;
    any_of(&words, &mut at, allowed) && at == words.len()
}

/// a OR b OR …
fn any_of(words: &[&str], at: &mut usize, allowed: &[&str]) -> bool {
    let mut fine = all_of(words, at, allowed);
    while words.get(*at) == Some(&"OR") {
        *at += 1;
        fine |= all_of(words, at, allowed);
    }
    fine
}

/// a AND b AND …
fn all_of(words: &[&str], at: &mut usize, allowed: &[&str]) -> bool {
    let mut fine = one(words, at, allowed);
    while words.get(*at) == Some(&"AND") {
        *at += 1;
        fine &= one(words, at, allowed);
    }
    fine
}

/// A licence, one with an exception, or an expression in parentheses.
fn one(words: &[&str], at: &mut usize, allowed: &[&str]) -> bool {
    let Some(&word) = words.get(*at) else { return false };
    *at += 1;
    if word == "(" {
        let fine = any_of(words, at, allowed);
        let closed = words.get(*at) == Some(&")");
        *at += 1;
        return fine && closed;
    }
    if words.get(*at) == Some(&"WITH") {
        let with = format!("{word} WITH {}", words.get(*at + 1).unwrap_or(&""));
        *at += 2;
        return allowed.contains(&with.as_str());
    }
    allowed.contains(&word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expressions_are_fulfilled_or_not() {
        let allowed = ["MIT", "Zlib", "Apache-2.0 WITH LLVM-exception"];
        let fine = [
            "MIT",
            "MIT OR GPL-3.0",
            "GPL-3.0/MIT",
            "(MIT OR X) AND Zlib",
            "Apache-2.0 WITH LLVM-exception",
        ];
        assert!(fine.iter().all(|expression| is_allowed(expression, &allowed)));
        let refused = [
            "",
            "GPL-3.0",
            "MIT AND GPL-3.0",
            "Apache-2.0",
            "(MIT",
            "MIT)",
            "MIT OR",
            "OR MIT MIT",
        ];
        for expression in refused {
            // "MIT OR" ends too early, but MIT alone is enough to use the package.
            assert!(expression == "MIT OR" || !is_allowed(expression, &allowed), "{expression}");
        }
    }

    #[test]
    fn a_package_with_another_licence_is_a_breach() {
        let metadata = "{\"packages\":[{\"name\":\"a\",\"version\":\"1.0.0\",\"id\":\"r#a\",\"license\":\"MIT\",\"dependencies\":[{\"name\":\"b\",\"source\":null}]},\
            {\"name\":\"b\",\"version\":\"1.0.0\",\"id\":\"r#b\",\"license\":\"GPL-3.0\"},{\"name\":\"c\",\"version\":\"1.0.0\",\"id\":\"r#c\",\"license\":null}]}";
        let mut breaches = Vec::new();
        check_all(metadata, "[licenses]\nallow = [\n    \"MIT\", # ours\n]\n", &mut breaches);
        let rules: Vec<_> = breaches.iter().map(|breach| breach.rule.as_str()).collect();
        assert!(
            rules.len() == 2 && rules[0].contains("b is GPL-3.0") && rules[1].contains("c is none"),
            "{rules:?}"
        );
    }
}
