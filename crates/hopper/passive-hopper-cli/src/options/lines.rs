//! Starts on standard input, one a line, in blocks whose parts are computed at once.
//!
//! ```text
//!   input ──► block of whole lines ──► parts, one a task ──► texts in the order of the lines ──► output
//! ```
//!
//! A block is what one read gives: a filter behind a slow program answers each line as it comes.

use crate::error::Error;
use crate::options::line_form::{LineForm, Start, UNCLOSED};
use crate::refusal::shortened;
use crate::streams::Streams;
use rayon::prelude::*;

/// Bytes of a read, and the longest line. A pipe gives 64 KiB at most; a file fills it, with some fifty thousand
/// lines. A larger block would answer later and use more memory.
const BLOCK: usize = 1 << 20;

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// The most bytes of a part whose lines take microseconds: some thousand lines, whose fates take a millisecond. A
/// smaller part fills the vectors of the kernel less; with a larger one the threads wait for the last of them.
pub(crate) const PART: usize = 1 << 15;

/// The fewest bytes of such a part: of a short input all threads have some.
const SMALLEST_PART: usize = 1 << 9;

/// Parts for each thread that are computed before the next ones.
const PARTS_A_THREAD: usize = 4;

/// Lines that were passed over.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Skipped {
    /// How many.
    pub(crate) count: u64,
    /// The number of the first one, its text, and what is wrong.
    pub(crate) first: Option<(u64, String, String)>,
}

/// Reads a start from each line, and writes `head` and the texts that `write` makes of them, in their order. `write` is told
/// whether its starts are the first, and has starts of lines of `largest` bytes at most, if it is not one line. Lines
/// that are none are passed over if `skips`. Nothing is written before a line that can be read, or the end.
///
/// # Errors
/// [`Error::Misuse`] if a person would have to type the lines; [`Error::Input`] for a line that is no start, after
/// the texts of the lines before it; the errors of `write` and of the streams.
pub(crate) fn filter(
    streams: &mut Streams<'_>,
    skips: bool,
    form: &LineForm,
    (head, largest): (&str, usize),
    write: impl Fn(&[Start], bool) -> Result<String, Error> + Sync,
) -> Result<Skipped, Error> {
    let (mut skipped, mut head_is_written) = (Skipped::default(), false);
    if streams.input_is_terminal {
        return Err(Error::Misuse(
            "SPEED: no speed is given, and standard input is a terminal; give speeds, or the lines of a file: < FILE"
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
                let reason = format!("it is longer than {BLOCK} bytes; give one start a line");
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
        let lines = after_names(form, lines, &mut line)?;
        let size = (lines.len() / PARTS_A_THREAD / rayon::current_num_threads())
            .clamp(SMALLEST_PART.min(largest), largest);
        let mut parts = parts(lines, size).map(|bytes| ReadLines::read(bytes, skips, form));
        loop {
            // So many at once that no thread waits for long, and that their texts fit the memory.
            let some: Vec<ReadLines> =
                parts.by_ref().take(PARTS_A_THREAD * rayon::current_num_threads()).collect();
            if some.is_empty() {
                break;
            }
            let first = some.iter().position(|part| !part.starts.is_empty());
            let texts: Vec<_> = some
                .par_iter()
                .enumerate()
                .map(|(at, part)| write(&part.starts, !begun && first == Some(at)))
                .collect();
            begun |= first.is_some();
            for (part, text) in some.into_iter().zip(texts) {
                if !std::mem::replace(&mut head_is_written, true) {
                    streams.output.write_all(head.as_bytes()).map_err(Error::output)?;
                }
                streams.output.write_all(text?.as_bytes()).map_err(Error::output)?;
                skipped.count += part.skipped;
                if let (true, Some((at, text, reason))) = (skips && !part.ends, &part.wrong) {
                    skipped.first.get_or_insert((line + at, text.clone(), reason.clone()));
                } else if let Some((at, text, reason)) = part.wrong {
                    streams.output.flush().map_err(Error::output)?;
                    return Err(Error::Input { line: line + at, text, reason });
                }
                line += part.lines;
            }
            streams.output.flush().map_err(Error::output)?;
        }
        if read == 0 {
            if !head_is_written {
                streams.output.write_all(head.as_bytes()).map_err(Error::output)?;
            }
            return Ok(skipped);
        }
        drop(parts);
        block.copy_within(end..filled, 0);
        kept = filled - end;
    }
}

/// The lines behind the one with the names of columns, if that is still to come.
fn after_names<'a>(
    form: &LineForm,
    mut lines: &'a [u8],
    line: &mut u64,
) -> Result<&'a [u8], Error> {
    while form.wants_names() && !lines.is_empty() {
        let length = lines.iter().position(|&byte| byte == b'\n').map_or(lines.len(), |at| at + 1);
        let (names, others) = lines.split_at(length);
        lines = others;
        *line += 1;
        if is_content(names) {
            let text = String::from_utf8_lossy(without_end(names));
            form.read_names(&text).map_err(|reason| Error::Input {
                line: *line,
                text: shortened(text.trim()),
                reason,
            })?;
        }
    }
    Ok(lines)
}

/// Splits whole lines into parts of whole lines.
fn parts(mut bytes: &[u8], size: usize) -> impl Iterator<Item = &[u8]> {
    std::iter::from_fn(move || {
        let after = bytes.get(size..).unwrap_or_default();
        let rest =
            after.iter().position(|&byte| byte == b'\n').map_or(0, |at| after.len() - at - 1);
        let (part, others) = bytes.split_at(bytes.len() - rest);
        bytes = others;
        (!part.is_empty()).then_some(part)
    })
}

/// Whether a line is neither empty nor a comment.
fn is_content(line: &[u8]) -> bool {
    line.trim_ascii().first().is_some_and(|&first| first != b'#')
}

/// A line without what ends it. A tab is no end: it divides fields.
fn without_end(line: &[u8]) -> &[u8] {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    line.strip_suffix(b"\r").unwrap_or(line)
}

/// The starts of some lines, up to the first wrong one, unless wrong ones are passed over.
struct ReadLines {
    starts: Vec<Start>,
    lines: u64,
    skipped: u64,
    /// The number of the first wrong line in this part, its text, and what is wrong.
    wrong: Option<(u64, String, String)>,
    /// Whether that line ends the call in any case.
    ends: bool,
}

impl ReadLines {
    fn read(bytes: &[u8], skips: bool, form: &LineForm) -> Self {
        let mut part = ReadLines {
            starts: Vec::with_capacity(bytes.len() / 8),
            lines: 0,
            skipped: 0,
            wrong: None,
            ends: false,
        };
        let whole = bytes.strip_suffix(b"\n").unwrap_or(bytes);
        for line in whole.split(|&byte| byte == b'\n') {
            part.lines += 1;
            let line = without_end(line);
            if !is_content(line) {
                continue;
            }
            let read = match std::str::from_utf8(line) {
                Ok(text) => form.read(text),
                Err(_) => Err("it is no text in UTF-8; give numbers in UTF-8".into()),
            };
            match read {
                Ok(start) => part.starts.push(start),
                Err(reason) => {
                    let text = shortened(&String::from_utf8_lossy(line.trim_ascii()));
                    let goes_on = reason == UNCLOSED;
                    if goes_on {
                        // The lines behind it may be parts of a field.
                        part.ends = true;
                        part.wrong = None;
                    }
                    part.wrong.get_or_insert((part.lines, text, reason));
                    if !skips || goes_on {
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
    use crate::options::line_form::Columns;
    use passive_hopper::MassRatio;
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
        filtered_as(&LineForm::Speed(MassRatio::ONE), text, at_a_time)
    }

    fn filtered_as(form: &LineForm, text: &str, at_a_time: usize) -> (String, Result<(), Error>) {
        let (mut output, mut messages) = (Vec::new(), Vec::new());
        let mut streams = Streams {
            input: &mut Slow(text.as_bytes(), at_a_time),
            input_is_terminal: false,
            output_has_colors: false,
            output: &mut output,
            messages: &mut messages,
        };
        let write = |starts: &[Start], first: bool| {
            let end = |k: usize| if first && k == 0 { "!" } else { "," };
            let texts = starts.iter().enumerate();
            Ok(texts.map(|(k, start)| format!("{}{}", start.speed, end(k))).collect())
        };
        let result = filter(&mut streams, false, form, ("", PART), write).map(drop);
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
        let many: String = (1..100_000).map(|k| format!("{k}\n")).collect();
        let (output, result) = filtered(&many, 1 << 20);
        assert!(result.is_ok() && output.starts_with("1!2,3,") && output.ends_with("99998,99999,"));
        assert_eq!(output.matches(',').count(), 99_998);
        assert_eq!(filtered("", 5).0, "");
    }

    #[test]
    fn the_names_of_columns_may_come_in_pieces() {
        for at_a_time in [1, 3, 100] {
            let form = LineForm::Columns(Columns::new("v".into(), Ok(MassRatio::ONE)));
            let (output, result) = filtered_as(&form, "# runs\n\nrun,v\na,1\n\nb,2", at_a_time);
            assert!(output == "1!2," && result.is_ok(), "{at_a_time}: {output}");
        }
        let form = LineForm::Columns(Columns::new("w".into(), Ok(MassRatio::ONE)));
        let message = filtered_as(&form, "\nrun,v\na,1\n", 100).1.unwrap_err().to_string();
        assert!(message.starts_with("standard input, line 2, 'run,v': there is no column 'w'"));
    }

    #[test]
    fn a_wrong_line_is_named_after_the_lines_before_it() {
        let many: String = (1..50_000).map(|k| format!("{k}\n")).collect();
        for at_a_time in [1000, 1 << 20] {
            let (output, result) = filtered(&format!("{many}seven\n8\n"), at_a_time);
            assert!(output.ends_with("49998,49999,"), "{at_a_time}");
            let message = result.unwrap_err().to_string();
            assert!(message.starts_with("standard input, line 50000, 'seven': it is not a number"));
        }
        let long = "1".repeat(BLOCK + 1);
        assert!(matches!(filtered(&long, 1 << 20).1, Err(Error::Input { line: 1, .. })));
    }
}
