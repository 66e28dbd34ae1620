//! `cargo xtask explore`: builds the explorer, and serves it on the loopback address or writes it into a folder.

use crate::error::Error;
use crate::explorer_build::{build, target_folder};
use crate::explorer_file::one_file;
use crate::process::{print, say};
use crate::static_server::serve;
use std::ffi::OsString;
use std::net::TcpListener;
use std::path::PathBuf;
use std::process::ExitCode;

/// The first port that is tried, and how many after it.
const PORT: u16 = 8642;
const PORTS: u16 = 20;

const HELP: &str = "\
Build the browser explorer of the basins, and serve it on the loopback address

Usage: cargo xtask explore [OPTIONS]

Options:
      --export <DIR>  Write the static folder instead: any web server can serve it.
                      Its explorer.html holds all in one file, which a browser opens without a server
  -h, --help          Print help

Where the target wasm32-unknown-unknown is missing, rustup installs it.
";

/// Builds, then serves until Ctrl-C or writes the folder.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let words: Vec<String> =
        arguments.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let export = match words.iter().map(String::as_str).collect::<Vec<_>>().as_slice() {
        [] => None,
        ["-h" | "--help"] => return print(HELP),
        // The argument itself, which need not be a text.
        ["--export", _] => arguments.get(1).map(PathBuf::from),
        ["--export"] => {
            return Err(Error::new("--export needs a folder: --export DIR"));
        }
        [option, ..] => {
            return Err(Error::unknown_option("explore", option));
        }
    };
    let folder = export.clone().unwrap_or_else(|| target_folder().join("explorer/site"));
    build(&folder)?;
    if export.is_some() {
        let file = folder.join("explorer.html");
        let at = Error::at(&file);
        std::fs::write(&file, one_file(&folder)?).map_err(at)?;
        say(&format!("{} holds the explorer; any web server can serve it", folder.display()))?;
        say(&format!(
            "{} is all of it in one file, for a browser without a server",
            file.display()
        ))?;
        return Ok(ExitCode::SUCCESS);
    }
    let listener =
        (PORT..PORT + PORTS).find_map(|port| TcpListener::bind(("127.0.0.1", port)).ok());
    let Some(listener) = listener else {
        let last = PORT + PORTS - 1;
        let reason = format!(
            "all ports from {PORT} to {last} are taken; end another server, or use --export"
        );
        return Err(Error::new(reason));
    };
    let at = Error::at("the loopback address");
    let port = listener.local_addr().map_err(at)?.port();
    say(&format!("http://127.0.0.1:{port}/    Ctrl-C ends it"))?;
    serve(&listener, &folder);
    Ok(ExitCode::SUCCESS)
}
