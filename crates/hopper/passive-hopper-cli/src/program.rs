//! One call of the program: from its arguments to its exit status.

use crate::cli::{self, Parsed};
use crate::error::Error;
use crate::refusal;
use crate::streams::Streams;
use std::ffi::OsString;
use std::io::{BufWriter, IsTerminal, Write};
use std::process::ExitCode;
use std::time::Instant;

/// Runs the program with the arguments and the streams of the process.
pub fn main() -> ExitCode {
    let input = std::io::stdin();
    let streams = Streams {
        input_is_terminal: input.is_terminal(),
        input: &mut input.lock(),
        output: &mut std::io::stdout().lock(),
        messages: &mut std::io::stderr(),
    };
    ExitCode::from(run(std::env::args_os(), streams))
}

/// Runs one call, and returns its exit status. The first argument is the name of the program.
///
/// A refusal or a failure is one line on [`Streams::messages`]. A reader that closes the output ends the call
/// without an error.
pub fn run(arguments: impl IntoIterator<Item = OsString>, streams: Streams<'_>) -> u8 {
    let Streams { input, input_is_terminal, output, messages } = streams;
    let mut output = BufWriter::new(output);
    let begin = Instant::now();
    let mut verbose = false;
    let result = match cli::parse(arguments) {
        Ok(Parsed::Command(command)) => {
            verbose = command.is_verbose();
            let (output, messages) = (&mut output, &mut *messages);
            cli::start(*command, Streams { input, input_is_terminal, output, messages })
        }
        Ok(Parsed::Text(text)) => output.write_all(text.as_bytes()).map_err(Error::output),
        Err(refused) => Err(refused),
    };
    let result = result.and_then(|()| output.flush().map_err(Error::output));
    // What an interrupted call has computed is not lost. A closed output has no reader.
    let _ = output.flush();
    drop(output);
    if verbose && result.is_ok() {
        let (seconds, threads) = (begin.elapsed().as_secs_f64(), rayon::current_num_threads());
        let _ = writeln!(messages, "took {seconds:.3} s, with up to {threads} threads");
    }
    match result {
        Ok(()) | Err(Error::ClosedOutput) => 0,
        Err(error) => {
            // If standard error is closed, the exit status is the only message.
            let interrupted = matches!(error, Error::Interrupted { .. } | Error::Ended { .. });
            let kind = if interrupted { "" } else { "error: " };
            let _ = writeln!(messages, "{kind}{}", refusal::one_line(&error.to_string()));
            error.exit_status()
        }
    }
}
