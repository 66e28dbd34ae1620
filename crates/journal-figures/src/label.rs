//! Labels set as mathematics: `$α$` is italic, `_{1}` and `^{2}` are sub- and superscripts.

use std::fmt::Write;

/// Script size and shifts in units of the font size.
const SCRIPT: f64 = 0.7;
const DOWN: f64 = 0.25;
const UP: f64 = 0.4;

/// The tspans of a label.
///
/// A superscript followed at once by a subscript is stacked, as in `$α$^{*}_{1}`.
pub fn tspans(markup: &str, size: f64) -> String {
    let mut out = String::new();
    let (mut italic, mut pending) = (false, 0.0);
    let mut rest = markup;
    let mut last_script_width = 0.0;
    while let Some(c) = rest.chars().next() {
        match (c, rest.get(1..2)) {
            ('$', _) => {
                italic = !italic;
                rest = &rest[1..];
            }
            ('_' | '^', Some("{")) => {
                let body = rest[2..].split('}').next().unwrap_or("");
                rest = rest.get(2 + body.len() + 1..).unwrap_or("");
                let shift = if c == '_' { DOWN } else { -UP } * size;
                let back = if c == '_' { -last_script_width } else { 0.0 };
                let dy = shift - pending;
                pending = shift;
                let slanted = body.contains('$') != italic;
                span(&mut out, &body.replace('$', ""), slanted, SCRIPT * size, dy, back);
                last_script_width =
                    if c == '^' { 0.42 * SCRIPT * size * body.chars().count() as f64 } else { 0.0 };
            }
            _ => {
                let end = rest.char_indices().find(|&(at, c)| {
                    c == '$' || ((c == '_' || c == '^') && rest[at + 1..].starts_with('{'))
                });
                let (body, tail) = rest.split_at(end.map_or(rest.len(), |(at, _)| at));
                span(&mut out, body, italic, size, -pending, 0.0);
                pending = 0.0;
                last_script_width = 0.0;
                rest = tail;
            }
        }
    }
    out
}

fn span(out: &mut String, body: &str, italic: bool, size: f64, dy: f64, dx: f64) {
    let text: String = if italic { body.chars().map(math_italic).collect() } else { body.into() };
    let _ = write!(
        out,
        "<tspan font-size=\"{size:.2}\" dy=\"{dy:.2}\" dx=\"{dx:.2}\">{}</tspan>",
        escape(&text)
    );
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

    #[test]
    fn scripts_return_to_the_line() {
        let spans = tspans("$f$($α$_{n})", 10.0);
        let shifts: f64 = spans
            .split("dy=\"")
            .skip(1)
            .map(|part| part.split('"').next().unwrap().parse::<f64>().unwrap())
            .sum();
        assert!(shifts.abs() < 1e-9, "{spans}");
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
