//! The streams of a call.

use std::fmt::Debug;
use std::io::{Read, Write};

/// The streams that a call reads and writes. In the program they are those of the process; in tests they are memory.
pub struct Streams<'a> {
    /// Standard input.
    pub input: &'a mut dyn Read,
    /// Whether a person types the input. The program then does not wait for it.
    pub input_is_terminal: bool,
    /// Whether the output is a terminal that shows colours.
    pub output_has_colors: bool,
    /// Standard output: results.
    pub output: &'a mut dyn Write,
    /// Standard error: refusals and notes.
    pub messages: &'a mut dyn Write,
}

impl Debug for Streams<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Streams").field("input_is_terminal", &self.input_is_terminal).finish()
    }
}
