//! The links of a page to other pages and to files, and the copies of these files.

use super::{FRONT, SUMMARY, write};
use crate::error::Error;
use crate::repository::repository;
use crate::tidy::links::{prose, resolve, targets};
use std::collections::BTreeMap;
use std::path::Path;

/// A page with its links as the site has them, and the files that they lead to. A link that has the name of a page as its text
/// gets the title of that page.
pub(super) fn linked(
    page: &str,
    text: &str,
    titles: &BTreeMap<String, String>,
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
            let is_page = titles.contains_key(&file);
            if !is_page {
                if file.ends_with(".md") {
                    let text =
                        format!("{page}, line {number}: {file} is no page of {SUMMARY}; add it");
                    return Err(Error::new(text));
                }
                copies.push(file.clone());
            }
            if let (Some(title), Some(line)) = (titles.get(&file), lines.get_mut(number - 1)) {
                let name = file.rsplit('/').next().unwrap_or(&file);
                for text in [name, &format!("`{name}`"), &format!("docs/{name}")] {
                    let (old, new) =
                        (format!("[{text}]({target})"), format!("[{title}]({target})"));
                    *line = line.replace(&old, &new);
                }
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
pub(super) fn copy_linked(root: &Path, source: &Path, file: &str) -> Result<(), Error> {
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
    let up = "../".repeat(file.split('/').count());
    let page = format!(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\">\
         <title>{file}</title><style>:root{{color-scheme:light dark}}body{{font:1rem/2 sans-serif;max-width:40rem;margin:2rem \
         auto;padding:0 1rem}}</style><h1>{file}</h1><ul>{list}</ul><p><a href=\"{up}index.html\">Front page</a></p></html>"
    );
    write(&to.join("index.html"), page.as_bytes())
}
