//! The files and tests that a page of the documentation names exist.
//!
//! A reader who looks for a file or a test under an old name finds nothing.

use super::breach::Breach;
use super::sources::Source;

/// The history of the project, which names files that no longer exist.
const HISTORY: &str = "docs/changelog.md";
/// The page with a table of equations and their tests.
const PAPER_MAP: &str = "docs/paper-map.md";
/// The header of the column of that table which names tests.
const TEST_COLUMN: &str = "tested in";

/// Every Rust file that a page names, and every test that the paper's map names, is in `sources`.
pub(super) fn check(pages: &[Source], sources: &[Source], breaches: &mut Vec<Breach>) {
    for page in pages.iter().filter(|page| page.name != HISTORY) {
        for (at, line) in (1..).zip(page.text.lines()) {
            for file in rust_files(line).filter(|file| !exists(file, sources)) {
                let rule = format!("names the file {file}, which does not exist");
                breaches.push(Breach::new(&page.name, at, rule));
            }
        }
        if page.name == PAPER_MAP {
            for (at, test) in tests(&page.text) {
                if !sources.iter().any(|source| source.text.contains(&format!("fn {test}("))) {
                    let rule = format!("names the test {test}, which does not exist");
                    breaches.push(Breach::new(&page.name, at, rule));
                }
            }
        }
    }
}

/// The Rust files in a line, without the `../` before them. A name in capitals, `NAME.rs`, stands for any name.
fn rust_files(line: &str) -> impl Iterator<Item = &str> {
    let is_path = |c: char| c.is_ascii_alphanumeric() || "_-./".contains(c);
    let words = line.split(move |c| !is_path(c)).map(|word| word.trim_start_matches("../"));
    words.filter(|word| {
        let stem = word.strip_suffix(".rs").map(|path| path.rsplit('/').next().unwrap_or(path));
        stem.is_some_and(|stem| stem.contains(|c: char| c.is_ascii_lowercase()))
    })
}

/// Whether a file has this path, or a path that ends with these folders and this name.
fn exists(file: &str, sources: &[Source]) -> bool {
    sources.iter().any(|source| {
        source.name.strip_suffix(file).is_some_and(|front| front.is_empty() || front.ends_with('/'))
    })
}

/// The names in backticks in the column of tests, each with its line from one. Names of files are left out.
fn tests(text: &str) -> Vec<(usize, &str)> {
    let mut column = None;
    let mut found = Vec::new();
    for (at, line) in (1..).zip(text.lines()) {
        if !line.starts_with('|') {
            column = None; // the table ends here
            continue;
        }
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let Some(place) = column else {
            // The header is the first row. A table without a column of tests gets a place that no row has.
            column = cells.iter().position(|cell| *cell == TEST_COLUMN).or(Some(usize::MAX));
            continue;
        };
        // Between backticks lie the odd parts of a cell that is split at them.
        let names =
            cells.get(place).into_iter().flat_map(|cell| cell.split('`').skip(1).step_by(2));
        let is_name = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        found.extend(names.filter(|name| name.chars().all(is_name)).map(|name| (at, name)));
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(page: &str, text: &str) -> Vec<String> {
        let sources = [
            Source::new("crates/w/a/src/room/door.rs", "    fn the_door_opens(m in 0.0..1.0) {\n"),
            Source::new("xtask/src/tidy/mod.rs", ""),
        ];
        let mut breaches = Vec::new();
        check(&[Source::new(page, text)], &sources, &mut breaches);
        breaches.into_iter().map(|breach| format!("{}: {}", breach.line, breach.rule)).collect()
    }

    #[test]
    fn files_that_exist_may_be_named_by_the_end_of_their_path() {
        let text =
            "`room/door.rs`, door.rs, [`../xtask/src/tidy/mod.rs`](x), `a/src/room/NAME.rs`.";
        assert_eq!(rules("docs/x.md", text), [""; 0]);
    }

    #[test]
    fn a_file_that_does_not_exist_is_a_breach() {
        for text in ["`window.rs`", "`oor.rs`", "`hall/door.rs`"] {
            let rules = rules("README.md", &format!("\n{text}\n"));
            assert!(rules.len() == 1 && rules[0].starts_with("2: names the file"), "{rules:?}");
        }
        assert_eq!(rules(HISTORY, "`window.rs`"), [""; 0]);
    }

    #[test]
    fn a_test_that_does_not_exist_is_a_breach() {
        let table = |test: &str| {
            format!(
                "| paper | here | tested in |\n|---|---|---|\n| x | `y` | `door.rs`: `{test}` |\n\n| a | b \
                 |\n|---|---|\n| `c` | `d` |\n"
            )
        };
        assert_eq!(rules(PAPER_MAP, &table("the_door_opens")), [""; 0]);
        assert_eq!(
            rules(PAPER_MAP, &table("the_door_shuts")),
            ["3: names the test the_door_shuts, which does not exist"]
        );
        assert_eq!(rules("docs/x.md", &table("the_door_shuts")), [""; 0]);
    }
}
