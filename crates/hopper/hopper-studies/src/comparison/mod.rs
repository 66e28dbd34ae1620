//! Are the figures made now the committed ones?
//!
//! Numbers and pixels are compared, not the bytes of files. A new version of a compressor, or another number format of
//! a table, changes no result, and gives no difference here. Numbers must be equal in all bits. A drawing is text that
//! `journal-figures` alone writes: its lines are compared.
//!
//! | file | compared |
//! |---|---|
//! | [`table`] | CSV, NumPy arrays and PNG as tables of numbers |
//! | [`table_digest`] | tables of which only digests are committed |

pub(crate) mod table;
pub(crate) mod table_digest;

use crate::error::Error;
use table::Table;

/// The first difference between a committed file and the same file made now; `None` if they are equal.
///
/// The ending of the name decides how both are read: `.svg`, or one of the tables.
pub(crate) fn difference(name: &str, old: &[u8], new: &[u8]) -> Result<Option<String>, Error> {
    if name.ends_with(".svg") {
        let read = |bytes| std::str::from_utf8(bytes).map_err(|e| Error::unreadable(name, e));
        return Ok(line_difference(read(old)?, read(new)?));
    }
    let read = |bytes| Table::read(name, bytes);
    Ok(read(old)?.difference(&read(new)?))
}

/// The first line that differs, from the first character that does.
fn line_difference(old: &str, new: &str) -> Option<String> {
    let lines = |text: &str| text.lines().count();
    if let Some((at, (old, new))) =
        (1..).zip(old.lines().zip(new.lines())).find(|(_, (a, b))| a != b)
    {
        let same = old.chars().zip(new.chars()).take_while(|(a, b)| a == b).count();
        let rest = |line: &str| line.chars().skip(same).take(SHOWN).collect::<String>();
        return Some(format!(
            "line {at}, column {}: was \"{}\", is \"{}\"",
            same + 1,
            rest(old),
            rest(new)
        ));
    }
    let (old, new) = (lines(old), lines(new));
    (old != new).then(|| format!("had {old} lines, has {new}"))
}

/// Characters of a line that a difference shows: a number with what follows it.
const SHOWN: usize = 40;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawing_differs_at_its_first_other_character() {
        let found =
            |new: &[u8]| difference("x.svg", b"<svg>\n<path d=\"M 1\"/>\n</svg>\n", new).unwrap();
        assert_eq!(found(b"<svg>\n<path d=\"M 1\"/>\n</svg>\n"), None);
        let other = found(b"<svg>\n<path d=\"M 2\"/>\n</svg>\n").unwrap();
        assert_eq!(other, "line 2, column 12: was \"1\"/>\", is \"2\"/>\"");
        assert_eq!(found(b"<svg>\n").unwrap(), "had 3 lines, has 1");
        assert!(difference("x.svg", b"\xff", b"").is_err());
    }
}
