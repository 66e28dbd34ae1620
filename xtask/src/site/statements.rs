//! Theorems: each has an anchor on the page of the theory, and where one is named is a link to it.

use crate::tidy::links::resolve;

/// The page that has them.
pub(super) const THEORY: &str = "docs/theory.md";

const KINDS: [&str; 5] = ["Theorem", "Lemma", "Corollary", "Proposition", "Conjecture"];

/// A page with its statements linked; `known` are the anchors of the theory.
pub(super) fn linked(page: &str, text: &str, known: &[String]) -> String {
    let mut fenced = false;
    let mut lines = Vec::new();
    for line in text.lines() {
        let is_fence = line.trim_start().starts_with("```");
        fenced ^= is_fence;
        if fenced || is_fence || line.starts_with('#') || line.starts_with("    ") {
            lines.push(line.to_owned());
            continue;
        }
        let own = if page == THEORY { statement(line) } else { None };
        match own {
            // The statement itself is no mention.
            Some(anchor) => lines.push(format!("<a id=\"{anchor}\"></a>{line}")),
            None => lines.push(mentions(page, line, known)),
        }
    }
    lines.join("\n") + "\n"
}

/// The anchors of all statements of the theory.
pub(super) fn anchors(theory: &str) -> Vec<String> {
    theory.lines().filter_map(statement).collect()
}

/// The anchor of a line that begins with a statement, such as `**Lemma 27 (…`.
fn statement(line: &str) -> Option<String> {
    let rest = line.strip_prefix("**")?;
    let (kind, rest) = rest.split_once(' ')?;
    let number: String = rest.chars().take_while(char::is_ascii_digit).collect();
    (KINDS.contains(&kind) && !number.is_empty()).then(|| anchor(kind, &number))
}

fn anchor(kind: &str, number: &str) -> String {
    format!("{}-{number}", kind.to_lowercase())
}

/// A line in which each statement that is named, and is in no link or code, is a link.
fn mentions(page: &str, line: &str, known: &[String]) -> String {
    let (mut result, mut rest) = (String::with_capacity(line.len()), line);
    while let Some((at, kind)) =
        KINDS.iter().filter_map(|kind| Some((rest.find(&format!("{kind} "))?, *kind))).min()
    {
        let (before, from) = rest.split_at(at);
        result.push_str(before);
        let words = &from[kind.len() + 1..];
        let number: String = words.chars().take_while(char::is_ascii_digit).collect();
        let (word, after) = from.split_at(kind.len() + 1 + number.len());
        let own = anchor(kind, &number);
        let quiet = is_inside(&result, after);
        if number.is_empty() || quiet || !known.contains(&own) {
            result.push_str(word);
        } else {
            // The link says on which page it is.
            if let Some(before) = result.strip_suffix("theory.md, ") {
                result.truncate(before.len());
            }
            result.push_str(&format!("[{word}]({}#{own})", path_to_theory(page)));
        }
        rest = after;
    }
    result + rest
}

/// Whether a place between two parts of a line is in code, or in the text or the target of a link. A bracket alone, as that of an interval, is no link.
fn is_inside(text: &str, after: &str) -> bool {
    let is_open = text.rfind('[') > text.rfind(']');
    let is_text = is_open && after.find("](").is_some_and(|at| !after[..at].contains('['));
    let target = text.rfind("](").is_some_and(|at| !text[at..].contains(')'));
    text.matches('`').count() % 2 == 1 || is_text || target
}

/// The path of the theory from a page; empty on itself.
fn path_to_theory(page: &str) -> String {
    if page == THEORY {
        return String::new();
    }
    let up =
        resolve(page, ".").unwrap_or_default().split('/').filter(|part| !part.is_empty()).count();
    format!("{}{THEORY}", "../".repeat(up))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statements_have_anchors_and_mentions_lead_there() {
        let theory = "**Lemma 27 (one maximum).** By Theorem 45.\n\n**Theorem 45.** Text.\n";
        let known = anchors(theory);
        assert_eq!(known, ["lemma-27", "theorem-45"]);
        assert!(linked(THEORY, theory, &known).starts_with("<a id=\"lemma-27\"></a>**Lemma 27"));
        let text = "See theory.md, Theorem 45, `Theorem 45`, [Lemma 27](a.md), Lemma 99; [0, 1) by Lemma 27.";
        let expected = "See [Theorem 45](../docs/theory.md#theorem-45), `Theorem 45`, [Lemma 27](a.md), Lemma 99; [0, 1) by [Lemma 27](../docs/theory.md#lemma-27).\n";
        assert_eq!(linked("docs/note.md", text, &known), expected);
    }
}
