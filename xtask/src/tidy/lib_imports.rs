//! Inside a crate nothing is imported through `lib.rs`.
//!
//! `lib.rs` collects names for users of the crate. A file of the crate that imports from there hides which file
//! it depends on, and with that the layers.

use super::breach::Breach;
use super::imports::imports;
use super::module_tree::{module_of, modules};
use super::sources::Source;

/// Reports each import of a name that `lib.rs` has from another file.
pub(super) fn check(files: &[Source], breaches: &mut Vec<Breach>) {
    let modules = modules(files);
    for module in modules.iter().filter(|module| !module.is_root()) {
        for import in imports(module, &modules) {
            if module_of(&modules, &import.path).is_some_and(|target| target.is_root()) {
                let name = import.path.join("::");
                let rule = format!(
                    "`{name}` is imported through lib.rs: import it from the file that defines it"
                );
                breaches.push(Breach::new(&module.source.name, import.line, rule));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::module_tree::planted;
    use super::*;

    #[test]
    fn an_import_through_lib_is_found_with_its_line() {
        let mut breaches = Vec::new();
        let files = planted::files(&[
            ("a.rs", "//! A.\n\nuse crate::{B, b};\nuse super::b::C;\n"),
            ("b.rs", "use std::fmt;\n\n#[cfg(test)]\nmod tests {\n    use crate::A;\n}\n"),
            ("lib.rs", "pub use a::A;\npub use b::B;\n"),
        ]);
        check(&files, &mut breaches);
        assert_eq!(breaches.len(), 1);
        assert_eq!((breaches[0].file.as_str(), breaches[0].line), ("crates/x/src/a.rs", 3));
        assert!(breaches[0].rule.starts_with("`B` is imported through lib.rs"), "{breaches:?}");
    }
}
