//! No import cycles between the files of a crate.
//!
//! Two files that import each other can only be read together. Without cycles the files of a crate have
//! layers, and each can be read after those that it imports.
//!
//! A re-export, `pub use door::Door` in `room/mod.rs`, is no import of its own: it is a table of contents. Who imports
//! `room::Door` depends on `room/door.rs`.

use super::breach::Breach;
use super::imports::imports;
use super::module_tree::{Module, module_of, modules};
use super::sources::Source;
use std::collections::VecDeque;

/// Reports one shortest cycle for each group of files that import one another.
pub(super) fn check(files: &[Source], breaches: &mut Vec<Breach>) {
    let modules = modules(files);
    let edges: Vec<Vec<usize>> = modules.iter().map(|module| targets(module, &modules)).collect();
    let mut reported = vec![false; modules.len()];
    for start in 0..modules.len() {
        let Some(cycle) = shortest_cycle(&edges, start) else { continue };
        // The same cycle from another of its files.
        if cycle.iter().any(|&file| reported[file]) {
            continue;
        }
        cycle.iter().for_each(|&file| reported[file] = true);
        let names: Vec<_> = cycle.iter().chain(&cycle[..1]).map(|&k| short(&modules[k])).collect();
        let rule = format!(
            "import cycle {}: move what both need into a file of its own",
            names.join(" → ")
        );
        breaches.push(Breach::new(&modules[start].source.name, 0, rule));
    }
}

/// The other files that a file imports from.
fn targets(module: &Module, modules: &[Module]) -> Vec<usize> {
    let own = imports(module, modules).into_iter();
    let used = own.filter(|import| !(import.is_public && is_below(module, &import.path)));
    let file = |path: &[String]| {
        let target = definition(path, modules, MOST_RE_EXPORTS)?;
        modules.iter().position(|other| other.path == target && other.path != module.path)
    };
    used.filter_map(|import| file(&import.path)).collect()
}

/// Whether a path leads into the module's own folder.
fn is_below(module: &Module, path: &[String]) -> bool {
    path.len() > module.path.len() && module.path.iter().zip(path).all(|(a, b)| a == b)
}

/// Re-exports of re-exports that are followed. A room inside a room has two; the limit ends a circle of them.
const MOST_RE_EXPORTS: usize = 8;

/// The path of the module that defines an item, through the re-exports on the way.
fn definition<'a>(path: &[String], modules: &[Module<'a>], left: usize) -> Option<Vec<&'a str>> {
    let found = module_of(modules, path)?;
    let export = path.get(found.path.len()).filter(|_| left > 0).and_then(|item| {
        let public = imports(found, modules).into_iter().filter(|import| import.is_public);
        public.map(|import| import.path).find(|path| path.last() == Some(item))
    });
    export.map_or_else(|| Some(found.path.clone()), |path| definition(&path, modules, left - 1))
}

fn short<'a>(module: &Module<'a>) -> &'a str {
    module.source.in_src().unwrap_or(&module.source.name)
}

/// The files of a shortest way from `start` back to itself, `start` first; breadth first.
fn shortest_cycle(edges: &[Vec<usize>], start: usize) -> Option<Vec<usize>> {
    let mut before: Vec<Option<usize>> = vec![None; edges.len()];
    let mut queue = VecDeque::from([start]);
    while let Some(file) = queue.pop_front() {
        for &next in &edges[file] {
            if next == start {
                let back = std::iter::successors(Some(file), |&file| before[file]);
                let mut cycle: Vec<usize> = back.collect();
                cycle.reverse();
                return Some(cycle);
            }
            // `start` has no file before it, so a visited file is one with a predecessor.
            if before[next].is_none() {
                before[next] = Some(file);
                queue.push_back(next);
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::module_tree::planted;
    use super::*;

    fn rules(files: &[(&str, &str)]) -> Vec<String> {
        let mut breaches = Vec::new();
        check(&planted::files(files), &mut breaches);
        breaches.into_iter().map(|breach| breach.rule).collect()
    }

    #[test]
    fn a_cycle_of_two_files_is_found_once() {
        let rules = rules(&[
            ("a.rs", "use crate::b::B;\n"),
            ("b.rs", "use super::a::A;\n"),
            ("c.rs", "use crate::{a::A, b::B};\n"),
            ("lib.rs", "pub use a::A;\n"),
        ]);
        assert_eq!(rules.len(), 1);
        assert!(rules[0].starts_with("import cycle a.rs → b.rs → a.rs:"), "{rules:?}");
    }

    #[test]
    fn a_cycle_through_a_folder_is_found() {
        let rules = rules(&[
            ("a.rs", "use crate::room::door::Door;\n"),
            ("lib.rs", ""),
            ("room/door.rs", "use super::wall::Wall;\n"),
            ("room/mod.rs", "mod door;\nmod wall;\n"),
            ("room/wall.rs", "use crate::a::A;\n"),
        ]);
        assert_eq!(rules.len(), 1);
        assert!(rules[0].contains("a.rs → room/door.rs → room/wall.rs → a.rs"), "{rules:?}");
    }

    #[test]
    fn a_cycle_through_re_exports_is_found() {
        let rules = rules(&[
            ("lib.rs", ""),
            ("room/door.rs", "use super::Wall;\n"),
            ("room/mod.rs", "mod door;\nmod wall;\npub use door::Door;\npub use wall::Wall;\n"),
            ("room/wall.rs", "use crate::room::Door;\n"),
        ]);
        assert_eq!(rules.len(), 1);
        assert!(rules[0].contains("room/door.rs → room/wall.rs → room/door.rs"), "{rules:?}");
    }

    #[test]
    fn a_folder_and_its_file_may_not_import_each_other() {
        let rules = rules(&[
            ("lib.rs", ""),
            ("room/door.rs", "use super::Key;\n"),
            ("room/mod.rs", "mod door;\nuse door::Door;\npub struct Key;\n"),
        ]);
        assert!(rules.len() == 1 && rules[0].contains("room/mod.rs"), "{rules:?}");
    }

    #[test]
    fn layers_are_no_cycle() {
        let layers = [("a.rs", "use crate::b::B;\n"), ("b.rs", ""), ("lib.rs", "pub use a::A;\n")];
        assert_eq!(rules(&layers), [""; 0]);
    }
}
