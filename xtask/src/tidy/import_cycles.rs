//! No import cycles between the files of a crate.
//!
//! Two files that import each other can only be read together. Without cycles the files of a crate have
//! layers, and each can be read after those that it imports.

use super::breach::Breach;
use super::imports::imports;
use super::module_tree::{Module, module_of, modules};
use super::sources::Source;
use std::collections::VecDeque;

/// Crates whose cycles are known and being removed.
const NOT_YET: [&str; 1] = ["passive-hopper"];

/// Reports one shortest cycle for each group of files that import one another.
pub(super) fn check(files: &[Source], breaches: &mut Vec<Breach>) {
    let modules = modules(files);
    if modules.iter().any(|m| m.source.crate_name().is_some_and(|name| NOT_YET.contains(&name))) {
        return;
    }
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
    let file = |path: &[String]| {
        let target = module_of(modules, path)?;
        modules.iter().position(|other| other.path == target.path && other.path != module.path)
    };
    imports(module).iter().filter_map(|import| file(&import.path)).collect()
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
    fn layers_are_no_cycle() {
        let layers = [("a.rs", "use crate::b::B;\n"), ("b.rs", ""), ("lib.rs", "pub use a::A;\n")];
        assert_eq!(rules(&layers), [""; 0]);
    }
}
