//! Every source that is cited by a name and a year is in `docs/references.bib`.
//!
//! A citation is a name before a year, as in "Grebogi 1983" or "Verner (2010)". An entry of the bibliography must hold
//! both.

use super::breach::Breach;
use super::one_line::OneLine;
use super::sources::Source;

/// The bibliography.
pub(super) const BIBLIOGRAPHY: &str = "docs/references.bib";
/// This file, whose tests plant breaches.
const OWN_FILE: &str = "xtask/src/tidy/bibliography.rs";

/// Checks the citations in Rust files and documents.
pub(super) fn check(
    bibliography: &Source,
    sources: &[Source],
    documents: &[Source],
    breaches: &mut Vec<Breach>,
) {
    let entries: Vec<String> = bibliography.text.split("\n@").map(letters_and_digits).collect();
    let rust = sources.iter().filter(|source| source.name.ends_with(".rs"));
    for file in rust.chain(documents).filter(|file| file.name != OWN_FILE) {
        let text = OneLine::new(&file.text);
        for (at, name, year) in citations(&text.text) {
            let plain = letters_and_digits(name);
            if !entries.iter().any(|entry| has_word(entry, &plain) && has_word(entry, year)) {
                let rule =
                    format!("{BIBLIOGRAPHY} has no entry with {name} and {year}: add the source");
                breaches.push(Breach::new(&file.name, text.line_of(at), rule));
            }
        }
    }
}

fn has_word(text: &str, word: &str) -> bool {
    text.split(' ').any(|other| other == word)
}

/// A text without accents and without LaTeX's signs for them; other signs are spaces.
fn letters_and_digits(text: &str) -> String {
    let plain = |c: char| match c {
        'ü' => Some('u'),
        'ő' | 'ø' | 'ö' => Some('o'),
        'á' | 'ä' => Some('a'),
        'é' => Some('e'),
        'í' => Some('i'),
        '{' | '}' | '\\' | '"' | '\'' => None,
        c if c.is_alphanumeric() => Some(c),
        _ => Some(' '),
    };
    text.chars().filter_map(plain).collect()
}

/// The names before years, each with its place. The year is in parentheses, or a bracket, a comma or a semicolon
/// follows.
fn citations(text: &str) -> Vec<(usize, &str, &str)> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices(' ') {
        let rest = &text[at + 1..];
        let (inside, rest) = rest.strip_prefix('(').map_or((false, rest), |rest| (true, rest));
        let (Some(year), Some(after)) = (rest.get(..4), rest.get(4..)) else { continue };
        let closes = after.starts_with(')') || !inside && after.starts_with([',', ';']);
        let is_year = year.bytes().all(|b| b.is_ascii_digit()) && ("1800".."2100").contains(&year);
        if !closes || !is_year {
            continue;
        }
        let before = text[..at].trim_end_matches(',');
        let name = before.rsplit(|c: char| !c.is_alphabetic()).next().unwrap_or_default();
        if name.starts_with(char::is_uppercase) && name.chars().count() > 2 {
            found.push((at, name, year));
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn breaches(text: &str) -> Vec<(usize, String)> {
        let entries = "@article{A,\n  author = {M{\\\"u}ller, B.},\n  year = {1995}\n}\n\n@book{B,\n  author = \
                       {Leine},\n  year = {2004}\n}\n";
        let mut found = Vec::new();
        let file = Source::new("x.rs", text);
        check(&Source::new(BIBLIOGRAPHY, entries), &[file], &[], &mut found);
        found.into_iter().map(|breach| (breach.line, breach.rule)).collect()
    }

    #[test]
    fn a_source_that_is_missing_is_a_breach() {
        let rule = "docs/references.bib has no entry with Verner and 2010: add the source";
        assert_eq!(breaches("//! X.\n// Verner (2010).\n"), [(2, rule.to_owned())]);
        // Name and year must be in one entry.
        assert_eq!(breaches("// Leine (1995)\n").len(), 1);
        assert_eq!(breaches("/// (Leine 2004; Wilson,\n/// 1927)\n").len(), 1);
    }

    #[test]
    fn known_sources_and_other_numbers_are_no_breaches() {
        assert_eq!(breaches("/// Müller (1995), (Leine 2004, Müller\n/// 1995; x)\n"), []);
        assert_eq!(breaches("let points = Grid::new(30.0, 2000); // About 2000 points\n"), []);
    }
}
