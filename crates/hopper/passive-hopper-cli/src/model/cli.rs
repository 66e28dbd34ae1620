//! The command line of `nonsmooth`: its commands, and their start.

use crate::error::Error;
use crate::model::{basin, branch, diagram, prove, prove_basin, run, section};
use crate::options::form::OutputOptions;
use crate::program::Call;
use crate::streams::Streams;
use clap::{Parser, Subcommand};

/// Any hybrid system, from a file with its equations: runs, returns, branches, basins, proofs.
#[derive(Debug, Parser)]
#[command(name = "nonsmooth", version, about, long_about = ABOUT, after_long_help = EXAMPLE)]
#[command(infer_long_args = false, max_term_width = crate::commands::page::WIDEST)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const ABOUT: &str = "\
Any hybrid system: flows that are interrupted by events such as impacts, switches and ends, from a file with its \
equations.

The file has the states, the parameters, and for each mode the rate of each state and the surfaces at which something \
happens. Numbers may be formulas. Units are the reader's own.";

const EXAMPLE: &str = "\
A ball, in a file ball.toml:

  states = [\"h\", \"v\"]
  parameters = { g = 9.81, restitution = 0.8 }

  [[mode]]
  name = \"flight\"
  rates = { h = \"v\", v = \"-g\" }

  [[mode.surface]]
  name = \"floor\"
  guard = \"h\"
  direction = \"falling\"
  resets = { h = 0, v = \"-restitution*v\" }

  [start]
  state = { h = 1 }
  time = 2

  nonsmooth run ball.toml

A surface has a guard, a formula of the states and of the time t, and a direction: rising, falling or either; or first and \
period, for events at given times. Then it may have `resets`, `to` (the mode behind it), `only_where` (a formula that is \
positive there), `stops = true`, and `beyond` (\"contact\" or \"crossing\": what lies on the other side).

Exit status:
  0    done
  1    failed, or not proved: the message says why
  2    misuse: an argument or the file is wrong, and the message says how to mend it
  130  interrupted (143: terminated)
";

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Follow a run: its events, each with its error and its certainty, and states at equal times
    Run(run::Options),
    /// Follow the returns to a surface: the states behind each event there
    Section(section::Options),
    /// Follow the periodic orbits of a return map along a parameter, with their bifurcations
    Branch(branch::Options),
    /// Follow the returns of some starts along a parameter, after a transient: a bifurcation diagram
    Diagram(diagram::Options),
    /// Find the attractors of a window of states, and the basin of each of its points
    Basin(basin::Options),
    /// Prove that a return map has a periodic orbit near a point, with its multipliers and a part of its basin
    Prove(prove::Options),
    /// Prove which starts of a window converge to which orbit of a return map, cell by cell
    ProveBasin(prove_basin::Options),
    /// Print the completions of a shell
    Completions(crate::commands::texts::Completions),
    /// Print the manual page of the program, or of a command
    Manual(crate::commands::texts::Manual),
}

/// The whole command line.
pub(crate) fn command_line() -> clap::Command {
    crate::commands::texts::with_names(<Cli as clap::CommandFactory>::command())
}

impl Call for Command {
    fn output(&self) -> Option<&OutputOptions> {
        match self {
            Command::Run(options) => Some(&options.output),
            Command::Section(options) => Some(&options.output),
            Command::Branch(options) => Some(&options.output),
            Command::Diagram(options) => Some(&options.output),
            Command::Basin(options) => Some(&options.output),
            Command::Prove(options) => Some(&options.output),
            Command::ProveBasin(options) => Some(&options.output),
            Command::Completions(_) | Command::Manual(_) => None,
        }
    }

    fn start(self: Box<Self>, streams: Streams<'_>) -> Result<(), Error> {
        match *self {
            Command::Run(options) => run::run(&options, streams),
            Command::Section(options) => section::run(&options, streams),
            Command::Branch(options) => branch::run(&options, streams),
            Command::Diagram(options) => diagram::run(&options, streams),
            Command::Basin(options) => basin::run(&options, streams),
            Command::Prove(options) => prove::run(&options, streams),
            Command::ProveBasin(options) => prove_basin::run(&options, streams),
            Command::Completions(options) => {
                crate::commands::texts::completions(&options, command_line(), streams)
            }
            Command::Manual(options) => {
                crate::commands::texts::manual(&options, command_line(), streams)
            }
        }
    }
}
