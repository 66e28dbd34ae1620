//! Wrong arguments as one line.

use clap::error::ErrorKind;
use std::ffi::OsString;

/// The longest value that a message repeats. A longer one is cut: the reader knows what was given.
const LONGEST_VALUE: usize = 60;

/// The message of the argument parser as one line: what is wrong, and the nearest name or the names that exist.
pub(crate) fn line(error: &clap::Error, arguments: &[OsString]) -> String {
    if let Some(text) = infinite_argument(error, arguments) {
        return text;
    }
    let text = error.to_string();
    let mut parts: Vec<String> = Vec::new();
    for line in text.lines().map(str::trim) {
        // The usage is in --help.
        if line.starts_with("Usage:") || line.starts_with("For more information") {
            break;
        }
        let line = line.strip_prefix("error: ").unwrap_or(line);
        // Not a remedy: a value with a leading hyphen is never meant here.
        if !line.is_empty() && !line.contains("as a value, use '-- ") {
            parts.push(line.strip_prefix("tip: ").unwrap_or(line).to_owned());
        }
    }
    let remedy = match error.kind() {
        ErrorKind::InvalidValue | ErrorKind::ValueValidation => "",
        _ => "; --help shows the options",
    };
    parts.join("; ").replace(":; ", ": ") + remedy
}

/// "-inf" begins like an option. It is a number that no option takes.
fn infinite_argument(error: &clap::Error, arguments: &[OsString]) -> Option<String> {
    if error.kind() != ErrorKind::UnknownArgument {
        return None;
    }
    let is_negative = |text: &&str| text.starts_with('-') && text.len() > 1;
    let infinite = |text: &&str| text.parse::<f64>().is_ok_and(|value| !value.is_finite());
    let texts = arguments.iter().filter_map(|argument| argument.to_str());
    let found = texts.filter(is_negative).find(infinite)?;
    Some(format!("'{found}' is not a finite number; give a number such as 7.5 or 1e-3"))
}

/// A text with its line breaks and control characters written out.
pub(crate) fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for character in text.chars() {
        if character.is_control() {
            line.extend(character.escape_default());
        } else {
            line.push(character);
        }
    }
    line
}

/// A value in a message, cut to a readable length.
pub(crate) fn shortened(value: &str) -> String {
    let mut characters = value.chars();
    let mut text: String = characters.by_ref().take(LONGEST_VALUE).collect();
    if characters.next().is_some() {
        text.push('…');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_is_one_line_of_readable_length() {
        assert_eq!(one_line("a\nb\u{7}ü"), "a\\nb\\u{7}ü");
        assert_eq!(shortened("abc"), "abc");
        assert_eq!(shortened(&"x".repeat(100)).chars().count(), LONGEST_VALUE + 1);
    }
}
