//! Formulas of the pages, set: x_{n+1} and α*_n with subscripts, 10^{−3} with superscripts, indented lines as displays.
//!
//! The pages have formulas as plain text, which everyone can read and search. Code stays as it is.

/// The pages whose indented lines are formulas; those of others are code.
const DISPLAYED: [&str; 3] = ["docs/model.md", "docs/note.md", "docs/theory.md"];

/// A page with its formulas set.
pub(super) fn set(page: &str, text: &str) -> String {
    let displays = DISPLAYED.contains(&page);
    let (mut fenced, mut display) = (false, false);
    let (mut result, mut before) = (String::with_capacity(2 * text.len()), "");
    for line in text.lines() {
        fenced ^= line.trim_start().starts_with("```");
        let is_fence = line.trim_start().starts_with("```");
        let is_display = displays
            && !fenced
            && line.starts_with("    ")
            && (display || before.trim().is_empty());
        if is_display != display {
            // Each line break of a display is shown.
            result.push_str(if is_display { "<div class=\"formula\">" } else { "</div>\n" });
            display = is_display;
        }
        if fenced || is_fence || line.starts_with('#') || line.starts_with("    ") && !is_display {
            result.push_str(line);
        } else if is_display {
            result.push_str(&line_of(&escaped(line.trim_start()), false));
        } else {
            result.push_str(&line_of(line, true));
        }
        result.push('\n');
        before = line;
    }
    if display {
        result.push_str("</div>\n");
    }
    result
}

/// The text of a display, in which Markdown has no meaning.
fn escaped(line: &str) -> String {
    line.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('\\', "")
}

/// A line with its indices set. In Markdown, what stands in code, in the targets of links and in tags stays.
fn line_of(line: &str, is_markdown: bool) -> String {
    let letters: Vec<char> = line.chars().collect();
    let (mut result, mut at) = (String::with_capacity(2 * line.len()), 0);
    while at < letters.len() {
        let kept = if is_markdown { kept_from(&letters, at) } else { at };
        if kept > at {
            result.extend(&letters[at..kept]);
            at = kept;
            continue;
        }
        match index_from(&letters, at) {
            Some((tag, inside, end)) => {
                let inside: String = letters[inside.0..inside.1].iter().collect();
                result.push_str(&format!("<{tag}>{}</{tag}>", line_of(&inside, is_markdown)));
                at = end;
            }
            None => {
                result.push(letters[at]);
                at += 1;
            }
        }
    }
    result
}

/// The end of what begins here and is no text: code, the target of a link, a tag; `at` if nothing of that begins.
fn kept_from(letters: &[char], at: usize) -> usize {
    let until = |from: usize, mark: char| {
        letters[from..].iter().position(|letter| *letter == mark).map(|found| from + found + 1)
    };
    let end = match (letters[at], letters.get(at + 1)) {
        ('`', _) => until(at + 1, '`'),
        (']', Some('(')) => until(at + 2, ')'),
        ('<', Some(next)) if next.is_ascii_alphabetic() || *next == '/' => until(at + 1, '>'),
        _ => None,
    };
    end.unwrap_or(at)
}

/// An index that begins here: its tag, where its text is, and where it ends.
fn index_from(letters: &[char], at: usize) -> Option<(&'static str, (usize, usize), usize)> {
    let sign = at + usize::from(letters[at] == '\\' && letters.get(at + 1) == Some(&'_'));
    let tag = match letters[sign] {
        '_' => "sub",
        '^' => "sup",
        _ => return None,
    };
    if letters.get(sign + 1) == Some(&'{') {
        let end = closing(letters, sign + 1)?;
        return Some((tag, (sign + 2, end), end + 1));
    }
    let is_part = |letter: &&char| letter.is_alphanumeric() || (tag == "sup" && **letter == '−');
    let count = letters[sign + 1..].iter().take_while(is_part).count();
    let follows = letters.get(sign + 1 + count);
    // A word such as one_word is no formula: what has an index is one letter, or ends in another sign.
    let base = at.checked_sub(1).map(|before| letters[before]);
    let before = at.checked_sub(2).map(|before| letters[before]);
    let of_letter = base.is_some_and(char::is_alphanumeric)
        && (tag == "sup"
            || base.is_some_and(|c| !c.is_ascii())
            || !before.is_some_and(|c| c.is_ascii_alphanumeric() || c == '_'));
    let of_sign = base.is_some_and(|c| "*)]'}̃̇".contains(c));
    let is_index = count > 0 && follows != Some(&'_') && (of_letter || of_sign);
    is_index.then_some((tag, (sign + 1, sign + 1 + count), sign + 1 + count))
}

/// Where the brace at `open` closes.
fn closing(letters: &[char], open: usize) -> Option<usize> {
    let mut depth = 0;
    for (at, letter) in letters.iter().enumerate().skip(open) {
        match letter {
            '{' => depth += 1,
            '}' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_are_set_in_text_and_not_in_code() {
        for (text, expected) in [
            ("x_{n+1} → 0", "x<sub>n+1</sub> → 0"),
            ("α\\*\\_n and α\\*_12", "α\\*<sub>n</sub> and α\\*<sub>12</sub>"),
            ("δ^{4/3} and 10^{−3}", "δ<sup>4/3</sup> and 10<sup>−3</sup>"),
            ("(−1)^m sin V_Y(h)", "(−1)<sup>m</sup> sin V<sub>Y</sub>(h)"),
            ("3cθ_j", "3cθ<sub>j</sub>"),
            ("M_{c_1}", "M<sub>c<sub>1</sub></sub>"),
            ("`x_1` and [a](b_1.md) <a id=\"b_2\">", "`x_1` and [a](b_1.md) <a id=\"b_2\">"),
            ("one_word and a_b_c", "one_word and a_b_c"),
            ("an open x_{1", "an open x_{1"),
        ] {
            assert_eq!(line_of(text, true), expected);
        }
    }

    #[test]
    fn indented_lines_of_a_page_of_formulas_are_displays() {
        let text = "Text:\n\n    V_Y(h) < 1\n    a*b\n\nMore\n```sh\nx_1\n```\n";
        let expected = "Text:\n\n<div class=\"formula\">V<sub>Y</sub>(h) &lt; 1\na*b\n</div>\n\nMore\n```sh\nx_1\n```\n";
        assert_eq!(set("docs/model.md", text), expected);
        assert!(set("docs/cli.md", text).contains("    V_Y(h) < 1"));
    }
}
