//! What a call has besides its options, and what it has to do.

use crate::interrupt::Interrupt;
use std::io::Write;

/// The pieces of a job.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Work {
    /// The folder of the finished ones.
    pub(crate) folder: &'static str,
    /// What messages call them.
    pub(crate) unit: &'static str,
    pub(crate) count: usize,
    /// Pixels of a piece.
    pub(crate) pixels: usize,
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
