//! The links of the documentation lead to files and headings that exist.
//!
//! A link is `[text](target)` or `![text](target)`; a definition is `[name]: target`. A target is a path from the
//! folder of its page, a heading as `#its-words`, or both. Targets outside the repository are checked for their
//! form only. Paths of Rust items, such as `crate::Error`, are checked by rustdoc.

use super::breach::Breach;
use super::sources::Source;
use std::path::Path;

/// Checks the links of all pages.
pub(super) fn check(root: &Path, pages: &[Source], breaches: &mut Vec<Breach>) {
    check_with(&|path| root.join(path).exists(), pages, breaches);
}

fn check_with(exists: &dyn Fn(&str) -> bool, pages: &[Source], breaches: &mut Vec<Breach>) {
    for page in pages {
        for (at, line) in prose(&page.text) {
            for target in targets(&line) {
                if let Some(rule) = defect(target, page, pages, exists) {
                    breaches.push(Breach::new(&page.name, at, rule));
                }
            }
        }
    }
}

/// Why a target is wrong; `None` if it leads somewhere.
fn defect(
    target: &str,
    page: &Source,
    pages: &[Source],
    exists: &dyn Fn(&str) -> bool,
) -> Option<String> {
    if let Some((scheme, rest)) = target.split_once("://") {
        let host = rest.split(['/', '#', '?']).next().unwrap_or_default();
        let good = ["http", "https"].contains(&scheme) && host.contains('.') && !rest.contains(' ');
        return (!good).then(|| format!("the link {target} is no address: https://host/path"));
    }
    if target.contains("::") {
        return None;
    }
    let (path, heading) = target.split_once('#').map_or((target, None), |(p, h)| (p, Some(h)));
    let Some(file) = resolve(&page.name, path) else {
        return Some(format!("the link {target} leads out of the repository"));
    };
    if !exists(&file) {
        return Some(format!("the link {target} leads to {file}, which does not exist"));
    }
    let heading = heading?;
    let Some(linked) = pages.iter().find(|page| page.name == file) else {
        return Some(format!("the link {target} names a heading of {file}, which is no page"));
    };
    let known = anchors(&linked.text);
    let missing = !known.iter().any(|anchor| anchor == heading);
    missing.then(|| format!("the link {target}: {file} has no heading #{heading}"))
}

/// The path from the root of a path from a page's folder; the page itself for an empty path.
pub(crate) fn resolve(page: &str, path: &str) -> Option<String> {
    if path.is_empty() {
        return Some(page.to_owned());
    }
    let mut parts: Vec<&str> = page.split('/').collect();
    parts.pop(); // the page's own name
    for part in path.split('/') {
        match part {
            "." | "" => {}
            ".." => {
                parts.pop()?;
            }
            name => parts.push(name),
        }
    }
    Some(parts.join("/"))
}

/// The lines of a page outside code, each with its number from one. Code inside a line becomes spaces.
pub(crate) fn prose(text: &str) -> impl Iterator<Item = (usize, String)> {
    let mut fenced = false;
    (1..).zip(text.lines()).filter_map(move |(at, line)| {
        if line.trim_start().starts_with("```") {
            fenced = !fenced;
            return None;
        }
        (!fenced).then(|| (at, without_code(line)))
    })
}

/// A line with spaces in place of what stands between backticks. A backtick without a partner stays.
fn without_code(line: &str) -> String {
    let parts: Vec<&str> = line.split('`').collect();
    // The odd parts are code; with an even number of parts the last backtick has no partner.
    let paired = if parts.len() % 2 == 1 { parts.len() } else { parts.len() - 1 };
    let part = |(k, part): (usize, &&str)| {
        if k % 2 == 1 && k < paired { " ".repeat(part.len()) } else { (*part).to_owned() }
    };
    parts.iter().enumerate().map(part).collect::<Vec<_>>().join("`")
}

/// The targets of the links and definitions in a line.
pub(crate) fn targets(line: &str) -> Vec<&str> {
    let mut found = Vec::new();
    for (at, mark) in line.match_indices("](") {
        let target = line[at + mark.len()..].split(')').next().unwrap_or_default();
        // A title may follow: [text](target "title").
        found.push(target.split(" \"").next().unwrap_or_default().trim());
    }
    let definition = line.strip_prefix('[').and_then(|rest| rest.split_once("]: "));
    found.extend(definition.map(|(_, target)| target.trim()));
    found
}

/// The anchors of a page's headings, as GitHub makes them: small letters, hyphens for spaces, no other signs than
/// hyphens and underscores. A repeated heading gets a number.
fn anchors(text: &str) -> Vec<String> {
    let mut fenced = false;
    let mut found: Vec<String> = Vec::new();
    for line in text.lines() {
        fenced ^= line.trim_start().starts_with("```");
        let heading = line.trim_start_matches('#');
        let level = line.len() - heading.len();
        if fenced || !(1..=6).contains(&level) || !heading.starts_with(' ') {
            continue;
        }
        let kept = |c: char| c.is_alphanumeric() || "-_ ".contains(c);
        let letters = heading.trim().chars().filter(|c| kept(*c)).flat_map(char::to_lowercase);
        let anchor: String = letters.map(|c| if c == ' ' { '-' } else { c }).collect();
        let earlier = found.iter().filter(|other| **other == anchor).count();
        found.push(if earlier == 0 { anchor } else { format!("{anchor}-{earlier}") });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rules(text: &str) -> Vec<String> {
        let other = "# Other page\n\n## The `first` step: α*\n\n## Again\n\n## Again\n";
        let pages = [Source::new("docs/x.md", text), Source::new("docs/y.md", other)];
        let files = ["docs/x.md", "docs/y.md", "LICENSE", "docs/figures/a.png"];
        let mut breaches = Vec::new();
        check_with(&|path| files.contains(&path), &pages, &mut breaches);
        breaches.into_iter().map(|breach| format!("{}: {}", breach.line, breach.rule)).collect()
    }

    #[test]
    fn links_that_lead_somewhere_are_no_breaches() {
        let text = "# Here\n[a](y.md) ![b](figures/a.png) [c](../LICENSE) [d](#here) [e](crate::Error)\n\
                    [f](y.md#the-first-step-α) [g](y.md#again-1) [h](https://example.org/x \"X\")\n[i]: y.md\n";
        assert_eq!(rules(text), [""; 0]);
    }

    #[test]
    fn links_that_lead_nowhere_are_breaches() {
        let expected = "2: the link z.md leads to docs/z.md, which does not exist";
        assert_eq!(rules("\n[a](z.md)\n"), [expected]);
        for text in [
            "![a](figures/b.png)",
            "[a](#there)",
            "[a](y.md#second-step)",
            "[a](y.md#again-2)",
            "[a](../LICENSE#x)",
            "[a](../../x.md)",
            "[a](https://nowhere)",
            "[a](ftp://example.org)",
            "[a]: z.md",
            "[a](y.md) and [b](z.md)",
        ] {
            assert_eq!(rules(text).len(), 1, "{text}");
        }
    }

    #[test]
    fn code_holds_no_links() {
        assert_eq!(rules("`[a](z.md)`\n```text\n[a](z.md)\n# b\n```\n"), [""; 0]);
        assert_eq!(rules("```text\n# b\n```\n[a](#b)\n").len(), 1);
        assert_eq!(rules("a ` b [a](z.md)").len(), 1);
    }
}
