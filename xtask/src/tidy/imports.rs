//! What a file imports from its own crate.

use super::module_tree::Module;

/// An imported path.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Import {
    /// The line on which its `use` begins, from one.
    pub(super) line: usize,
    /// The path from the crate's root, without `crate`; the last name may be an item.
    pub(super) path: Vec<String>,
    /// Whether it is `pub`, so that other files find the item here too.
    pub(super) is_public: bool,
}

/// The imports of a file from its own crate: `use crate::…`, `use super::…`, and `use child::…` of a file with
/// modules.
///
/// Tests are left out: they may use whatever the crate has.
pub(super) fn imports(module: &Module, modules: &[Module]) -> Vec<Import> {
    let mut found = Vec::new();
    let mut statement: Option<(usize, bool, String)> = None;
    for (line, text) in module.source.lines_before_tests() {
        let code = text.split("//").next().unwrap_or_default().trim();
        if let Some((.., so_far)) = &mut statement {
            so_far.push_str(code);
        } else {
            statement =
                after_use(code).map(|rest| (line, code.starts_with("pub"), rest.to_owned()));
        }
        if let Some((line, is_public, whole)) = statement.take_if(|(.., text)| text.contains(';')) {
            let tree = whole.split(';').next().unwrap_or_default();
            let paths =
                paths(tree).into_iter().filter_map(|path| from_root(module, modules, &path));
            found.extend(paths.map(|path| Import { line, path, is_public }));
        }
    }
    found
}

/// The rest of a line that begins with `use`, after an optional `pub` or `pub(…)`.
fn after_use(code: &str) -> Option<&str> {
    let code = match code.strip_prefix("pub") {
        None => code,
        Some(rest) if rest.starts_with('(') => rest.split_once(')')?.1.trim_start(),
        Some(rest) => rest.trim_start(),
    };
    code.strip_prefix("use ")
}

/// The single paths of a tree such as `a::{b, c::{d, e}}`.
fn paths(tree: &str) -> Vec<Vec<String>> {
    let names = |text: &str| -> Vec<String> {
        // `a as b` imports a.
        let name = |part: &str| part.split_whitespace().next().unwrap_or_default().to_owned();
        text.split("::").map(name).filter(|name| !name.is_empty()).collect()
    };
    let Some((head, rest)) = tree.split_once('{') else { return vec![names(tree)] };
    let inside = rest.rsplit_once('}').map_or(rest, |(inside, _)| inside);
    let head = names(head);
    let branches = split_outside_braces(inside).into_iter().flat_map(paths);
    branches.map(|branch| head.iter().cloned().chain(branch).collect()).collect()
}

/// The parts between commas that are not inside braces, without empty ones.
fn split_outside_braces(text: &str) -> Vec<&str> {
    let (mut parts, mut depth, mut from) = (Vec::new(), 0usize, 0);
    for (at, c) in text.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth = depth.saturating_sub(1),
            ',' if depth == 0 => {
                parts.push(&text[from..at]);
                from = at + 1;
            }
            _ => {}
        }
    }
    parts.push(&text[from..]);
    parts.retain(|part| !part.trim().is_empty());
    parts
}

/// The path from the crate's root; `None` if it leads to another crate.
fn from_root(module: &Module, modules: &[Module], path: &[String]) -> Option<Vec<String>> {
    let supers = path.iter().take_while(|name| *name == "super").count();
    let is_child = |name: &str| {
        let child = |other: &Module| {
            other
                .path
                .split_last()
                .is_some_and(|(last, above)| *last == name && above == module.path)
        };
        modules.iter().any(child)
    };
    let (above, rest) = match path.first().map(String::as_str)? {
        "crate" => (0, &path[1..]),
        "super" => (module.path.len().checked_sub(supers)?, &path[supers..]),
        "self" => (module.path.len(), &path[1..]),
        name if is_child(name) => (module.path.len(), path),
        _ => return None,
    };
    let names = rest.iter().filter(|name| *name != "self").cloned();
    Some(module.path[..above].iter().map(|name| (*name).to_owned()).chain(names).collect())
}

#[cfg(test)]
mod tests {
    use super::super::module_tree::{modules, planted};
    use super::*;

    fn imported(file: &str, text: &str) -> Vec<String> {
        let files = planted::files(&[("lib.rs", ""), (file, text)]);
        let modules = modules(&files);
        let module = modules.iter().find(|module| module.source.name.ends_with(file)).unwrap();
        imports(module, &modules).into_iter().map(|import| import.path.join("::")).collect()
    }

    #[test]
    fn trees_are_taken_apart() {
        let text = "use crate::{Error, map::{self, orbit::{Orbit, orbit as o}}};\nuse std::fmt;\n";
        assert_eq!(
            imported("x.rs", text),
            ["Error", "map", "map::orbit::Orbit", "map::orbit::orbit"]
        );
    }

    #[test]
    fn super_is_the_module_above() {
        assert_eq!(imported("map/orbit.rs", "pub(crate) use super::Map;\n"), ["map::Map"]);
        assert_eq!(imported("map/mod.rs", "use super::error::Error;\n"), ["error::Error"]);
        assert_eq!(imported("map/orbit.rs", "use super::super::Error;\n"), ["Error"]);
    }

    #[test]
    fn lines_are_joined_and_comments_and_tests_left_out() {
        let text = "// use crate::a;\nuse crate::{ // why\n    b,\n    c,\n};\n#[cfg(test)]\nmod tests {\n    use crate::d;\n}\n";
        assert_eq!(imported("x.rs", text), ["b", "c"]);
    }
}
