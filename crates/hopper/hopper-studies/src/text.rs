//! Errors and times as text, and blocks of text in the documents.

use crate::error::Error;

/// An error with one digit.
pub(crate) fn digit(error: f64) -> String {
    if error == 0.0 { "0".into() } else { format!("{error:.0e}") }
}

/// A time in seconds, with two digits and a unit.
pub(crate) fn duration(seconds: f64) -> String {
    let (value, unit) = match seconds {
        s if s < 1e-6 => (s * 1e9, "ns"),
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let digits = usize::from(value < 9.95);
    format!("{value:.digits$} {unit}")
}

/// A table of Markdown, from rows whose cells are separated by ` | `. A column whose name ends with a colon has
/// numbers: they end at its right.
pub(crate) fn markdown_table(columns: &str, rows: impl IntoIterator<Item = String>) -> String {
    let names: Vec<&str> = columns.split(" | ").collect();
    let rule = names.iter().map(|name| if name.ends_with(':') { "---:" } else { "---" });
    let header = names.iter().map(|name| name.trim_end_matches(':'));
    let mut out = format!("| {} |\n", header.collect::<Vec<_>>().join(" | "));
    out += &format!("|{}|\n", rule.collect::<Vec<_>>().join("|"));
    rows.into_iter().for_each(|row| out += &format!("| {row} |\n"));
    out
}

/// `text` with a new block between the markers `<!-- begin NAME -->` and `<!-- end NAME -->`.
///
/// # Errors
/// [`Error::Render`] if `text` lacks one of the markers.
pub(crate) fn replace_block(text: &str, name: &str, block: &str) -> Result<String, Error> {
    let (begin, end) = (format!("<!-- begin {name} -->\n"), format!("<!-- end {name} -->"));
    let missing = || Error::Render {
        what: format!("the block '{name}'"),
        reason: "its document has no markers for it".to_owned(),
    };
    let (before, rest) = text.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(&end).ok_or_else(missing)?;
    Ok(format!("{before}{begin}{}\n\n{end}{after}", block.trim_end()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_have_two_digits_and_a_unit() {
        assert_eq!(duration(9.0e-9), "9.0 ns");
        assert_eq!(duration(7.4e-7), "740 ns");
        assert_eq!(duration(2.1e-6), "2.1 µs");
        assert_eq!(duration(0.013), "13 ms");
    }

    #[test]
    fn a_table_has_a_header_a_rule_and_rows() {
        let table = markdown_table("a | b:", ["x | 1".to_owned(), "y | 2".to_owned()]);
        assert_eq!(table, "| a | b |\n|---|---:|\n| x | 1 |\n| y | 2 |\n");
    }

    #[test]
    fn blocks_are_replaced_between_their_markers() {
        let text = "a\n<!-- begin x -->\nold\n<!-- end x -->\nb";
        let new = replace_block(text, "x", "new\n").unwrap();
        assert_eq!(new, "a\n<!-- begin x -->\nnew\n\n<!-- end x -->\nb");
        assert!(replace_block(text, "y", "new").is_err());
    }
}
