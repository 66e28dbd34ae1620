//! `completions` and `manual`, of both programs: texts for shells and for `man`.

use crate::error::Error;
use crate::refusal::shortened;
use crate::streams::Streams;
use clap::builder::PossibleValuesParser;
use clap_complete::Shell;
use resumable_job::{make_folder, write_atomically};
use std::path::{Path, PathBuf};

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
    /// Write the pages of the program and of all commands to this folder, such as ~/.local/share/man/man1
    #[arg(long, value_name = "DIR", conflicts_with = "command", value_hint = clap::ValueHint::DirPath)]
    all: Option<PathBuf>,
}

/// The program, whose `manual` knows the names of its commands, so that a shell completes them.
pub(crate) fn with_names(program: clap::Command) -> clap::Command {
    let names: Vec<String> =
        program.get_subcommands().map(|own| own.get_name().to_owned()).collect();
    let names = PossibleValuesParser::new(names);
    program.mut_subcommand("manual", |manual| {
        manual.mut_arg("command", |own| own.value_parser(names).hide_possible_values(true))
    })
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

/// A program whose commands have no command `help`, which has no page.
fn without_help(program: clap::Command) -> clap::Command {
    program.disable_help_subcommand(true).mut_subcommands(without_help)
}

/// Writes the page of a command, and those of its own commands.
fn write_pages(command: clap::Command, folder: &Path) -> Result<(), Error> {
    let name = command.get_display_name().unwrap_or_else(|| command.get_name()).to_owned();
    for own in command.get_subcommands() {
        let name = format!("{name}-{}", own.get_name());
        write_pages(own.clone().display_name(name), folder)?;
    }
    let path = folder.join(format!("{name}.1"));
    let mut text = Vec::new();
    clap_mangen::Man::new(command).render(&mut text).map_err(Error::output)?;
    Ok(write_atomically(&path, &text)?)
}

/// Prints a page for `man`.
pub(crate) fn manual(
    options: &Manual,
    program: clap::Command,
    streams: Streams<'_>,
) -> Result<(), Error> {
    if let Some(folder) = &options.all {
        make_folder(folder)?;
        return write_pages(without_help(program), folder);
    }
    let program = without_help(program);
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
