//! The commands: one table of names, and the programs that run them.

use crate::check_builds;
use crate::check_certificates;
use crate::check_explorer;
use crate::check_python;
use crate::error::Error;
use crate::explore;
use crate::process::become_program;
use crate::regenerate;
use crate::repository::repository;
use crate::tidy;
use std::ffi::{OsStr, OsString};
use std::io::Write;
use std::process::{Command, ExitCode};

/// A command.
struct Task {
    name: &'static str,
    /// The effect of the command, in one line.
    about: &'static str,
    /// The program that runs the command; `None` for a command of this program.
    program: Option<Program>,
}

/// The packages of the repository's own programs. Their commands have the same names here.
const PAPER: Option<Program> = Some(("hopper-paper", None));
const MEASUREMENTS: Option<Program> = Some(("hopper-measurements", None));

/// The program for users, with the name of its command.
const BASINS: Option<Program> = Some(("hopper", Some("basins")));

/// A package, and the name of the command in its program if it is another one.
type Program = (&'static str, Option<&'static str>);

/// All commands, in the order of the help.
const TASKS: [Task; 21] = [
    Task {
        name: "reproduce-paper",
        about: "Compute every figure and number of the paper, check every claim, write a report",
        program: PAPER,
    },
    Task {
        name: "verify-invariance",
        about: "Check only the invariance under M → 1/M, with its figure",
        program: PAPER,
    },
    Task {
        name: "basin-raster",
        about: "Compute the basins over any window: the command `hopper basins`",
        program: BASINS,
    },
    Task {
        name: "explore",
        about: "Build the browser explorer of the basins, and serve it on the loopback address",
        program: None,
    },
    Task {
        name: "beyond-paper",
        about: "Compute results about the basins that the paper does not have, with a report",
        program: PAPER,
    },
    Task {
        name: "prove",
        about: "Prove theorems about the basins, by interval arithmetic",
        program: PAPER,
    },
    Task {
        name: "model-figures",
        about: "Draw figures of the generic crates: how guards are met, and a valve's bifurcations",
        program: PAPER,
    },
    Task {
        name: "check-reference",
        about: "Compare the map and the fates with files of reference values",
        program: MEASUREMENTS,
    },
    Task {
        name: "check-bounds",
        about: "Compare every error bound with the actual error, on millions of hops",
        program: MEASUREMENTS,
    },
    Task {
        name: "interval-coverage",
        about: "Measure how often every interval of basin-of-attraction contains the true number",
        program: MEASUREMENTS,
    },
    Task {
        name: "work-precision",
        about: "Measure time against error of every way to compute a hop",
        program: MEASUREMENTS,
    },
    Task {
        name: "speed",
        about: "Measure how fast hops and rasters are; the output of each is checked first",
        program: MEASUREMENTS,
    },
    Task {
        name: "scale",
        about: "Measure the CPU time of rasters by size, and simulate many workers with it",
        program: MEASUREMENTS,
    },
    Task {
        name: "compare-peers",
        about: "Compare with heyoka, SciPy and numba on the same hops: needs Python and its package index",
        program: MEASUREMENTS,
    },
    Task {
        name: "compare-events",
        about: "Compare the events of known scenes with SciPy, heyoka and diffsol: needs Python and package indices",
        program: MEASUREMENTS,
    },
    Task {
        name: "regenerate",
        about: "Make the committed reference values and constants again and compare: needs Python and its package index",
        program: None,
    },
    Task {
        name: "check-builds",
        about: "Build each crate alone, the fuzz target, and all with the oldest Rust promised",
        program: None,
    },
    Task {
        name: "check-python",
        about: "Build the Python package and run its tests: needs Python and package indices",
        program: None,
    },
    Task {
        name: "check-certificates",
        about: "Prove theorems, and check their certificates by a second program: needs Python and its package index",
        program: None,
    },
    Task {
        name: "check-explorer",
        about: "Test the explorer in a headless Chromium: needs node, npm and Chromium",
        program: None,
    },
    Task { name: "tidy", about: "Check the repository's rules", program: None },
];

/// The names of all commands.
fn names() -> String {
    TASKS.map(|task| task.name).join(", ")
}

/// Runs the command that the arguments name.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let Some((first, rest)) = arguments.split_first() else {
        return Err(Error::NoCommand { known: names() });
    };
    match first.to_string_lossy().as_ref() {
        // `help speed` and `speed --help` give the same text.
        "help" => match rest.first() {
            None => print(&help()),
            Some(name) => start(&name.to_string_lossy(), &["--help".into()]),
        },
        "-h" | "--help" => print(&help()),
        "-V" | "--version" => print(&format!("cargo xtask {}\n", env!("CARGO_PKG_VERSION"))),
        name => start(name, rest),
    }
}

fn start(name: &str, arguments: &[OsString]) -> Result<ExitCode, Error> {
    let known = TASKS.iter().find(|task| task.name == name);
    let task =
        known.ok_or_else(|| Error::UnknownCommand { name: name.to_owned(), known: names() })?;
    if let Some((package, name)) = task.program {
        return run_program(package, name.unwrap_or(task.name), arguments);
    }
    match task.name {
        "regenerate" => return regenerate::run(arguments),
        "explore" => return explore::run(arguments),
        "check-explorer" => return check_explorer::run(arguments),
        _ => {}
    }
    match arguments.first().map(|argument| argument.to_string_lossy()) {
        None if task.name == "check-builds" => check_builds::run(),
        None if task.name == "check-python" => check_python::run(),
        None if task.name == "check-certificates" => check_certificates::run(),
        None => tidy::run(),
        Some(option) if option == "--help" || option == "-h" => print(&format!(
            "{}\n\nUsage: cargo xtask {}\n\nOptions:\n  -h, --help  Print help\n",
            task.about, task.name
        )),
        Some(option) => {
            Err(Error::UnknownOption { command: task.name, option: option.into_owned() })
        }
    }
}

/// Builds a program of the workspace and runs it in the user's current folder.
fn run_program(package: &str, name: &str, arguments: &[OsString]) -> Result<ExitCode, Error> {
    // Cargo sets CARGO for the programs that it runs. If this program was started by hand, the first `cargo` in the
    // path is used.
    let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(&program);
    command.args(["run", "--quiet", "--release", "--package", package, "--manifest-path"]);
    command.arg(repository().join("Cargo.toml"));
    command.args([OsStr::new("--"), OsStr::new(name)]).args(arguments);
    become_program(&mut command).map_err(|source| Error::Cargo { program, source })
}

fn help() -> String {
    let widest = TASKS.iter().map(|task| task.name.len()).max().unwrap_or(0);
    let line = |name: &str, about: &str| format!("  {name:widest$}  {about}\n");
    let mut text = "Figures, claims and rules of the hybrid-hopper workspace\n\n\
                    Usage: cargo xtask <COMMAND>\n\nCommands:\n"
        .to_owned();
    TASKS.iter().for_each(|task| text.push_str(&line(task.name, task.about)));
    text.push_str(&line("help", "Print this message or the help of the given command"));
    text + "\nOptions:\n  -h, --help     Print help\n  -V, --version  Print version\n"
}

fn print(text: &str) -> Result<ExitCode, Error> {
    let at = |source| Error::File { path: "standard output".into(), source };
    std::io::stdout().write_all(text.as_bytes()).map_err(at)?;
    Ok(ExitCode::SUCCESS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_has_one_line_for_each_command() {
        let text = help();
        for task in TASKS {
            let lines = text.lines().filter(|line| line.trim_start().starts_with(task.name));
            assert_eq!(lines.count(), 1, "{}", task.name);
        }
    }

    #[test]
    fn an_unknown_command_is_an_error_that_lists_the_known_ones() {
        let error = run(&["reproduce".into()]).unwrap_err().to_string();
        assert!(error.contains("'reproduce'") && error.contains("reproduce-paper, "), "{error}");
        assert!(run(&[]).unwrap_err().to_string().contains("tidy"));
        assert!(run(&["tidy".into(), "--fast".into()]).unwrap_err().to_string().contains("--fast"));
    }
}
