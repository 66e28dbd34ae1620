//! Wrong arguments as one line.

use clap::error::{ContextKind, ContextValue, ErrorKind};
use std::ffi::OsString;

/// The longest value that a message repeats. A longer one is cut: the reader knows what was given.
const LONGEST_VALUE: usize = 60;

/// The message of the argument parser as one line: what is wrong, and the nearest name or the names that exist.
pub(crate) fn line(error: &clap::Error, arguments: &[OsString]) -> String {
    if let Some(text) =
        unreadable_argument(error, arguments).or_else(|| negative_argument(error, arguments))
    {
        return text;
    }
    let mut text = error.to_string();
    // A line break in an argument is no end of the message, and a long one hides what is wrong with it.
    for argument in arguments.iter().filter_map(|argument| argument.to_str()) {
        if argument.contains(['\n', '\r']) || argument.chars().count() > LONGEST_VALUE {
            text = text.replace(argument, &one_line(&shortened(argument)));
        }
    }
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

/// An argument that is no text in UTF-8: the parser does not say which.
fn unreadable_argument(error: &clap::Error, arguments: &[OsString]) -> Option<String> {
    let is_unreadable = |argument: &&OsString| argument.to_str().is_none();
    let found =
        arguments.iter().find(is_unreadable).filter(|_| error.kind() == ErrorKind::InvalidUtf8)?;
    let found = shortened(&found.to_string_lossy());
    Some(format!("'{found}' is no text in UTF-8; give numbers and names in UTF-8"))
}

/// "-inf" and "-1e-6" begin like options. They are numbers that no argument takes.
fn negative_argument(error: &clap::Error, arguments: &[OsString]) -> Option<String> {
    if error.kind() != ErrorKind::UnknownArgument {
        return None;
    }
    let is_number = |text: &&str| {
        let rest = text.strip_prefix('-').unwrap_or_default();
        rest.starts_with(|c: char| c.is_ascii_digit() || c == '.') || rest.parse::<f64>().is_ok()
    };
    let Some(ContextValue::String(unknown)) = error.get(ContextKind::InvalidArg) else {
        return None;
    };
    let found = arguments.iter().filter_map(|argument| argument.to_str()).filter(is_number);
    let found = found.into_iter().find(|found| found.starts_with(unknown))?;
    let number = found.parse::<f64>().ok();
    let found = shortened(found);
    let Some(number) = number else {
        return Some(format!(
            "'{found}' begins as an option or a negative number, and is neither; --help shows the options and their \
             values"
        ));
    };
    Some(if number.is_finite() {
        format!(
            "'{found}' is negative, or not expected here; give a positive number such as 7.5 or 1e-3"
        )
    } else {
        format!(
            "'{found}' is not a finite number, or not expected here; give a number such as 7.5 or 1e-3"
        )
    })
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
