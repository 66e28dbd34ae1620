//! The packages of `Cargo.lock`.

use std::collections::BTreeSet;

/// A package.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Package {
    pub(super) name: String,
    pub(super) version: String,
    /// Where it comes from; `None` for a crate of the workspace.
    pub(super) source: Option<String>,
    /// Names of packages; of one with several versions with its version, as in "syn 2.0.119".
    pub(super) dependencies: Vec<String>,
    /// The line of its name, from one.
    pub(super) line: usize,
}

/// All packages of a lock file.
pub(super) fn packages(text: &str) -> Vec<Package> {
    let mut packages: Vec<Package> = Vec::new();
    for (line, content) in (1..).zip(text.lines()) {
        let value = |key: &str| {
            let rest = content.strip_prefix(key)?.strip_prefix(" = \"")?;
            rest.strip_suffix('"').map(str::to_owned)
        };
        if let Some(name) = value("name") {
            let (version, source, dependencies) = (String::new(), None, Vec::new());
            packages.push(Package { name, version, source, dependencies, line });
        }
        let Some(package) = packages.last_mut() else { continue };
        if let Some(version) = value("version") {
            package.version = version;
        }
        if let Some(source) = value("source") {
            package.source = Some(source);
        }
        let item = content.strip_prefix(" \"").and_then(|rest| rest.strip_suffix("\","));
        package.dependencies.extend(item.map(str::to_owned));
    }
    packages
}

/// The packages from outside that these names lead to, by the lock file. It has the dependencies of all systems and of all features
/// that any crate of the workspace uses, so that the number is an upper bound.
pub(super) fn reached(
    packages: &[Package],
    from: impl IntoIterator<Item = String>,
) -> BTreeSet<(&str, &str)> {
    let mut reached = BTreeSet::new();
    let mut open: Vec<String> = from.into_iter().collect();
    while let Some(wanted) = open.pop() {
        let (name, version) = wanted.split_once(' ').unwrap_or((&wanted, ""));
        let found = packages.iter().filter(|package| {
            package.name == name && (version.is_empty() || package.version == version)
        });
        for package in found.filter(|package| package.source.is_some()) {
            if reached.insert((package.name.as_str(), package.version.as_str())) {
                open.extend(package.dependencies.iter().cloned());
            }
        }
    }
    reached
}

#[cfg(test)]
mod tests {
    use super::*;

    const LOCK: &str = "version = 4\n\n[[package]]\nname = \"own\"\nversion = \"0.2.0\"\ndependencies = [\n \"a\",\n]\n\n\
        [[package]]\nname = \"a\"\nversion = \"1.0.0\"\nsource = \"registry\"\ndependencies = [\n \"b 2.0.0\",\n]\n\n\
        [[package]]\nname = \"b\"\nversion = \"1.0.0\"\nsource = \"registry\"\n\n\
        [[package]]\nname = \"b\"\nversion = \"2.0.0\"\nsource = \"registry\"\n";

    #[test]
    fn packages_lead_to_others() {
        let all = packages(LOCK);
        assert_eq!(all.len(), 4);
        assert_eq!((all[0].source.as_deref(), all[0].line), (None, 4));
        assert_eq!(all[1].dependencies, ["b 2.0.0"]);
        let reached = reached(&all, ["a".to_owned()]);
        assert_eq!(reached.into_iter().collect::<Vec<_>>(), [("a", "1.0.0"), ("b", "2.0.0")]);
    }
}
