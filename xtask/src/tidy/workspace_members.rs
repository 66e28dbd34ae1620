//! The workspace lists its members one by one.
//!
//! With `crates/*/*` any folder becomes a member. A folder whose tests cannot link here, such as an extension module of
//! another language, would break `cargo test --workspace`.

use super::breach::Breach;

/// Every crate is a member or excluded, by its own name.
pub(super) fn check(manifest: &str, crates: &[String], breaches: &mut Vec<Breach>) {
    let listed = [list(manifest, "members"), list(manifest, "exclude")].concat();
    for pattern in listed.iter().filter(|path| path.contains('*')) {
        let rule = format!("\"{pattern}\" is a pattern: list the members one by one");
        breaches.push(Breach::new("Cargo.toml", 0, rule));
    }
    for name in crates {
        if !listed.contains(&format!("crates/{name}")) {
            let rule = "not in the workspace: add it to `members` or `exclude` in Cargo.toml";
            breaches.push(Breach::new(&format!("crates/{name}/Cargo.toml"), 0, rule));
        }
    }
}

/// The strings of a list in the manifest, without comments; empty if there is no such list.
fn list(manifest: &str, key: &str) -> Vec<String> {
    let lines = manifest.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    let from_key = lines.skip_while(|line| line.split('=').next().map(str::trim) != Some(key));
    let text: String = from_key.collect();
    let inside = text.split_once('[').and_then(|(_, rest)| rest.split_once(']'));
    let strings = inside.map_or("", |(inside, _)| inside).split(',');
    strings.map(|item| item.trim().trim_matches('"').to_owned()).filter(|s| !s.is_empty()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(manifest: &str) -> Vec<String> {
        let mut breaches = Vec::new();
        check(manifest, &["w/a".into(), "w/b".into()], &mut breaches);
        breaches.into_iter().map(|breach| format!("{}: {}", breach.file, breach.rule)).collect()
    }

    #[test]
    fn every_crate_must_be_listed_in_the_workspace() {
        let listed = "[workspace]\n# why\nmembers = [\n  \"crates/w/a\", # here\n  \"xtask\",\n]\nexclude = \
                      [\"crates/w/b\"]\n";
        assert_eq!(rules(listed), [""; 0]);
        let missing = rules("[workspace]\nmembers = [\"crates/w/a\"]\n");
        assert!(missing.len() == 1 && missing[0].starts_with("crates/w/b/Cargo.toml: not in"));
        let pattern = rules("members = [\"crates/*\", \"crates/w/a\", \"crates/w/b\"]\n");
        assert!(pattern.len() == 1 && pattern[0].contains("one by one"), "{pattern:?}");
    }
}
