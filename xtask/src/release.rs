//! `cargo xtask release --check`: whether a release can be made, and what a person must still do by hand.
//!
//! Each line begins with `ok`, `FAILED`, `SKIPPED` or `BY HAND`. Files for the release are in `target/release-files`: the source archive, the crates, the licences of
//! all packages that are linked, the site, and the list of SHA-256 digests.

use crate::error::Error;
use crate::explorer_build::target_folder;
use crate::process::{cargo, print, say, succeeds};
use crate::repository::repository;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const HELP: &str = "\
Say whether a release can be made, and what must be done by hand

Usage: cargo xtask release --check [OPTIONS]

Options:
      --check   Check; nothing is published
      --wheels  Build and look at the wheels of the Python package, too: some minutes, needs package indices
  -h, --help    Print help
";

/// What a check has found.
enum Found {
    Good(String),
    Wrong(String),
    Skipped(String),
    ByHand(String),
}

use Found::{ByHand, Good, Skipped, Wrong};

/// Checks all parts.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let (mut checks, mut wheels) = (false, false);
    for word in arguments {
        match word.to_string_lossy().as_ref() {
            "-h" | "--help" => return print(HELP),
            "--check" => checks = true,
            "--wheels" => wheels = true,
            other => return Err(Error::unknown_option("release", other)),
        }
    }
    if !checks {
        return Err(Error::new("nothing is published from here: give --check"));
    }
    let folder = target_folder().join("release-files");
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).map_err(Error::at(&folder))?;
    let root = repository();
    let version = version(&root)?;
    let mut found = vec![versions(&root, &version)?, changelog(&root, &version)?, committed(&root)];
    found.push(licences(&root, &folder)?);
    found.push(fonts(&root));
    found.push(packages(&root, &folder)?);
    found.push(semver(&root));
    found.push(certificates(&root)?);
    found.push(part("the site", &["site", "--export"], Some(&folder.join("site")))?);
    found.push(match wheels {
        true => part("the wheels", &["python-release"], None)?,
        false => {
            ByHand("the wheels: cargo xtask python-release --check (or --wheels here)".to_owned())
        }
    });
    found.push(archive(&root, &folder, &version)?);
    found.push(digests(&folder)?);
    for step in [
        "set the date of the version in docs/changelog.md, and the version in Cargo.toml if it changes",
        "tag the commit, and let the gate pass on it",
        "cargo publish --workspace, in the order that cargo finds",
        "upload the wheels, the archive and SHA256SUMS; write the archive's DOI into docs/CITATION.cff",
        "put target/release-files/site on a web server",
    ] {
        found.push(ByHand(step.to_owned()));
    }
    let mut failed = 0;
    for line in &found {
        let (word, text) = match line {
            Good(text) => ("ok", text),
            Wrong(text) => ("FAILED", text),
            Skipped(text) => ("SKIPPED", text),
            ByHand(text) => ("BY HAND", text),
        };
        failed += usize::from(word == "FAILED");
        say(&format!("{word:8} {text}"))?;
    }
    say(&format!("{} has the files", folder.display()))?;
    Ok(if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(Error::at(path))
}

/// The version of the workspace.
fn version(root: &Path) -> Result<String, Error> {
    let text = read(&root.join("Cargo.toml"))?;
    let line = text.lines().find_map(|line| line.strip_prefix("version = \""));
    let version = line.and_then(|rest| rest.split('"').next());
    version.map(str::to_owned).ok_or_else(|| Error::new("Cargo.toml has no version"))
}

/// The same version everywhere.
fn versions(root: &Path, version: &str) -> Result<Found, Error> {
    let mut other = Vec::new();
    for (file, line) in [
        ("docs/CITATION.cff", format!("version: {version}")),
        ("crates/both/python-package/Cargo.toml", format!("version = \"{version}\"")),
        ("crates/hopper/hopper-explorer/Cargo.toml", format!("version = \"{version}\"")),
    ] {
        if !read(&root.join(file))?.lines().any(|own| own.trim() == line) {
            other.push(file);
        }
    }
    let own = format!("version = \"{version}\"");
    let table = read(&root.join("Cargo.toml"))?;
    let named = table.lines().filter(|line| line.contains("path = \"crates/"));
    let wrong = named.filter(|line| line.contains("version = ") && !line.contains(&own)).count();
    Ok(match (other.is_empty(), wrong) {
        (true, 0) => Good(format!("version {version} everywhere")),
        _ => Wrong(format!(
            "version {version} is not that of {}, or of {wrong} crates in Cargo.toml",
            other.join(", ")
        )),
    })
}

fn changelog(root: &Path, version: &str) -> Result<Found, Error> {
    let text = read(&root.join("docs/changelog.md"))?;
    let dated = text.lines().any(|line| line.starts_with(&format!("## [{version}] - ")));
    let has_news = text.split("## [").nth(1).is_some_and(|part| part.lines().count() > 5);
    Ok(match (dated, has_news) {
        (true, _) => Good(format!("the changelog has {version} with its date")),
        (false, true) => {
            ByHand(format!("the changelog has news without a version: call them {version}"))
        }
        (false, false) => Wrong("the changelog has no news".to_owned()),
    })
}

fn committed(root: &Path) -> Found {
    let output = Command::new("git").args(["status", "--porcelain"]).current_dir(root).output();
    match output {
        Ok(output) if output.status.success() && output.stdout.is_empty() => {
            Good("all is committed".to_owned())
        }
        Ok(output) if output.status.success() => {
            let count = String::from_utf8_lossy(&output.stdout).lines().count();
            Wrong(format!("{count} files are not committed"))
        }
        _ => Skipped("whether all is committed: git does not answer here".to_owned()),
    }
}

/// The licences of all packages that are linked, as a file beside the release.
fn licences(root: &Path, folder: &Path) -> Result<Found, Error> {
    let mut tree = Command::new(cargo());
    tree.args([
        "tree",
        "--workspace",
        "--edges",
        "normal",
        "--prefix",
        "none",
        "--format",
        "{p} {l} {r}",
    ]);
    let output = tree.current_dir(root).output().map_err(Error::starting(cargo()))?;
    let text = String::from_utf8_lossy(&output.stdout);
    // Packages of the workspace have their folder behind their name; (*) says that a package stood before.
    let mut lines: Vec<&str> = text
        .lines()
        .map(|line| line.trim_end_matches(" (*)").trim())
        .filter(|line| !line.is_empty() && !line.contains(" (/"))
        .collect();
    lines.sort_unstable();
    lines.dedup();
    let file = folder.join("THIRD-PARTY.txt");
    let head = "Packages that are linked into the programs and the Python package, with their licences:\n\n";
    std::fs::write(&file, format!("{head}{}\n", lines.join("\n"))).map_err(Error::at(&file))?;
    let bare = lines.iter().filter(|line| line.split(' ').nth(2).is_none_or(str::is_empty)).count();
    Ok(match (output.status.success(), bare) {
        (true, 0) => Good(format!(
            "{} packages are linked, each with a licence: THIRD-PARTY.txt",
            lines.len()
        )),
        (true, _) => Wrong(format!("{bare} linked packages have no licence")),
        (false, _) => Wrong("cargo tree does not list what is linked".to_owned()),
    })
}

/// Fonts that are embedded have their licence beside them.
fn fonts(root: &Path) -> Found {
    let folder = root.join("crates/both/journal-figures/assets");
    let names: Vec<String> = std::fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    let count = names.iter().filter(|name| name.ends_with("tf")).count();
    let licence =
        names.iter().any(|name| ["LICENSE", "OFL"].iter().any(|word| name.contains(word)));
    match (count, licence) {
        (0, _) => Wrong(format!("no fonts in {}", folder.display())),
        (_, true) => Good(format!("{count} embedded fonts, with their licence")),
        (_, false) => {
            Wrong(format!("{count} embedded fonts without a licence in {}", folder.display()))
        }
    }
}

/// The packages of the workspace that are not published.
fn unpublished(root: &Path) -> Result<Vec<String>, Error> {
    let workspace = read(&root.join("Cargo.toml"))?;
    let members = workspace.lines().map(str::trim).filter(|line| line.starts_with('"'));
    let mut found = Vec::new();
    for member in members.map(|line| line.trim_matches(['"', ','])) {
        let text = read(&root.join(member).join("Cargo.toml"))?;
        let name = text.lines().find_map(|line| line.strip_prefix("name = \""));
        if text.lines().any(|line| line == "publish = false") {
            found.extend(name.map(|name| name.trim_end_matches('"').to_owned()));
        }
    }
    Ok(found)
}

/// The crates as they would be published, without building them again.
fn packages(root: &Path, folder: &Path) -> Result<Found, Error> {
    let mut package = Command::new(cargo());
    package.args(["package", "--workspace", "--no-verify", "--allow-dirty", "--quiet"]);
    for name in unpublished(root)? {
        package.args(["--exclude", &name]);
    }
    let work = folder.join("work");
    let output = package
        .arg("--target-dir")
        .arg(&work)
        .current_dir(root)
        .output()
        .map_err(Error::starting(cargo()))?;
    let crates = std::fs::read_dir(work.join("package")).into_iter().flatten().flatten();
    let files: Vec<PathBuf> = crates
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end == "crate"))
        .collect();
    for file in &files {
        let to = folder.join(file.file_name().unwrap_or_default());
        std::fs::copy(file, &to).map_err(Error::at(&to))?;
    }
    let _ = std::fs::remove_dir_all(&work);
    let messages = String::from_utf8_lossy(&output.stderr);
    Ok(match output.status.success() {
        true => Good(format!("{} crates can be packed", files.len())),
        false => Wrong(format!("cargo package: {}", messages.lines().next().unwrap_or_default())),
    })
}

fn semver(root: &Path) -> Found {
    if !succeeds(Command::new(cargo()).args(["semver-checks", "--version"])) {
        return ByHand("changes of interfaces: cargo install cargo-semver-checks; cargo semver-checks, from the second release on".to_owned());
    }
    let checked =
        Command::new(cargo()).args(["semver-checks", "--workspace"]).current_dir(root).output();
    match checked {
        Ok(output) if output.status.success() => {
            Good("interfaces change as the version says".to_owned())
        }
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stderr).into_owned();
            let first =
                text.lines().find(|line| line.contains("error")).unwrap_or_default().to_owned();
            // Nothing to compare with before the first release.
            if text.contains("not found in registry") {
                ByHand(format!("interfaces: {first}"))
            } else {
                Wrong(first)
            }
        }
        Err(error) => Skipped(format!("interfaces: {error}")),
    }
}

/// What the gate proves with larger cells, and so with other bytes.
const SMALL: [&str; 2] = ["fig", "henon"];

/// The certificates that are here have the digests of the log of full checks.
fn certificates(root: &Path) -> Result<Found, Error> {
    let log = read(&root.join("docs/full_checks.txt"))?;
    let known: Vec<(String, String)> = log
        .lines()
        .filter_map(|line| {
            let name = line.strip_prefix("confirmed ")?.split(' ').next()?;
            let digest = line.rsplit("sha256 ").next()?.split(';').next()?;
            Some((name.to_owned(), digest.trim().to_owned()))
        })
        .collect();
    let folder = target_folder().join("certificates");
    let (mut same, mut other) = (0, Vec::new());
    for (name, digest) in &known {
        let file =
            [folder.join(format!("{name}.jsonl")), folder.join(format!("any-model/{name}.jsonl"))];
        let Some(file) = file.iter().find(|file| file.exists()) else { continue };
        match sha256(file) {
            Some(own) if own == *digest => same += 1,
            Some(_) if SMALL.iter().any(|small| name.starts_with(small)) => {}
            Some(_) => other.push(name.clone()),
            None => {
                return Ok(Skipped("digests of certificates: sha256sum is not there".to_owned()));
            }
        }
    }
    let all = known.len();
    Ok(match other.is_empty() {
        true if same > 0 => Good(format!("{same} of {all} certificates are here, with the digests of docs/full_checks.txt")),
        true => ByHand("no certificate is here: cargo xtask check-certificates, and prove --all for the long ones".to_owned()),
        false => Wrong(format!("other digests than in docs/full_checks.txt: {}", other.join(", "))),
    })
}

fn sha256(file: &Path) -> Option<String> {
    let output = Command::new("sha256sum")
        .arg(file)
        .output()
        .ok()
        .filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()?.split(' ').next().map(str::to_owned)
}

/// Another command of this program.
fn part(what: &str, words: &[&str], folder: Option<&Path>) -> Result<Found, Error> {
    let program = std::env::current_exe().map_err(Error::at("this program"))?;
    let mut command = Command::new(program);
    command.args(words).args(folder).current_dir(repository());
    let output = command.output().map_err(Error::at("this program"))?;
    let text = String::from_utf8_lossy(&output.stdout);
    let skipped = text.lines().find(|line| line.starts_with("SKIPPED"));
    Ok(match (output.status.success(), skipped) {
        (true, None) => Good(what.to_owned()),
        (true, Some(line)) => Skipped(line.trim_start_matches("SKIPPED").trim().to_owned()),
        (false, _) => {
            let messages = String::from_utf8_lossy(&output.stderr);
            Wrong(format!("{what}: {}", messages.lines().last().unwrap_or_default()))
        }
    })
}

/// The sources of the last commit, as an archive keeps them.
fn archive(root: &Path, folder: &Path, version: &str) -> Result<Found, Error> {
    let name = format!("hybrid-hopper-{version}");
    let file = folder.join(format!("{name}.tar.gz"));
    let mut git = Command::new("git");
    git.args(["archive", "--format=tar.gz", &format!("--prefix={name}/"), "--output"])
        .arg(&file)
        .arg("HEAD");
    let done = git.current_dir(root).status().is_ok_and(|status| status.success());
    let size = std::fs::metadata(&file).map_or(0, |data| data.len());
    Ok(match done {
        true => Good(format!("the archive of the sources, {:.1} MB", size as f64 / 1e6)),
        false => Skipped("the archive of the sources: git does not answer here".to_owned()),
    })
}

/// The list of digests of all files of the release.
fn digests(folder: &Path) -> Result<Found, Error> {
    let entries = std::fs::read_dir(folder).map_err(Error::at(folder))?.flatten();
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.path()).filter(|path| path.is_file()).collect();
    files.sort();
    let mut lines = String::new();
    for file in &files {
        let Some(digest) = sha256(file) else {
            return Ok(Skipped("the list of digests: sha256sum is not there".to_owned()));
        };
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        lines += &format!("{digest}  {name}\n");
    }
    let list = folder.join("SHA256SUMS");
    std::fs::write(&list, lines).map_err(Error::at(&list))?;
    Ok(Good(format!("SHA256SUMS of {} files", files.len())))
}
