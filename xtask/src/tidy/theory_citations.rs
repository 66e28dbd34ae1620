//! Citations of `docs/theory.md` name statements that exist there.
//!
//! A citation is `theory.md, Lemma 5`, or a list such as `theory.md, Lemma 5, Theorem 7 and Corollary 9`. It may go
//! on over the lines of a comment. A statement begins a line with `**Lemma 5`.

use super::breach::Breach;
use super::one_line::OneLine;
use super::sources::Source;

/// The file with the statements.
const THEORY: &str = "docs/theory.md";
/// This file, whose tests plant breaches.
const OWN_FILE: &str = "xtask/src/tidy/theory_citations.rs";
/// The kinds of statements. They share one numbering.
const KINDS: [&str; 4] = ["Lemma", "Theorem", "Corollary", "Conjecture"];
/// The sections of an earlier collection of facts, which is no part of the repository.
const OLD_SECTIONS: [char; 5] = ['a', 'b', 'c', 'd', 'e'];

/// A kind and a number.
type Statement<'a> = (&'a str, u32);

/// Checks all citations in `sources` and `documents`, and the numbering of the statements.
pub(super) fn check(sources: &[Source], documents: &[Source], breaches: &mut Vec<Breach>) {
    let theory = documents.iter().find(|document| document.name == THEORY);
    let statements = theory.map_or_else(Vec::new, |theory| statements(&theory.text));
    for (index, (line, (_, number))) in statements.iter().enumerate() {
        let expected = index + 1;
        if *number as usize != expected {
            let rule = format!("a statement has the number {number}: {expected} comes next");
            breaches.push(Breach::new(THEORY, *line, rule));
        }
    }
    let rust = sources.iter().filter(|source| source.name.ends_with(".rs"));
    for file in rust.chain(documents).filter(|file| file.name != OWN_FILE) {
        let text = OneLine::new(&file.text);
        for (at, cited) in citations(&text.text) {
            if !statements.iter().any(|(_, statement)| *statement == cited) {
                let (kind, number) = cited;
                let rule = format!("{THEORY} has no {kind} {number}: cite one that it has");
                breaches.push(Breach::new(&file.name, text.line_of(at), rule));
            }
        }
        for at in old_citations(&text.text) {
            let rule = format!("cite a statement, as in \"{THEORY}, Lemma 5\"");
            breaches.push(Breach::new(&file.name, text.line_of(at), rule));
        }
    }
}

/// The statements of the theory, each with its line.
fn statements(text: &str) -> Vec<(usize, Statement<'_>)> {
    let lines = (1..).zip(text.lines());
    lines.filter_map(|(at, line)| Some((at, statement(line.strip_prefix("**")?)?.0))).collect()
}

/// The statement with which a text begins, and the rest of the text.
fn statement(text: &str) -> Option<(Statement<'_>, &str)> {
    let kind = KINDS.into_iter().find(|kind| text.starts_with(kind))?;
    let rest = text[kind.len()..].strip_prefix(' ')?;
    let end = rest.find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len());
    Some(((kind, rest[..end].parse().ok()?), &rest[end..]))
}

/// All statements cited in a text, each with the place of its citation.
fn citations(text: &str) -> Vec<(usize, Statement<'_>)> {
    let mut found = Vec::new();
    for (at, name) in text.match_indices("theory.md") {
        // The end of a link or of code stands between the name of the file and the statement.
        let mut rest = text[at + name.len()..].trim_start_matches(['`', ')', ']']);
        while let Some((cited, after)) = [", and ", ", ", " and ", "; "]
            .into_iter()
            .find_map(|separator| statement(rest.strip_prefix(separator)?))
        {
            found.push((at, cited));
            rest = after;
        }
    }
    found
}

/// The places of citations of the earlier collection, such as "theory: b.2".
fn old_citations(text: &str) -> Vec<usize> {
    let is_section = |rest: &str| {
        let mut letters = rest.chars();
        let section = letters.next().is_some_and(|letter| OLD_SECTIONS.contains(&letter));
        section && !letters.next().is_some_and(|next| next.is_alphanumeric() || next == '_')
    };
    let pattern = "theory: ";
    let found = text.match_indices(pattern);
    found.filter(|(at, _)| is_section(&text[at + pattern.len()..])).map(|(at, _)| at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const STATEMENTS: &str = "# Theory\n\n**Lemma 1 (flight).** …\n\n**Theorem 2.** See Lemma 1.\n";

    fn breaches(name: &str, text: &str) -> Vec<(usize, String)> {
        let mut breaches = Vec::new();
        let documents = [Source::new(THEORY, STATEMENTS)];
        check(&[Source::new(name, text)], &documents, &mut breaches);
        breaches.into_iter().map(|breach| (breach.line, breach.rule)).collect()
    }

    #[test]
    fn a_statement_that_does_not_exist_is_a_breach() {
        let missing = [(2, "docs/theory.md has no Lemma 3: cite one that it has".to_owned())];
        assert_eq!(breaches("x.rs", "//! X.\n// docs/theory.md, Lemma 3\n"), missing);
        // The kind counts, not the number alone.
        assert_eq!(breaches("x.rs", "/// theory.md, Lemma 2.\n").len(), 1);
        assert_eq!(breaches("x.rs", "/// theory.md, Theorem 2.\n"), []);
        assert_eq!(breaches("x.toml", "# theory.md, Lemma 3\n"), []);
    }

    #[test]
    fn lists_links_and_broken_lines_are_read() {
        assert_eq!(
            breaches("x.rs", "/// theory.md, Lemma 1, Theorem 2 and Corollary 3\n").len(),
            1
        );
        assert_eq!(breaches("x.rs", "    /// (docs/theory.md,\n    /// Lemma 7)\n").len(), 1);
        assert_eq!(breaches("x.rs", "/// [`theory.md`](docs/theory.md), Lemma 7\n").len(), 1);
        assert_eq!(breaches("x.rs", "/// `docs/theory.md`, Lemma 7\n").len(), 1);
        assert_eq!(breaches("x.rs", "/// See docs/theory.md.\n"), []);
    }

    #[test]
    fn the_old_form_is_a_breach() {
        let old = "x\n// the diagonal (theory: b.2).\n";
        let remedy = "cite a statement, as in \"docs/theory.md, Lemma 5\"".to_owned();
        assert_eq!(breaches("x.rs", old), [(2, remedy)]);
        assert_eq!(breaches("x.rs", "// theory: c)\n").len(), 1);
        assert_eq!(breaches("x.rs", "// theory: energy is constant\n"), []);
    }

    #[test]
    fn numbers_follow_each_other() {
        let text = "**Lemma 1.** …\n**Lemma 3.** …\n";
        let mut found = Vec::new();
        check(&[], &[Source::new(THEORY, text)], &mut found);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].file.as_str(), found[0].line), (THEORY, 2));
    }
}
