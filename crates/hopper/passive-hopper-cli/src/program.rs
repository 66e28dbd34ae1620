//! One call of a program: from its arguments to its exit status.

use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::streams::Streams;
use crate::{cli, model, refusal};
use clap::FromArgMatches;
use clap::error::ErrorKind;
use std::ffi::OsString;
use std::io::{BufWriter, IsTerminal, Write};
use std::process::ExitCode;
use std::time::Instant;

/// A call of one of the programs: a command with its options.
pub(crate) trait Call {
    /// The options of its output; `None` for a text.
    fn output(&self) -> Option<&OutputOptions>;

    /// Runs it.
    fn start(self: Box<Self>, streams: Streams<'_>) -> Result<(), Error>;
}

/// One of the programs.
struct Program {
    command_line: fn() -> clap::Command,
    call: fn(&clap::ArgMatches) -> Result<Box<dyn Call>, clap::Error>,
}

const HOPPER: Program = Program {
    command_line: cli::command_line,
    call: |matches| Ok(Box::new(cli::Cli::from_arg_matches(matches)?.command)),
};

const NONSMOOTH: Program = Program {
    command_line: model::cli::command_line,
    call: |matches| Ok(Box::new(model::cli::Cli::from_arg_matches(matches)?.command)),
};

/// What the arguments ask for.
enum Parsed {
    /// A command to run.
    Command(Box<dyn Call>),
    /// A text to print: help or version.
    Text(String),
}

impl Program {
    /// Reads the arguments.
    fn parse(&self, arguments: impl IntoIterator<Item = OsString>) -> Result<Parsed, Error> {
        let arguments: Vec<OsString> = arguments.into_iter().collect();
        let program = (self.command_line)();
        let name = program.get_name().to_owned();
        let matches = program.try_get_matches_from(&arguments);
        match matches.and_then(|matches| (self.call)(&matches)) {
            Ok(command) => Ok(Parsed::Command(command)),
            Err(error) => match error.kind() {
                ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
                    Ok(Parsed::Text(error.to_string()))
                }
                ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => Err(Error::Misuse(format!(
                    "a command is missing; `{name} --help` shows the commands"
                ))),
                _ => Err(Error::Misuse(refusal::line(&error, &arguments))),
            },
        }
    }
}

/// Runs `hopper` with the arguments and the streams of the process.
pub fn main() -> ExitCode {
    with_own_streams(&HOPPER)
}

/// Runs `nonsmooth` with the arguments and the streams of the process.
pub fn nonsmooth_main() -> ExitCode {
    with_own_streams(&NONSMOOTH)
}

fn with_own_streams(program: &Program) -> ExitCode {
    let input = std::io::stdin();
    // https://no-color.org: any text in NO_COLOR means none.
    let no_color = std::env::var_os("NO_COLOR").is_some_and(|text| !text.is_empty());
    let streams = Streams {
        input_is_terminal: input.is_terminal(),
        output_has_colors: std::io::stdout().is_terminal() && !no_color,
        input: &mut input.lock(),
        output: &mut std::io::stdout().lock(),
        messages: &mut std::io::stderr(),
    };
    ExitCode::from(answer(program, std::env::args_os(), streams))
}

/// Runs one call of `hopper`, and returns its exit status. The first argument is the name of the program.
///
/// A refusal or a failure is one line on [`Streams::messages`]. A reader that closes the output ends the call
/// without an error.
pub fn run(arguments: impl IntoIterator<Item = OsString>, streams: Streams<'_>) -> u8 {
    answer(&HOPPER, arguments, streams)
}

/// Runs one call of `nonsmooth`, as [`run`] does of `hopper`.
pub fn run_nonsmooth(arguments: impl IntoIterator<Item = OsString>, streams: Streams<'_>) -> u8 {
    answer(&NONSMOOTH, arguments, streams)
}

/// Sets the number of threads of the process, if one is given.
fn with_threads(threads: Option<u64>) -> Result<(), Error> {
    let Some(threads) = threads else { return Ok(()) };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(usize::try_from(threads).unwrap_or(1));
    // Within a process that has computed before, the number is fixed.
    let refused = |error| Error::Misuse(format!("--threads {threads}: {error}"));
    pool.build_global().map_err(refused)
}

fn answer(
    program: &Program,
    arguments: impl IntoIterator<Item = OsString>,
    streams: Streams<'_>,
) -> u8 {
    let Streams { input, input_is_terminal, output_has_colors, output, messages } = streams;
    let mut output = BufWriter::new(output);
    let begin = Instant::now();
    let mut verbose = false;
    let result = match program.parse(arguments) {
        Ok(Parsed::Command(command)) => {
            let options = command.output();
            verbose = options.is_some_and(OutputOptions::is_verbose);
            let threads = options.and_then(OutputOptions::threads);
            let (output, messages) = (&mut output, &mut *messages);
            with_threads(threads).and_then(|()| {
                command.start(Streams {
                    input,
                    input_is_terminal,
                    output_has_colors,
                    output,
                    messages,
                })
            })
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
