//! `cargo xtask site`: one folder for any web server: a front page, the book, the explorer, and the documentation of all crates.
//!
//! ```text
//!   docs/book/SUMMARY.md ──► pages, with the files that they link to ──► mdBook ──► target/site
//!                            the explorer ──► target/site/explorer        rustdoc ──► target/site/rust
//! ```
//!
//! The pages are those of the repository: nothing is written twice. A link to a file that is no page leads to a copy of it, one to a folder to a list of
//! its files.

use crate::error::Error;
use crate::explorer_build::{build, target_folder, target_is_here};
use crate::process::{cargo, print, say, skip, step, succeeds};
use crate::repository::repository;
use crate::tidy::links::{prose, resolve, targets};
use std::collections::BTreeSet;
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
    for page in &pages {
        let text = read(&root.join(page))?;
        let (text, copies) = linked(page, &text, &pages)?;
        let place = if page == FRONT { "front.md" } else { page };
        write(&source.join(place), text.as_bytes())?;
        for file in copies {
            copy_linked(&root, &source, &file)?;
        }
    }
    Ok(pages.len())
}

/// A page with its links as the site has them, and the files that they lead to.
fn linked(
    page: &str,
    text: &str,
    pages: &BTreeSet<String>,
) -> Result<(String, Vec<String>), Error> {
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let mut copies = Vec::new();
    for (number, line) in prose(text) {
        for target in targets(&line) {
            if target.contains("://") || target.contains("::") || target.starts_with('#') {
                continue;
            }
            let (path, heading) =
                target.split_once('#').map_or((target, ""), |(path, h)| (path, h));
            let Some(file) = resolve(page, path) else { continue };
            let is_page = pages.contains(&file);
            if !is_page {
                if file.ends_with(".md") {
                    let text =
                        format!("{page}, line {number}: {file} is no page of {SUMMARY}; add it");
                    return Err(Error::new(text));
                }
                copies.push(file.clone());
            }
            let is_folder = !is_page && repository().join(&file).is_dir();
            // The front page is at the root of the site. mdBook calls a page README.md index.html.
            let is_index = is_page && file.ends_with("/README.md");
            let moved = match (page == FRONT, is_folder) {
                (true, _) if is_index => file.replace("README.md", "index.md"),
                (false, _) if is_index => path.replace("README.md", "index.md"),
                (true, _) => file.clone(),
                (false, true) => format!("{}/index.html", path.trim_end_matches('/')),
                (false, false) => continue,
            };
            let anchor = if heading.is_empty() { String::new() } else { format!("#{heading}") };
            let (old, new) = (format!("]({target})"), format!("]({moved}{anchor})"));
            if let Some(line) = lines.get_mut(number - 1) {
                *line = line.replace(&old, &new);
            }
        }
    }
    Ok((lines.join("\n") + "\n", copies))
}

/// Copies a file, or the files of a folder with a list of them.
fn copy_linked(root: &Path, source: &Path, file: &str) -> Result<(), Error> {
    let (from, to) = (root.join(file), source.join(file));
    if !from.is_dir() {
        return write(&to, &std::fs::read(&from).map_err(Error::at(&from))?);
    }
    let mut names = Vec::new();
    for entry in std::fs::read_dir(&from).map_err(Error::at(&from))?.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_file = entry.file_type().is_ok_and(|kind| kind.is_file());
        // mdBook leaves other pages out.
        if is_file && !name.ends_with(".md") && !name.starts_with('.') {
            copy_linked(root, source, &format!("{file}/{name}"))?;
            names.push(name);
        }
    }
    names.sort();
    let row = |name: &String| format!("<li><a href=\"{name}\">{name}</a></li>");
    let list: String = names.iter().map(row).collect();
    let page = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>{file}</title><h1>{file}</h1><ul>{list}</ul></html>"
    );
    write(&to.join("index.html"), page.as_bytes())
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

/// Links of the book's pages to files that are not there, with their pages. The documentation of the crates has its own check by rustdoc.
fn broken_links(folder: &Path, whole: bool) -> Result<Vec<String>, Error> {
    let (mut wrong, mut left) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(own) = left.pop() {
        for entry in std::fs::read_dir(&own).map_err(Error::at(&own))?.flatten() {
            let path = entry.path();
            let name = path.strip_prefix(folder).unwrap_or(&path).to_string_lossy().into_owned();
            if path.is_dir() && !["rust", "explorer"].contains(&name.as_str()) {
                left.push(path);
            } else if name.ends_with(".html") {
                let text = read(&path)?;
                let found = references(&text)
                    .filter(|target| !leads_somewhere(&path, folder, target, whole));
                wrong.extend(found.map(|target| format!("{name}: {target}")));
            }
        }
    }
    wrong.sort();
    Ok(wrong)
}

/// What the attributes `href` and `src` of a page name.
fn references(text: &str) -> impl Iterator<Item = &str> {
    ["href=\"", "src=\""].into_iter().flat_map(move |mark| {
        text.match_indices(mark)
            .filter_map(move |(at, mark)| text[at + mark.len()..].split('"').next())
    })
}

/// Whether a target is outside of the site, or a file of it.
fn leads_somewhere(page: &Path, folder: &Path, target: &str, whole: bool) -> bool {
    let path = target.split(['#', '?']).next().unwrap_or_default();
    if path.is_empty() || path.contains(':') || path.starts_with('/') {
        return true;
    }
    let file = page.parent().unwrap_or(folder).join(path.replace("%20", " "));
    let is_left_out = path.contains("rust/") || path.contains("explorer/");
    file.exists() || (!whole && is_left_out)
}
