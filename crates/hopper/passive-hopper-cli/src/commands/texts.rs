//! `completions` and `manual`, of both programs: texts for shells and for `man`.

use crate::error::Error;
use crate::refusal::shortened;
use crate::streams::Streams;
use clap_complete::Shell;

/// The shell.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Completions {
    /// The shell
    #[arg(value_parser = [clap::builder::PossibleValue::new("bash"), "fish".into(), "zsh".into()])]
    shell: String,
}

/// The page.
#[derive(Debug, Clone, clap::Args)]
pub(crate) struct Manual {
    /// The command whose page is printed [default: the page of the program]
    command: Option<String>,
}

/// Prints what a shell needs to complete commands and options.
pub(crate) fn completions(
    options: &Completions,
    mut program: clap::Command,
    streams: Streams<'_>,
) -> Result<(), Error> {
    let shell = match options.shell.as_str() {
        "bash" => Shell::Bash,
        "fish" => Shell::Fish,
        _ => Shell::Zsh,
    };
    let mut text = Vec::new();
    let name = program.get_name().to_owned();
    clap_complete::generate(shell, &mut program, name, &mut text);
    streams.output.write_all(&text).map_err(Error::output)
}

/// Prints a page for `man`.
pub(crate) fn manual(
    options: &Manual,
    program: clap::Command,
    streams: Streams<'_>,
) -> Result<(), Error> {
    let own_name = program.get_name().to_owned();
    let command = match &options.command {
        None => program,
        Some(name) => {
            let names: Vec<_> =
                program.get_subcommands().map(|own| own.get_name().to_owned()).collect();
            let Some(own) = program.find_subcommand(name) else {
                let reason = format!("there is no such command; there are: {}", names.join(", "));
                return Err(Error::misuse("COMMAND", shortened(name), &reason));
            };
            let own = own.clone().display_name(format!("{own_name}-{name}"));
            own.bin_name(format!("{own_name} {name}"))
        }
    };
    let mut text = Vec::new();
    clap_mangen::Man::new(command).render(&mut text).map_err(Error::output)?;
    streams.output.write_all(&text).map_err(Error::output)
}
