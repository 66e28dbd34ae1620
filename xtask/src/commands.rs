//! The commands: those of this program in a table, those of the studies read from where they are defined.

use crate::error::Error;
use crate::process::{become_program, cargo, print, profile};
use crate::repository::repository;
use crate::{
    check_builds, check_certificates, check_dependencies, check_explorer, check_formal,
    check_python,
};
use crate::{explore, python_release, regenerate, release, site, tidy};
use std::ffi::{OsStr, OsString};
use std::process::{Command, ExitCode};

/// A command of this program.
struct Task {
    name: &'static str,
    /// The effect of the command, in one line.
    about: &'static str,
    run: Run,
}

/// How a command is run.
enum Run {
    /// With its arguments.
    WithArguments(fn(&[OsString]) -> Result<ExitCode, Error>),
    /// It takes none.
    Alone(fn() -> Result<ExitCode, Error>),
    /// A command of the program for users.
    OfProgram(&'static str),
}

use Run::{Alone, OfProgram, WithArguments};

/// The package of the program for users, and that of the studies.
const PROGRAM: &str = "passive-hopper-cli";
const STUDIES: &str = "hopper-studies";

const fn task(name: &'static str, run: Run, about: &'static str) -> Task {
    Task { name, about, run }
}

/// The commands of this program, in the order of the help.
const TASKS: [Task; 13] = [
    task(
        "basin-raster",
        OfProgram("basins"),
        "Compute the basins over any window: the command `hopper basins`",
    ),
    task(
        "explore",
        WithArguments(explore::run),
        "Build the browser explorer of the basins, and serve it on the loopback address",
    ),
    task(
        "site",
        WithArguments(site::run),
        "Build the site: a front page, the book, the explorer, and the documentation of all crates: needs mdBook",
    ),
    task(
        "regenerate",
        WithArguments(regenerate::run),
        "Make the committed reference values and constants again and compare: needs Python and its package index",
    ),
    task(
        "check-builds",
        Alone(check_builds::run),
        "Build each crate alone, the fuzz target, and all with the oldest Rust promised",
    ),
    task(
        "check-dependencies",
        Alone(check_dependencies::run),
        "Check sources, versions and licences of packages from outside by cargo-deny",
    ),
    task(
        "check-python",
        Alone(check_python::run),
        "Build the Python package and run its tests: needs Python and package indices",
    ),
    task(
        "python-release",
        WithArguments(python_release::run),
        "Build the wheels and the source archive of the Python package, and look at them; with --check, test each installed: needs package indices",
    ),
    task(
        "release",
        WithArguments(release::run),
        "Say whether a release can be made, and what must be done by hand; with --check",
    ),
    task(
        "check-certificates",
        Alone(check_certificates::run),
        "Prove theorems, and check their certificates by a second program: needs Python and its package index",
    ),
    task(
        "check-formal",
        Alone(check_formal::run),
        "Build the formal proofs, and look at their axioms: needs Coq with Interval and Coquelicot",
    ),
    task(
        "check-explorer",
        WithArguments(check_explorer::run),
        "Test the explorer in a headless Chromium: needs node, npm and Chromium",
    ),
    task("tidy", Alone(tidy::run), "Check the repository's rules"),
];

/// The file in which the commands of the studies are defined: between `commands! {` and `}`, a line of documentation
/// before each `Variant: module,`.
const STUDY_COMMANDS: &str = include_str!("../../crates/hopper/hopper-studies/src/cli.rs");

/// Names and effects of the commands of the studies.
fn studies() -> impl Iterator<Item = (String, &'static str)> {
    let lines = STUDY_COMMANDS.lines().skip_while(|line| *line != "commands! {").skip(1);
    let mut about = "";
    lines.take_while(|line| *line != "}").map(str::trim).filter_map(move |line| {
        if let Some(text) = line.strip_prefix("/// ") {
            about = text;
            return None;
        }
        let (_, module) = line.trim_end_matches(',').split_once(": ")?;
        Some((module.replace('_', "-"), about))
    })
}

/// Names and effects of all commands.
fn all() -> impl Iterator<Item = (String, &'static str)> {
    studies().chain(TASKS.iter().map(|task| (task.name.to_owned(), task.about)))
}

/// The names of all commands.
fn names() -> String {
    all().map(|(name, _)| name).collect::<Vec<_>>().join(", ")
}

/// Runs the command that the arguments name.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let Some((first, rest)) = arguments.split_first() else {
        return Err(Error::new(format!("no command is named; there are: {}", names())));
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
    let Some(task) = TASKS.iter().find(|task| task.name == name) else {
        let known = studies().any(|(study, _)| study == name);
        return if known {
            run_program(STUDIES, name, arguments)
        } else {
            Err(Error::new(format!("there is no command '{name}'; there are: {}", names())))
        };
    };
    match (&task.run, arguments.first().map(|argument| argument.to_string_lossy())) {
        (WithArguments(run), _) => run(arguments),
        (OfProgram(name), _) => run_program(PROGRAM, name, arguments),
        (Alone(run), None) => run(),
        (Alone(_), Some(option)) if option == "--help" || option == "-h" => print(&format!(
            "{}\n\nUsage: cargo xtask {}\n\nOptions:\n  -h, --help  Print help\n",
            task.about, task.name
        )),
        (Alone(_), Some(option)) => Err(Error::unknown_option(task.name, &option)),
    }
}

/// Builds a program of the workspace and runs it in the user's current folder.
fn run_program(package: &str, name: &str, arguments: &[OsString]) -> Result<ExitCode, Error> {
    let mut command = Command::new(cargo());
    command.args(["run", "--quiet", "--package", package]).arg(profile()).arg("--manifest-path");
    command.arg(repository().join("Cargo.toml"));
    command.args([OsStr::new("--"), OsStr::new(name)]).args(arguments);
    become_program(&mut command)
}

fn help() -> String {
    let widest = all().map(|(name, _)| name.len()).max().unwrap_or(0);
    let line = |name: &str, about: &str| format!("  {name:widest$}  {about}\n");
    let mut text = "Figures, claims and rules of the hybrid-hopper workspace\n\n\
                    Usage: cargo xtask <COMMAND>\n\nCommands:\n"
        .to_owned();
    all().for_each(|(name, about)| text.push_str(&line(&name, about)));
    text.push_str(&line("help", "Print this message or the help of the given command"));
    text + "\nOptions:\n  -h, --help     Print help\n  -V, --version  Print version\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_help_has_one_line_for_each_command() {
        let text = help();
        assert_eq!(studies().count(), 13, "{text}");
        for (name, about) in all() {
            let lines = text.lines().filter(|line| line.split_whitespace().next() == Some(&name));
            assert_eq!(lines.count(), 1, "{name}");
            assert!(about.len() > 20, "{name}: {about}");
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
