//! Numbers on standard input, one a line, in blocks whose parts are computed at once.
//!
//! ```text
//!   input ──► block of whole lines ──► parts, one a task ──► texts in the order of the lines ──► output
//! ```
//!
//! A block is what one read gives: a filter behind a slow program answers each line as it comes.

use crate::error::Error;
use crate::refusal::shortened;
use crate::streams::Streams;
use rayon::prelude::*;

/// Bytes of a read, and the longest line. A pipe gives 64 KiB at most; a file fills it, with some fifty thousand
/// lines. A larger block would answer later and use more memory.
const BLOCK: usize = 1 << 20;

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// Bytes of a part: some thousand lines, whose fates take a millisecond. A smaller part fills the vectors of the
/// kernel less; with a larger one the threads wait for the last of them.
const PART: usize = 1 << 15;

/// Lines that were passed over.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Skipped {
    /// How many.
    pub(crate) count: u64,
    /// The number of the first one, its text, and what is wrong.
    pub(crate) first: Option<(u64, String, String)>,
}

/// Reads numbers with `value` from all lines, and writes the texts that `write` makes of them, in their order.
/// `write` is told whether its numbers are the first. Lines that are no number are passed over if `skips`.
///
/// # Errors
/// [`Error::Misuse`] if a person would have to type the lines; [`Error::Input`] for a line that is no number, after
/// the texts of the lines before it; the errors of `write` and of the streams.
pub(crate) fn filter(
    streams: &mut Streams<'_>,
    skips: bool,
    value: impl Fn(&str) -> Result<f64, String> + Sync,
    write: impl Fn(&[f64], bool) -> Result<String, Error> + Sync,
) -> Result<Skipped, Error> {
    let mut skipped = Skipped::default();
    if streams.input_is_terminal {
        return Err(Error::Misuse(
            "SPEED: no speed is given, and standard input is a terminal; give speeds, or a file: hopper fate -M 0.2 < \
             FILE"
                .into(),
        ));
    }
    let mut block = vec![0; BLOCK];
    let (mut kept, mut line, mut begun, mut start) = (0, 0, false, 0);
    loop {
        let read = match streams.input.read(&mut block[kept..]) {
            Ok(read) => read,
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
            Err(source) => return Err(Error::File { path: "standard input".into(), source }),
        };
        let filled = kept + read;
        // Whole lines; at the end of the input also a last one without a line feed.
        let end = match block[kept..filled].iter().rposition(|&byte| byte == b'\n') {
            _ if read == 0 => filled,
            Some(at) => kept + at + 1,
            None if filled == block.len() => {
                let text = shortened(&String::from_utf8_lossy(&block[..filled]));
                let reason = format!("it is longer than {BLOCK} bytes; give one number a line");
                return Err(Error::Input { line: line + 1, text, reason });
            }
            None => {
                kept = filled;
                continue;
            }
        };
        // Editors of some systems write a byte order mark before the first line.
        if line == 0 && block[..end].starts_with(BYTE_ORDER_MARK) {
            start = BYTE_ORDER_MARK.len();
        }
        let lines = &block[std::mem::take(&mut start)..end];
        let parts: Vec<ReadLines> =
            parts(lines).map(|bytes| ReadLines::read(bytes, skips, &value)).collect();
        let first = parts.iter().position(|part| !part.values.is_empty());
        let texts: Vec<_> = parts
            .par_iter()
            .enumerate()
            .map(|(at, part)| write(&part.values, !begun && first == Some(at)))
            .collect();
        for (part, text) in parts.into_iter().zip(texts) {
            streams.output.write_all(text?.as_bytes()).map_err(Error::output)?;
            skipped.count += part.skipped;
            if let (true, Some((at, text, reason))) = (skips, &part.wrong) {
                skipped.first.get_or_insert((line + at, text.clone(), reason.clone()));
            } else if let Some((at, text, reason)) = part.wrong {
                streams.output.flush().map_err(Error::output)?;
                return Err(Error::Input { line: line + at, text, reason });
            }
            line += part.lines;
        }
        begun |= first.is_some();
        streams.output.flush().map_err(Error::output)?;
        if read == 0 {
            return Ok(skipped);
        }
        block.copy_within(end..filled, 0);
        kept = filled - end;
    }
}

/// Splits whole lines into parts of whole lines.
fn parts(mut bytes: &[u8]) -> impl Iterator<Item = &[u8]> {
    std::iter::from_fn(move || {
        let after = bytes.get(PART..).unwrap_or_default();
        let rest =
            after.iter().position(|&byte| byte == b'\n').map_or(0, |at| after.len() - at - 1);
        let (part, others) = bytes.split_at(bytes.len() - rest);
        bytes = others;
        (!part.is_empty()).then_some(part)
    })
}

/// The numbers of some lines, up to the first wrong one, unless wrong ones are passed over.
struct ReadLines {
    values: Vec<f64>,
    lines: u64,
    skipped: u64,
    /// The number of the first wrong line in this part, its text, and what is wrong.
    wrong: Option<(u64, String, String)>,
}

impl ReadLines {
    fn read(bytes: &[u8], skips: bool, value: &impl Fn(&str) -> Result<f64, String>) -> Self {
        let mut part = ReadLines {
            values: Vec::with_capacity(bytes.len() / 8),
            lines: 0,
            skipped: 0,
            wrong: None,
        };
        let whole = bytes.strip_suffix(b"\n").unwrap_or(bytes);
        for line in whole.split(|&byte| byte == b'\n') {
            part.lines += 1;
            let line = line.trim_ascii();
            if line.is_empty() || line[0] == b'#' {
                continue;
            }
            let read = match std::str::from_utf8(line) {
                Ok(text) => value(text),
                Err(_) => Err("it is no text in UTF-8; give one number a line".into()),
            };
            match read {
                Ok(value) => part.values.push(value),
                Err(reason) => {
                    let text = shortened(&String::from_utf8_lossy(line));
                    part.wrong.get_or_insert((part.lines, text, reason));
                    if !skips {
                        break;
                    }
                    part.skipped += 1;
                }
            }
        }
        part
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Read;

    /// A reader that gives at most so many bytes at a time.
    struct Slow<'a>(&'a [u8], usize);

    impl Read for Slow<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
            let count = self.1.min(self.0.len()).min(buffer.len());
            buffer[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    fn filtered(text: &str, at_a_time: usize) -> (String, Result<(), Error>) {
        let (mut output, mut messages) = (Vec::new(), Vec::new());
        let mut streams = Streams {
            input: &mut Slow(text.as_bytes(), at_a_time),
            input_is_terminal: false,
            output: &mut output,
            messages: &mut messages,
        };
        let write = |values: &[f64], first: bool| {
            let texts = values.iter().enumerate();
            Ok(texts
                .map(|(k, v)| format!("{v}{}", if first && k == 0 { "!" } else { "," }))
                .collect())
        };
        let value = |text: &str| text.parse().map_err(|_| "it is no number".to_owned());
        let result = filter(&mut streams, false, value, write).map(drop);
        (String::from_utf8(output).unwrap(), result)
    }

    #[test]
    fn the_pieces_in_which_the_input_comes_do_not_matter() {
        for (text, at_a_time) in [1, 2, 3, 100].into_iter().flat_map(|at_a_time| {
            ["# speeds\n\n1\r\n 2 \n3\n\n4", "\u{feff}1\n2\n3\n4"].map(|text| (text, at_a_time))
        }) {
            let (output, result) = filtered(text, at_a_time);
            assert!(output == "1!2,3,4," && result.is_ok(), "{at_a_time}: {output}");
        }
        let many: String = (0..100_000).map(|k| format!("{k}\n")).collect();
        let (output, result) = filtered(&many, 1 << 20);
        assert!(result.is_ok() && output.starts_with("0!1,2,") && output.ends_with("99998,99999,"));
        assert_eq!(output.matches(',').count(), 99_999);
        assert_eq!(filtered("", 5).0, "");
    }

    #[test]
    fn a_wrong_line_is_named_after_the_lines_before_it() {
        let many: String = (0..50_000).map(|k| format!("{k}\n")).collect();
        for at_a_time in [1000, 1 << 20] {
            let (output, result) = filtered(&format!("{many}seven\n8\n"), at_a_time);
            assert!(output.ends_with("49998,49999,"), "{at_a_time}");
            let message = result.unwrap_err().to_string();
            assert_eq!(message, "standard input, line 50001, 'seven': it is no number");
        }
        let long = "1".repeat(BLOCK + 1);
        assert!(matches!(filtered(&long, 1 << 20).1, Err(Error::Input { line: 1, .. })));
    }
}
