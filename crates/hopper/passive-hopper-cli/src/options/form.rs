//! The form of the output: plain text, CSV or JSON; which tables; how many notes.

use crate::error::Error;
use crate::options::values;
use crate::output::{Form, TableKind};
use crate::refusal::shortened;
use crate::streams::Streams;

/// More threads than any computer has processors.
const MOST_THREADS: u64 = 65_535;

/// The options of every command that prints tables.
#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "Output")]
pub(crate) struct OutputOptions {
    /// Print JSON: an object with every table as an array of rows
    #[arg(long, conflicts_with = "csv")]
    json: bool,
    /// Print JSON, an object on a line of its own for each row: the first table, or that of --table
    #[arg(long, conflicts_with_all = ["csv", "json"])]
    ndjson: bool,
    /// Print CSV with one line of names: the first table, or that of --table
    #[arg(long)]
    csv: bool,
    /// Print this table only
    #[arg(long, value_name = "NAME")]
    table: Option<String>,
    /// Use so many threads [default: one for each processor]
    #[arg(long, value_name = "N", value_parser = values::whole(1..=MOST_THREADS))]
    threads: Option<u64>,
    /// Print no notes on standard error
    #[arg(short, long, conflicts_with = "verbose")]
    quiet: bool,
    /// Print on standard error how the numbers were computed, and in which time
    #[arg(short, long)]
    verbose: bool,
}

impl OutputOptions {
    /// The form of the output of a command with these tables.
    ///
    /// # Errors
    /// [`Error::Misuse`] for a table that is none of them.
    pub(crate) fn form(&self, tables: &[&'static TableKind]) -> Result<Form, Error> {
        let form = match (self.json, self.csv, self.ndjson) {
            (true, ..) => Form::json(),
            (_, true, _) => Form::csv(),
            (.., true) => Form::ndjson(),
            _ => Form::plain(),
        };
        let Some(name) = &self.table else { return Ok(form) };
        match tables.iter().find(|table| table.name == name) {
            Some(table) => Ok(form.only(table)),
            None => {
                let names: Vec<_> = tables.iter().map(|table| table.name).collect();
                let reason = format!("there is no such table; there are: {}", names.join(", "));
                Err(Error::misuse("--table", shortened(name), &reason))
            }
        }
    }

    /// Whether neither another form nor a table is asked for.
    pub(crate) fn is_plain(&self) -> bool {
        !(self.json || self.csv || self.ndjson) && self.table.is_none()
    }

    /// The number of threads, if one is given.
    pub(crate) fn threads(&self) -> Option<u64> {
        self.threads
    }

    /// Whether notes are not wanted.
    pub(crate) fn is_quiet(&self) -> bool {
        self.quiet
    }

    /// Whether notes on the computation are wanted.
    pub(crate) fn is_verbose(&self) -> bool {
        self.verbose
    }

    /// Prints a note on standard error, unless notes are not wanted.
    pub(crate) fn note(&self, streams: &mut Streams<'_>, text: impl std::fmt::Display) {
        if !self.quiet {
            // A note that cannot be printed is no failure of the command.
            let _ = writeln!(streams.messages, "{text}");
        }
    }

    /// Prints a note on how the numbers were computed, if it is wanted.
    pub(crate) fn explain(&self, streams: &mut Streams<'_>, text: impl std::fmt::Display) {
        if self.verbose {
            let _ = writeln!(streams.messages, "{text}");
        }
    }
}
