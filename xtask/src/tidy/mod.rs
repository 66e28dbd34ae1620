//! `tidy`: the rules of the repository, one file each, and a test that they hold.
//!
//! | rule | file |
//! |---|---|
//! | which crates may print, read files or use clocks | `crate_classes.rs` |
//! | code that a line may not contain | `line_rules.rs` |
//! | the workspace lists its members | `workspace_members.rs` |
//! | every file of tests is named by what runs it | `listed_tests.rs` |
//! | the root of the repository holds known names only | `root_folder.rs` |
//! | citations of `docs/theory.md` name statements that exist | `theory_citations.rs` |
//! | sources cited by name and year are in the bibliography | `bibliography.rs` |
//! | links lead to files and headings that exist | `links.rs` |
//! | nothing in a page is hidden by a mark; titles are those of the contents | `page_marks.rs` |
//! | the files and tests that the documentation names exist | `names_in_pages.rs` |

mod bibliography;
mod breach;
mod crate_classes;
mod line_rules;
pub(crate) mod links;
mod listed_tests;
mod names_in_pages;
mod one_line;
mod page_marks;
mod root_folder;
mod sources;
mod theory_citations;
mod workspace_members;

use crate::error::Error;
use crate::repository::repository;
use breach::Breach;
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

/// Prints every breach; an error if there is one.
pub(crate) fn run() -> Result<ExitCode, Error> {
    let breaches = breaches(&repository())?;
    let mut out = std::io::stdout().lock();
    for Breach { file, line, rule } in &breaches {
        writeln!(out, "{file}:{line}: {rule}").map_err(Error::at("standard output"))?;
    }
    match breaches.len() {
        0 => Ok(ExitCode::SUCCESS),
        count => Err(Error::new(format!("{count} breaches of the repository's rules"))),
    }
}

/// All breaches in the repository at `root`.
fn breaches(root: &Path) -> Result<Vec<Breach>, Error> {
    let sources = sources::collect(root)?;
    let mut breaches = Vec::new();
    for source in &sources {
        line_rules::check(source, &mut breaches);
    }
    listed_tests::check(&sources, &mut breaches);
    let crates = root_folder::crates(root)?;
    crate_classes::check(&crates, &mut breaches);
    workspace_members::check(&sources::read(root, "Cargo.toml")?.text, &crates, &mut breaches);
    root_folder::check(root, &mut breaches)?;
    let documents = sources::documents(root)?;
    theory_citations::check(&sources, &documents, &mut breaches);
    let bibliography = sources::read(root, bibliography::BIBLIOGRAPHY)?;
    bibliography::check(&bibliography, &sources, &documents, &mut breaches);
    links::check(root, &documents, &mut breaches);
    page_marks::check(&documents, &mut breaches);
    let pages: Vec<_> = documents.into_iter().filter(sources::is_page).collect();
    names_in_pages::check(&pages, &sources, &mut breaches);
    Ok(breaches)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_repository_is_tidy() {
        assert_eq!(breaches(&repository()).unwrap(), []);
    }
}
