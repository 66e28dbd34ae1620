//! Labels set as mathematics: `$α$` is italic, `_{1}` and `^{2}` are sub- and superscripts.

use crate::font::{Font, FontError};
use crate::path::Path;
use std::fmt::Write;

/// Size of scripts, in units of the font size, as TeX has 7-point scripts for 10-point text.
const SCRIPT: f64 = 0.7;
/// Distance by which subscripts are lowered, in units of the font size. TeX has 0.247 beneath a superscript. With one
/// value for all subscripts those of a label are on one line.
const DOWN: f64 = 0.25;
/// Distance by which superscripts are raised, in units of the font size. TeX has 0.413.
const UP: f64 = 0.4;

/// The vertical position of a piece of a label.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Level {
    Line,
    Subscript,
    Superscript,
}

/// A piece of a label on one level, its letters already upright or italic.
#[derive(Debug, Clone, PartialEq, Eq)]
struct Span {
    text: String,
    level: Level,
}

/// The outlines of a label that starts at (0, 0) on its baseline, and its width.
///
/// A superscript followed at once by a subscript is stacked, as in `$α$^{*}_{1}`.
pub(crate) fn outline(markup: &str, size: f64) -> Result<(Path, f64), FontError> {
    let font = Font::shipped()?;
    let mut path = Path::default();
    let mut end = 0.0f64;
    let mut superscript = None;
    for Span { text, level } in spans(markup) {
        let (size, y) = match level {
            Level::Line => (size, 0.0),
            Level::Subscript => (SCRIPT * size, DOWN * size),
            Level::Superscript => (SCRIPT * size, -UP * size),
        };
        // A subscript starts where the superscript before it starts. The label is as wide as the longer of the two.
        let back = superscript.filter(|_| level == Level::Subscript);
        let start = back.unwrap_or(end);
        superscript = (level == Level::Superscript).then_some(start);
        end = end.max(font.set(&text, size, (start, y), &mut path)?);
    }
    Ok((path, end))
}

/// The pieces of a label.
fn spans(markup: &str) -> Vec<Span> {
    let mut spans = Vec::new();
    let mut italic = false;
    let mut rest = markup;
    while let Some(c) = rest.chars().next() {
        match (c, rest.get(1..2)) {
            ('$', _) => {
                italic = !italic;
                rest = &rest[1..];
            }
            ('_' | '^', Some("{")) => {
                let body = rest[2..].split('}').next().unwrap_or("");
                rest = rest.get(2 + body.len() + 1..).unwrap_or("");
                let level = if c == '_' { Level::Subscript } else { Level::Superscript };
                let slanted = body.contains('$') != italic;
                spans.push(Span { text: slant(&body.replace('$', ""), slanted), level });
            }
            _ => {
                let end = rest.char_indices().find(|&(at, c)| {
                    c == '$' || ((c == '_' || c == '^') && rest[at + 1..].starts_with('{'))
                });
                let (body, tail) = rest.split_at(end.map_or(rest.len(), |(at, _)| at));
                spans.push(Span { text: slant(body, italic), level: Level::Line });
                rest = tail;
            }
        }
    }
    spans
}

fn slant(text: &str, italic: bool) -> String {
    if italic { text.chars().map(math_italic).collect() } else { text.into() }
}
/// The mathematical italic of a Latin or Greek letter, from the same font as the upright one.
fn math_italic(c: char) -> char {
    let (first, base) = match c {
        'h' => return 'ℎ',
        'a'..='z' => ('a', 0x1d44e),
        'A'..='Z' => ('A', 0x1d434),
        'α'..='ω' => ('α', 0x1d6fc),
        'Α'..='Ω' => ('Α', 0x1d6e2),
        _ => return c,
    };
    char::from_u32(base + (c as u32 - first as u32)).unwrap_or(c)
}

/// Text as XML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The same label as HTML.
pub fn html(markup: &str) -> String {
    let mut out = String::new();
    let mut open = false;
    let mut rest = markup;
    while let Some(c) = rest.chars().next() {
        let script = rest.get(1..2) == Some("{");
        if c == '$' {
            out.push_str(if open { "</i>" } else { "<i>" });
            open = !open;
            rest = &rest[1..];
        } else if (c == '_' || c == '^') && script {
            let body = rest[2..].split('}').next().unwrap_or("");
            let tag = if c == '_' { "sub" } else { "sup" };
            let _ = write!(out, "<{tag}>{}</{tag}>", html(body));
            rest = rest.get(2 + body.len() + 1..).unwrap_or("");
        } else {
            out.push_str(&escape(&rest[..c.len_utf8()]));
            rest = &rest[c.len_utf8()..];
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn width(markup: &str) -> f64 {
        outline(markup, 10.0).unwrap().1
    }

    #[test]
    fn scripts_return_to_the_line() {
        let spans = spans("$f$($α$_{n})");
        let texts: Vec<_> = spans.iter().map(|span| (span.text.as_str(), span.level)).collect();
        assert_eq!(
            texts,
            [
                ("𝑓", Level::Line),
                ("(", Level::Line),
                ("𝛼", Level::Line),
                ("n", Level::Subscript),
                (")", Level::Line)
            ]
        );
        // The parenthesis is the lowest character, and is as low as without the superscript before it.
        let bottom = |markup| outline(markup, 10.0).unwrap().0.limits_of_ends()[3];
        assert_eq!(bottom("x^{n})"), bottom(")"));
    }

    #[test]
    fn stacked_scripts_start_together_and_end_with_the_longer_one() {
        assert_eq!(width("x^{2}_{n+1}"), width("x_{n+1}"));
        assert_eq!(width("x^{n+1}_{2}"), width("x^{n+1}"));
        assert_eq!(width("x^{2}_{n+1}y"), width("x_{n+1}y"));
        assert!((width("x_{1}^{2}") - width("x_{12}")).abs() < 1e-12, "side by side");
    }

    #[test]
    fn letters_between_dollars_are_mathematical_italics() {
        let italics: String = "azAZαωhΓ1".chars().map(math_italic).collect();
        assert_eq!(italics, "𝑎𝑧𝐴𝑍𝛼𝜔ℎ𝛤1");
    }

    #[test]
    fn html_has_the_same_structure() {
        assert_eq!(html("$α$^{*}_{1} < 5"), "<i>α</i><sup>*</sup><sub>1</sub> &lt; 5");
    }
}
