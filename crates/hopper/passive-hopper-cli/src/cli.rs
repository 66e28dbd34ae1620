//! The command line: its commands, their help, and their start.

use crate::basins::{self, Action, CoverageOptions, JobOptions, ScalesOptions, ZoomOptions};
use crate::commands::{self, Page, page};
use crate::error::Error;
use crate::options::form::OutputOptions;
use crate::program::Call;
use crate::streams::Streams;
use clap::{CommandFactory, Parser, Subcommand};

/// The passive hopper: hops, orbits, fates, the map, its basins, and units.
#[derive(Debug, Parser)]
#[command(name = "hopper", version, about, long_about = ABOUT, after_long_help = EXIT_STATUS)]
#[command(infer_long_args = false, max_term_width = page::WIDEST, disable_help_subcommand = false)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The first text of `hopper --help`.
const ABOUT: &str = "\
The passive hopper: two masses on one spring, with plastic landings and no motor.

All commands use the dimensionless model. The mass ratio is M = m₂/m₁, the lower mass over the upper one. Lengths are \
in \
units of m₂g/k, times in units of 1/ω with ω² = k(1+M)/m₂, speeds in units of m₂gω/k, and energies in units of \
m₁m₂g²/k. \
`hopper units` converts kilograms, metres and seconds.

Every computed number has a bound on its error, taken from the exact arguments. In CSV and JSON it is in the column \
NAME_error, after all other \
columns, or in the column that the help names; 0 is exact, and nothing stands there if no bound is known. Text shows \
only digits that are certain, \
or a number and its error if none is, or ? if no bound is known. Bounds hold for the number that the decimals read \
back as. Numbers that are bounds themselves, such as the ends of intervals, are shown whole.";

/// The last text of `hopper --help`.
const EXIT_STATUS: &str = "\
Exit status:
  0    done; also if the reader of the output closes it early
  1    failed: a file could not be written, or a number could not be computed
  2    misuse: an argument or a line of the input is wrong, and the message says how to mend it
  130  interrupted (143: terminated); the same call continues, or begins anew if it writes no folder
";

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Follow one hop: landings, times, energy lost, next lift-off speed, slopes, error bounds
    Hop(commands::hop::Options),
    /// Follow an orbit hop by hop until its fate; cobweb, motion and animation
    Orbit(commands::orbit::Options),
    /// Find the fates of lift-off speeds, with the trap and the number of hops; a filter
    Fate(commands::fate::Options),
    /// Compute the basins over mass ratio and speed as rasters, in pieces; a call that was killed can be continued
    Basins(Box<basins::Options>),
    /// Compute the share of every basin in each pixel, so that no needle is missed
    Coverage(JobOptions<CoverageOptions>),
    /// Show the speeds below a fixed point, or beside a preimage of it, at all scales
    Scales(JobOptions<ScalesOptions>),
    /// Make a sequence of frames into the edge of a basin
    Zoom(JobOptions<ZoomOptions>),
    /// Show the map at one mass ratio: fixed points, traps, crises, the curve as data or as a figure
    Map(commands::map::Options),
    /// Compute the basins at one mass ratio as intervals, and their fractions with bounds
    Intervals(commands::intervals::Options),
    /// Convert kilograms, metres and seconds to the mass ratio M and the speed α, and back
    Units(commands::units::Options),
    /// Print the completions of a shell
    Completions(commands::texts::Completions),
    /// Print the manual page of the program, or of a command
    Manual(commands::texts::Manual),
}

impl Call for Command {
    fn output(&self) -> Option<&OutputOptions> {
        match self {
            Command::Hop(options) => Some(&options.output),
            Command::Orbit(options) => Some(&options.output),
            Command::Fate(options) => Some(&options.output),
            Command::Basins(options) => Some(match &options.action {
                Some(Action::Status(folder) | Action::Verify(folder)) => &folder.output,
                None => &options.output,
            }),
            Command::Coverage(options) => Some(&options.output),
            Command::Scales(options) => Some(&options.output),
            Command::Zoom(options) => Some(&options.output),
            Command::Map(options) => Some(&options.output),
            Command::Intervals(options) => Some(&options.output),
            Command::Units(options) => Some(&options.output),
            Command::Completions(_) | Command::Manual(_) => None,
        }
    }

    fn start(self: Box<Self>, streams: Streams<'_>) -> Result<(), Error> {
        match *self {
            Command::Hop(options) => commands::hop::run(&options, streams),
            Command::Orbit(options) => commands::orbit::run(&options, streams),
            Command::Fate(options) => commands::fate::run(&options, streams),
            Command::Basins(options) => basins::run(&options, streams),
            Command::Coverage(options) => basins::run_other(&options, streams),
            Command::Scales(options) => basins::run_other(&options, streams),
            Command::Zoom(options) => basins::run_other(&options, streams),
            Command::Map(options) => commands::map::run(&options, streams),
            Command::Intervals(options) => commands::intervals::run(&options, streams),
            Command::Units(options) => commands::units::run(&options, streams),
            Command::Completions(options) => {
                commands::texts::completions(&options, command_line(), streams)
            }
            Command::Manual(options) => commands::texts::manual(&options, command_line(), streams),
        }
    }
}

/// The pages of the commands, which complete their help.
pub(crate) const PAGES: [(&str, &Page); 7] = [
    ("hop", &commands::hop::PAGE),
    ("orbit", &commands::orbit::PAGE),
    ("fate", &commands::fate::PAGE),
    ("basins", &basins::PAGE),
    ("map", &commands::map::PAGE),
    ("intervals", &commands::intervals::PAGE),
    ("units", &commands::units::PAGE),
];

/// The whole command line, with the help of every command.
pub(crate) fn command_line() -> clap::Command {
    let program = commands::texts::with_names(Cli::command());
    PAGES.iter().chain(&basins::PAGES).fold(program, |command, (name, page)| {
        command.mut_subcommand(name, |command| command.after_long_help(page.text()))
    })
}
