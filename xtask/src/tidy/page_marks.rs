//! Marks of Markdown that hide text: an asterisk behind α begins emphasis, and a bar in a table begins a cell. And each page has the title
//! that the contents of the book give it.

use super::breach::Breach;
use super::links::{prose, resolve};
use super::sources::Source;

/// The contents of the book.
const SUMMARY: &str = "docs/book/SUMMARY.md";

/// Checks all pages.
pub(super) fn check(pages: &[Source], breaches: &mut Vec<Breach>) {
    for page in pages {
        let mut columns = None;
        let mut last = 0;
        for (at, line) in prose(&page.text) {
            if !line.starts_with("    ") && has_bare_star(&line) {
                breaches.push(Breach::new(&page.name, at, "write α\\*: a bare * begins emphasis"));
            }
            // A row follows the row before.
            columns = match line.starts_with('|') {
                false => None,
                true if last + 1 == at && columns.is_some() => columns,
                true => Some(cells(&line)),
            };
            last = at;
            // Code inside a cell is blank here, but its bars count for Markdown, too.
            let whole = page.text.lines().nth(at - 1).unwrap_or_default();
            if columns.is_some_and(|columns| cells(whole) != columns) {
                let rule = "the row has another number of cells than the head: write \\| for a bar in a cell";
                breaches.push(Breach::new(&page.name, at, rule));
            }
        }
    }
    if let Some(summary) = pages.iter().find(|page| page.name == SUMMARY) {
        check_titles(summary, pages, breaches);
    }
}

fn has_bare_star(line: &str) -> bool {
    line.match_indices("α*").any(|(at, mark)| !line[at + mark.len()..].starts_with('*'))
}

/// The cells of a row of a table: parts between bars that are not escaped.
fn cells(line: &str) -> usize {
    let line = line.replace("\\|", "  ");
    let line = line.trim();
    let line = line.strip_prefix('|').unwrap_or(line);
    line.strip_suffix('|').unwrap_or(line).split('|').count()
}

fn check_titles(summary: &Source, pages: &[Source], breaches: &mut Vec<Breach>) {
    for (at, line) in prose(&summary.text) {
        let entry = line.trim_start().trim_start_matches("- ");
        let Some((title, target)) = entry.strip_prefix('[').and_then(|rest| rest.split_once("]("))
        else {
            continue;
        };
        let page = resolve(SUMMARY, target.trim_end_matches(')'));
        let Some(page) = pages.iter().find(|own| Some(&own.name) == page.as_ref()) else {
            continue;
        };
        let heading =
            page.text.lines().find_map(|line| line.strip_prefix("# ")).unwrap_or_default();
        // The front page has the title of the book.
        if heading != title && title != "Front page" {
            let rule =
                format!("{} has the heading “{heading}”; give both the same title", page.name);
            breaches.push(Breach::new(SUMMARY, at, rule));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(pages: &[(&str, &str)]) -> usize {
        let pages: Vec<Source> = pages.iter().map(|(name, text)| Source::new(name, text)).collect();
        let mut breaches = Vec::new();
        check(&pages, &mut breaches);
        breaches.len()
    }

    #[test]
    fn what_markdown_would_hide_is_a_breach() {
        for (text, count) in [
            ("2α\\* and `α*` and **the speed α**", 0),
            ("2α* − sin 2α*", 1),
            ("| a | b |\n|---|---|\n| x | \\|y\\| |\n", 0),
            ("| a | b |\n|---|---|\n| x | |y| |\n| x | y |\n", 1),
            ("| a | b |\n|---|---|\n| a ||\n", 0),
            ("| a | b |\n|---|---|\n\n| a |\n|---|\n", 0),
        ] {
            assert_eq!(rules(&[("docs/x.md", text)]), count, "{text}");
        }
    }

    #[test]
    fn a_page_has_the_title_of_the_contents() {
        let summary = (SUMMARY, "- [How fast](../x.md)\n");
        assert_eq!(rules(&[summary, ("docs/x.md", "# How fast\n")]), 0);
        assert_eq!(rules(&[summary, ("docs/x.md", "# Fast\n")]), 1);
    }
}
