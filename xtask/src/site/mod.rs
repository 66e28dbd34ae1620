//! `cargo xtask site`: one folder for any web server: a front page, the book, the explorer, and the documentation of all crates.
//!
//! ```text
//!   docs/book/SUMMARY.md ──► pages, with the files that they link to ──► mdBook ──► target/site
//!                            the explorer ──► target/site/explorer        rustdoc ──► target/site/rust
//! ```
//!
//! The pages are those of the repository: nothing is written twice. On the way to mdBook
//!
//! ```text
//!   rust_links.rs   links to Rust items lead to the documentation of the crates
//!   files.rs        links to files that are no pages lead to copies, those to folders to lists of their files
//!   statements.rs   theorems that are named are links
//!   mathematics.rs  indices and displays are set
//!   check.rs        in the end, every link leads somewhere
//! ```

mod check;
mod files;
mod mathematics;
mod rust_links;
mod statements;

use crate::error::Error;
use crate::explorer_build::{build, target_folder, target_is_here};
use crate::process::{cargo, print, say, skip, step, succeeds};
use crate::repository::repository;
use crate::tidy::links::{resolve, targets};
use check::broken_links;
use files::{copy_linked, linked};
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

const HELP: &str = "\
Build the site: a front page, the book, the explorer, and the documentation of all crates

Usage: cargo xtask site [OPTIONS]

Options:
      --export <DIR>  Write it there, and not into target/site: any web server can serve it, and it needs no network
      --without-rust  Leave the documentation of the crates out
  -h, --help          Print help

It needs mdBook: `cargo install mdbook --root target/tools`, or one that is installed.
";

/// The list of all pages.
const SUMMARY: &str = "docs/book/SUMMARY.md";

/// The page that is shown first.
const FRONT: &str = "docs/book/front.md";

/// The version of mdBook with which the site was looked at.
const LOOKED_AT: &str = "0.5";

/// Builds the site.
pub(crate) fn run(arguments: &[OsString]) -> Result<ExitCode, Error> {
    let (mut folder, mut with_rust) = (target_folder().join("site"), true);
    let mut left = arguments.iter();
    while let Some(word) = left.next() {
        match word.to_string_lossy().as_ref() {
            "-h" | "--help" => return print(HELP),
            "--without-rust" => with_rust = false,
            "--export" => match left.next() {
                Some(path) => folder = PathBuf::from(path),
                None => return Err(Error::new("--export needs a folder: --export DIR")),
            },
            other => return Err(Error::unknown_option("site", other)),
        }
    }
    let Some(program) = mdbook() else {
        let reason = format!(
            "mdBook is not there; install it by `cargo install mdbook --version ^{LOOKED_AT} --root target/tools`"
        );
        return skip("the site", &reason);
    };
    let work = target_folder().join("book");
    // Pages of an earlier run must not pass for new ones.
    let _ = std::fs::remove_dir_all(&work);
    let pages = written(&work)?;
    let mut book = Command::new(program);
    book.arg("build").arg(&work).arg("--dest-dir").arg(absolute(&folder)?);
    step(&mut book, "mdBook")?;
    if target_is_here() {
        build(&folder.join("explorer"))?;
    } else {
        say("SKIPPED the explorer in the site: the target wasm32-unknown-unknown is not there")?;
    }
    if with_rust {
        let mut doc = Command::new(cargo());
        doc.args(["doc", "--quiet", "--workspace", "--no-deps"]).current_dir(repository());
        step(&mut doc, "rustdoc")?;
        copy_folder(&target_folder().join("doc"), &folder.join("rust"))?;
    }
    lead_to_rust(&folder, with_rust)?;
    let wrong = broken_links(&folder, with_rust && target_is_here())?;
    if let Some(first) = wrong.first() {
        let count = wrong.len();
        return Err(Error::new(format!(
            "{count} links of the site lead nowhere; the first: {first}"
        )));
    }
    say(&format!(
        "{} holds the site with {pages} pages; any web server can serve it",
        folder.display()
    ))?;
    Ok(ExitCode::SUCCESS)
}

/// mdBook in target/tools, or on the path.
fn mdbook() -> Option<OsString> {
    let own = target_folder().join("tools/bin/mdbook").into_os_string();
    [own, "mdbook".into()].into_iter().find(|name| succeeds(Command::new(name).arg("--version")))
}

fn absolute(path: &Path) -> Result<PathBuf, Error> {
    std::path::absolute(path).map_err(Error::at(path))
}

fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(Error::at(path))
}

fn write(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(Error::at(folder))?;
    }
    std::fs::write(path, bytes).map_err(Error::at(path))
}

/// Writes the sources of the book: the pages of the summary, and what they link to. The number of pages.
fn written(work: &Path) -> Result<usize, Error> {
    let (root, source) = (repository(), work.join("src"));
    for name in ["book.toml", "site.css"] {
        write(&work.join(name), read(&root.join("docs/book").join(name))?.as_bytes())?;
    }
    let mut summary = read(&root.join(SUMMARY))?;
    let links: Vec<String> = summary.lines().flat_map(targets).map(str::to_owned).collect();
    let mut pages = BTreeSet::new();
    for link in links {
        let Some(page) = resolve(SUMMARY, &link) else { continue };
        let place = if page == FRONT { "front.md" } else { &page };
        summary = summary.replace(&format!("]({link})"), &format!("]({place})"));
        pages.insert(page);
    }
    write(&source.join("SUMMARY.md"), summary.as_bytes())?;
    let known = statements::anchors(&read(&root.join(statements::THEORY))?);
    let title = |page: &String| Ok((page.clone(), title_of(&read(&root.join(page))?)));
    let titles = pages.iter().map(title).collect::<Result<BTreeMap<_, _>, Error>>()?;
    for page in &pages {
        let text = read(&root.join(page))?;
        let text = rust_links::marked(page, &text, &pages);
        let (text, copies) = linked(page, &text, &titles)?;
        let text = statements::linked(page, &text, &known);
        let text = mathematics::set(page, &colored(page, &text));
        let place = if page == FRONT { "front.md" } else { page };
        write(&source.join(place), text.as_bytes())?;
        for file in copies {
            copy_linked(&root, &source, &file)?;
        }
    }
    Ok(pages.len())
}

/// The heading of a page.
fn title_of(text: &str) -> String {
    let heading = text.lines().find_map(|line| line.strip_prefix("# "));
    heading.unwrap_or_default().to_owned()
}

/// A page of a crate, whose code without a language is Rust, as for rustdoc.
fn colored(page: &str, text: &str) -> String {
    let (is_of_crate, mut fenced) = (page.starts_with("crates/"), false);
    let line = |line: &str| {
        let is_fence = line.trim_start().starts_with("```");
        let bare = is_fence && !fenced && line.trim() == "```" && is_of_crate;
        fenced ^= is_fence;
        if bare { format!("{line}rust") } else { line.to_owned() }
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n") + "\n"
}

/// Leads the links to Rust items of all pages to the documentation of the crates, if it is there.
fn lead_to_rust(folder: &Path, with_rust: bool) -> Result<(), Error> {
    let rust = folder.join("rust");
    for page in check::pages(folder)? {
        let depth = page.strip_prefix(folder).unwrap_or(&page).components().count() - 1;
        let html = read(&page)?;
        let new = rust_links::resolved(&html, &"../".repeat(depth), with_rust.then_some(&*rust));
        let new = new.map_err(|error| Error::new(format!("{}: {error}", page.display())))?;
        if new != html {
            write(&page, new.as_bytes())?;
        }
    }
    Ok(())
}

/// Copies a folder with all that is in it.
fn copy_folder(from: &Path, to: &Path) -> Result<(), Error> {
    std::fs::create_dir_all(to).map_err(Error::at(to))?;
    for entry in std::fs::read_dir(from).map_err(Error::at(from))?.flatten() {
        let (own, copy) = (entry.path(), to.join(entry.file_name()));
        if own.is_dir() {
            copy_folder(&own, &copy)?;
        } else {
            std::fs::copy(&own, &copy).map_err(Error::at(&own))?;
        }
    }
    Ok(())
}
