//! What a call has besides its options, and what it has to do.

use crate::interrupt::Interrupt;
use std::io::Write;

/// The pieces of a job.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Work<'a> {
    /// The folder of the finished ones.
    pub(crate) folder: &'a str,
    /// What messages call them.
    pub(crate) unit: &'static str,
    pub(crate) count: usize,
    /// Pixels of a piece.
    pub(crate) pixels: usize,
    /// What the bytes of a piece are.
    pub(crate) payload: Payload,
}

/// What the bytes of a piece are, and with that their number.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Payload {
    /// A tile of an array: up to so many columns of the array each, with elements of so many bytes.
    Tile { width: usize, columns: usize, rows: usize, element: usize },
    /// A column of shares of so many rows, which may be blank.
    Column { rows: usize, may_be_blank: bool },
    /// A frame: a strip of so many rows, and a window of so many rows and columns, in colours.
    Frame { rows: usize, columns: usize },
}

impl Payload {
    /// Whether bytes have the number that the piece `at` has.
    pub(crate) fn holds(self, at: usize, bytes: &[u8]) -> bool {
        match self {
            Payload::Tile { width, columns, rows, element } => {
                let left = columns.saturating_sub(at * width).min(width);
                bytes.len() == left * rows * element
            }
            Payload::Column { may_be_blank: true, .. } if bytes.is_empty() => true,
            Payload::Column { rows, .. } => after_labels(bytes, |labels| 4 * labels * rows),
            Payload::Frame { rows, columns } => after_labels(bytes, |_| 3 * rows * (1 + columns)),
        }
    }
}

/// Whether bytes are a number of labels, these labels, and then as many bytes as `rest` gives for this number.
fn after_labels(bytes: &[u8], rest: impl Fn(usize) -> usize) -> bool {
    let Some((count, after)) = bytes.split_first_chunk::<2>() else { return false };
    let count = usize::from(u16::from_le_bytes(*count));
    after.len() == 2 * count + rest(count)
}

/// What a call has besides its options.
pub(crate) struct Call<'a> {
    pub(crate) interrupt: Interrupt,
    pub(crate) quiet: bool,
    pub(crate) messages: &'a mut dyn Write,
}

impl Call<'_> {
    /// A line for the user that is no result.
    pub(crate) fn note(&mut self, text: &str) {
        if !self.quiet {
            // A note that cannot be written is no failure of the job.
            let _ = writeln!(self.messages, "{text}");
        }
    }
}
