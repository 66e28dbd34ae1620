//! SVG files as elements, attributes and numbers.
//!
//! The scanner reads the SVG that `journal-figures` writes: elements, attributes in double quotes, and text. It refuses
//! comments, declarations and images.

use crate::error::Error;
use std::collections::BTreeMap;

/// A piece of an attribute or of a text. Spaces and commas separate pieces, and are no pieces.
#[derive(Debug, Clone, PartialEq)]
enum Piece {
    Number(f64),
    Word(String),
}

impl std::fmt::Display for Piece {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Piece::Number(number) => write!(f, "{number:?}"),
            Piece::Word(word) => write!(f, "\"{word}\""),
        }
    }
}

/// A part of the drawing in the order of the file: a tag that opens or closes an element, or a text between tags.
#[derive(Debug, Clone, PartialEq)]
struct Element {
    /// The name of the tag, with `/` before the name of a closing one; empty for a text.
    name: String,
    /// The attributes by name, whatever their order in the file. A text is the attribute "text".
    attributes: BTreeMap<String, Vec<Piece>>,
}

/// A drawing.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Drawing(Vec<Element>);

impl Drawing {
    /// Reads an SVG file.
    pub(crate) fn read(name: &str, bytes: &[u8]) -> Result<Self, Error> {
        let text = std::str::from_utf8(bytes).map_err(|e| Error::unreadable(name, e))?;
        let parts = parts(text).map_err(|reason| Error::unreadable(name, reason))?;
        Ok(Drawing(parts))
    }

    /// The first part that differs; `None` if the drawings are equal.
    pub(crate) fn difference(&self, new: &Drawing) -> Option<String> {
        for (at, (old, new)) in self.0.iter().zip(&new.0).enumerate() {
            if old != new {
                return Some(format!("part {at} <{}> {}", old.name, part_difference(old, new)));
            }
        }
        let (old, new) = (self.0.len(), new.0.len());
        (old != new).then(|| format!("had {old} parts, has {new}"))
    }
}

/// Where two different parts differ.
fn part_difference(old: &Element, new: &Element) -> String {
    if old.name != new.name {
        return format!("is <{}>", new.name);
    }
    let names = |part: &Element| part.attributes.keys().cloned().collect::<Vec<_>>();
    if names(old) != names(new) {
        return format!("had the attributes {:?}, has {:?}", names(old), names(new));
    }
    let different = old.attributes.iter().zip(new.attributes.values()).find(|((_, a), b)| a != b);
    let Some(((name, old), new)) = different else { return String::new() };
    match old.iter().zip(new).enumerate().find(|(_, (a, b))| a != b) {
        Some((at, (old, new))) => format!("{name}, place {at} was {old}, is {new}"),
        None => format!("{name} had {} pieces, has {}", old.len(), new.len()),
    }
}

/// All parts of a file.
fn parts(text: &str) -> Result<Vec<Element>, String> {
    let mut found = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find('<') {
        push_text(&rest[..at], &mut found);
        let tag = &rest[at + 1..];
        // A ">" in an attribute is written "&gt;", so that the first one ends the tag.
        let end = tag.find('>').ok_or("a tag has no end")?;
        read_tag(&tag[..end], &mut found)?;
        rest = &tag[end + 1..];
    }
    push_text(rest, &mut found);
    Ok(found)
}

fn push_text(text: &str, found: &mut Vec<Element>) {
    if !text.trim().is_empty() {
        let attributes = BTreeMap::from([("text".to_owned(), pieces(text))]);
        found.push(Element { name: String::new(), attributes });
    }
}

/// Reads what stands between `<` and `>`. A tag that opens and closes an element gives two parts, like two tags.
fn read_tag(tag: &str, found: &mut Vec<Element>) -> Result<(), String> {
    if tag.starts_with(['!', '?']) {
        return Err(format!("<{tag}> is a comment or a declaration"));
    }
    let (tag, closes) = tag.strip_suffix('/').map_or((tag, false), |tag| (tag, true));
    let (name, mut rest) = tag.split_once(char::is_whitespace).unwrap_or((tag, ""));
    if name == "image" {
        // Its bytes are compressed: pixels could not be compared.
        return Err("it holds an image; commit the figure as PNG".to_owned());
    }
    let mut attributes = BTreeMap::new();
    while let Some((key, after)) = rest.split_once('=') {
        let quoted = after.trim_start().strip_prefix('"').and_then(|after| after.split_once('"'));
        let (value, after) =
            quoted.ok_or_else(|| format!("<{name}> has an attribute without quotes"))?;
        if attributes.insert(key.trim().to_owned(), pieces(value)).is_some() {
            return Err(format!("<{name}> has the attribute {} twice", key.trim()));
        }
        rest = after;
    }
    if !rest.trim().is_empty() {
        return Err(format!("<{name}> has an attribute without a value"));
    }
    found.push(Element { name: name.to_owned(), attributes });
    if closes {
        found.push(Element { name: format!("/{name}"), attributes: BTreeMap::new() });
    }
    Ok(())
}

/// The numbers and words of a value.
fn pieces(value: &str) -> Vec<Piece> {
    let is_separator = |c: char| c.is_whitespace() || c == ',';
    let mut found = Vec::new();
    let mut rest = value.trim_start_matches(is_separator);
    while !rest.is_empty() {
        let (piece, after) = match number(rest) {
            Some((number, after)) => (Piece::Number(number), after),
            None => {
                let (word, after) = rest.split_at(word_length(rest));
                (Piece::Word(word.to_owned()), after)
            }
        };
        found.push(piece);
        rest = after.trim_start_matches(is_separator);
    }
    found
}

/// The length of the word with which a text begins. Digits after `#` are part of a colour or of a name.
fn word_length(text: &str) -> usize {
    let colour = text.starts_with('#');
    let mut places = text.char_indices().skip(1);
    let end = places
        .find(|&(at, c)| c.is_whitespace() || c == ',' || !colour && number(&text[at..]).is_some());
    end.map_or(text.len(), |(at, _)| at)
}

/// The number with which a text begins, and the rest of the text.
fn number(text: &str) -> Option<(f64, &str)> {
    let bytes = text.as_bytes();
    let digits = |from: usize| bytes[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let sign = usize::from(matches!(bytes.first(), Some(b'-' | b'+')));
    let whole = digits(sign);
    let mut end = sign + whole;
    let mut fraction = 0;
    if bytes.get(end) == Some(&b'.') {
        fraction = digits(end + 1);
        end += 1 + fraction;
    }
    if whole + fraction == 0 {
        return None;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'-' | b'+')));
        let exponent = if end + 1 + sign <= bytes.len() { digits(end + 1 + sign) } else { 0 };
        // Without digits the letter begins a word, as in "2em".
        end += if exponent > 0 { 1 + sign + exponent } else { 0 };
    }
    Some((text[..end].parse().ok()?, &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use journal_figures::{Anchor, Pen, Svg, render};

    fn difference(old: &str, new: &str) -> Option<String> {
        let read = |text: &str| Drawing::read("x.svg", text.as_bytes()).unwrap();
        read(old).difference(&read(new))
    }

    const PATH: &str = "<svg>\n<path fill=\"#a1b2c3\" d=\"M1.5 -2L3e1,4\"/>\n</svg>";

    #[test]
    fn another_order_of_attributes_and_another_format_are_no_difference() {
        let same = "<svg><path d='X' fill=\"#a1b2c3\"></path></svg>";
        let same = same.replace("'X'", "\"M 1.50-2.0 L 30 4\"");
        assert_eq!(difference(PATH, &same), None);
    }

    #[test]
    fn one_changed_number_is_found_with_its_place() {
        let found = difference(PATH, &PATH.replace("-2", "-2.001"));
        assert_eq!(found.as_deref(), Some("part 1 <path> d, place 2 was -2.0, is -2.001"));
        let found = difference(PATH, &PATH.replace("#a1b2c3", "#a1b2c4"));
        let expected = "part 1 <path> fill, place 0 was \"#a1b2c3\", is \"#a1b2c4\"";
        assert_eq!(found.as_deref(), Some(expected));
        assert!(difference(PATH, &PATH.replace("L3e1,4", "")).unwrap().contains("pieces"));
        assert!(difference(PATH, &PATH.replace("fill", "stroke")).unwrap().contains("stroke"));
        assert!(difference(PATH, &PATH.replace("path", "line")).unwrap().contains("<line>"));
        assert!(difference(PATH, &PATH.replace("</svg>", "x</svg>")).is_some());
        assert!(difference(PATH, &PATH.replace("\n</svg>", "")).unwrap().contains("parts"));
    }

    /// Every digit of a drawing as it is written is mutated in turn.
    #[test]
    fn every_changed_digit_is_a_difference() {
        let mut svg = Svg::new(60.0, 40.0);
        svg.rect(10.25, 5.125, 20.0, 12.5, Pen::solid("#1f77b4", 0.75));
        svg.text(30.0, 20.0, Anchor::Middle, 10.0, "$α$_{2}");
        let text = render("x", &svg, 1.0).unwrap().svg;
        assert_eq!(difference(&text, &text.clone()), None);
        let digits: Vec<usize> =
            text.match_indices(|c: char| c.is_ascii_digit()).map(|(at, _)| at).collect();
        assert!(digits.len() > 100);
        for at in digits {
            let digit = if text.as_bytes()[at] == b'7' { "3" } else { "7" };
            let mut changed = text.clone();
            changed.replace_range(at..=at, digit);
            assert!(difference(&text, &changed).is_some(), "{}", &text[at..]);
        }
    }

    #[test]
    fn a_drawing_that_cannot_be_compared_is_refused() {
        for text in ["<svg", "<svg a=1>", "<svg a=\"1\" a=\"2\">", "<svg b>", "<!-- x -->"] {
            assert!(Drawing::read("x.svg", text.as_bytes()).is_err(), "{text}");
        }
        let image = Drawing::read("x.svg", b"<svg><image href=\"data:\"/></svg>").unwrap_err();
        assert!(image.to_string().contains("commit the figure as PNG"), "{image}");
    }
}
