//! `cargo xtask check-explorer`: the explorer in a headless Chromium, as a person would use it.
//!
//! It needs the target wasm32-unknown-unknown, node 20 or newer, a package index, and Chromium. If one of them
//! cannot be had, it prints a line that begins with SKIPPED. With `--measure` it prints the figures of
//! docs/explorer.md instead.

use crate::error::Error;
use crate::explorer_build::{INSTALL, build, manifest, target_folder, target_is_here};
use crate::explorer_file::one_file;
use crate::process::{cargo, print, skip, step, succeeds};
use crate::repository::repository;
use crate::static_server::serve;
use std::ffi::OsString;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Names of Chromium, after the variable CHROMIUM.
const BROWSERS: [&str; 4] =
    ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];

/// Tests the core, builds the page, and drives the browser; or measures.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let measure = match arguments.first().map(|word| word.to_string_lossy()) {
        None => false,
        Some(word) if word == "--measure" => true,
        Some(word) if word == "--help" || word == "-h" => {
            return print(
                "Test the explorer in a headless Chromium: needs node, npm and Chromium\n\n\
                 Usage: cargo xtask check-explorer [--measure]\n\n\
                 Options:\n      --measure  Print times and sizes instead\n  -h, --help     Print help",
            );
        }
        Some(word) => {
            return Err(Error::unknown_option("check-explorer", &word));
        }
    };
    let folder = target_folder().join("explorer");
    if !measure {
        step(&mut cargo_command(&["test"]), "the tests of its core")?;
        let mut systems = cargo_command(&["test"]);
        step(systems.args(["--features", "systems", "--test", "systems"]), "the other systems")?;
    }
    if !target_is_here() {
        return skip(PAGE, &format!("the target wasm32-unknown-unknown is not there: `{INSTALL}`"));
    }
    if !succeeds(Command::new("node").args(["-e", NEW_ENOUGH])) {
        return skip(PAGE, "node 20 or newer is not there");
    }
    let Some(browser) = browser() else {
        return skip(PAGE, "Chromium is not there; name one with CHROMIUM=/path/to/chromium");
    };
    if !has_driver(&folder)? {
        return skip(PAGE, "playwright-core cannot be installed by npm");
    }
    build(&folder.join("site"))?;
    // What the page shows is compared with what the same code gives here.
    let native = folder.join("native.json");
    let mut answers = cargo_command(&["run", "--quiet", "--example", "native_answers"]);
    if measure {
        answers.arg("--release");
    }
    step(answers.arg("--").arg(&native), "the native answers")?;
    if !measure {
        // The page shows its calls; a test runs them.
        let mut program = Command::new(cargo());
        program.args(["build", "--quiet", "--package", "passive-hopper-cli", "--target-dir"]);
        step(program.arg(target_folder()).current_dir(repository()), "the program hopper")?;
        let file = folder.join("explorer.html");
        std::fs::write(&file, one_file(&folder.join("site"))?).map_err(Error::at(&file))?;
    }
    let at = Error::at("the loopback address");
    let listener = TcpListener::bind("127.0.0.1:0").map_err(&at)?;
    let port = listener.local_addr().map_err(&at)?.port();
    let site = folder.join("site");
    // Ends with this process.
    std::thread::spawn(move || serve(&listener, &site));
    let tests = repository().join("crates/hopper/hopper-explorer/tests/browser");
    let mut node = Command::new("node");
    if measure {
        node.arg(tests.join("measure.mjs"));
    } else {
        node.args(["--test", "--test-concurrency=1"]);
        node.args(
            ["page.test.mjs", "welcome.test.mjs", "numbers.test.mjs"].map(|name| tests.join(name)),
        );
    }
    node.env("EXPLORER_URL", format!("http://127.0.0.1:{port}/")).env("CHROMIUM", browser);
    node.env("EXPLORER_NATIVE", &native).env("EXPLORER_MODULES", folder.join("driver/"));
    let hopper = format!("debug/hopper{}", std::env::consts::EXE_SUFFIX);
    node.env("EXPLORER_HOPPER", target_folder().join(hopper));
    node.env("EXPLORER_FILE", folder.join("explorer.html"));
    node.env("EXPLORER_SITE", folder.join("site"));
    step(&mut node, "the page in the browser")?;
    Ok(ExitCode::SUCCESS)
}

/// What is skipped.
const PAGE: &str = "the explorer's page in a browser";

/// Ends with an error in an older node.
const NEW_ENOUGH: &str = "process.exit(Number(process.versions.node.split('.')[0]) >= 20 ? 0 : 1)";

fn cargo_command(words: &[&str]) -> Command {
    let mut command = Command::new(cargo());
    command.args(words).arg("--manifest-path").arg(manifest());
    command.arg("--target-dir").arg(target_folder());
    command
}

/// Installs the driver of the browser from the committed list, unless an earlier run has; false if it cannot be had.
fn has_driver(folder: &Path) -> Result<bool, Error> {
    let driver = folder.join("driver");
    std::fs::create_dir_all(&driver).map_err(Error::at(&driver))?;
    let lists = repository().join("crates/hopper/hopper-explorer/tests/browser");
    let (wanted, there) = (lists.join("package-lock.json"), driver.join("installed.json"));
    let text = std::fs::read(&wanted).map_err(Error::at(&wanted))?;
    if std::fs::read(&there).is_ok_and(|installed| installed == text) {
        return Ok(true);
    }
    for name in ["package.json", "package-lock.json"] {
        let from = lists.join(name);
        std::fs::copy(&from, driver.join(name)).map_err(Error::at(&from))?;
    }
    let npm = if cfg!(windows) { "npm.cmd" } else { "npm" };
    let mut install = Command::new(npm);
    install.args(["ci", "--no-audit", "--no-fund", "--silent"]).current_dir(&driver);
    if !succeeds(&mut install) {
        return Ok(false);
    }
    std::fs::write(&there, text).map_err(Error::at(&there))?;
    Ok(true)
}

/// The variable CHROMIUM, or the first of the usual names in the path.
fn browser() -> Option<PathBuf> {
    if let Some(named) = std::env::var_os("CHROMIUM") {
        return Some(named.into());
    }
    let path = std::env::var_os("PATH").unwrap_or_default();
    let folders: Vec<PathBuf> = std::env::split_paths(&path).collect();
    let places =
        BROWSERS.iter().flat_map(|name| folders.iter().map(move |folder| folder.join(name)));
    places.into_iter().find(|place| place.is_file())
}
