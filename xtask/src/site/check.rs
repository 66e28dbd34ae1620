//! The links of the finished pages.

use super::read;
use crate::error::Error;
use std::path::{Path, PathBuf};

/// The pages of the book: those of the documentation of the crates, and of the explorer, have their own checks.
pub(super) fn pages(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let (mut found, mut left) = (Vec::new(), vec![folder.to_owned()]);
    while let Some(own) = left.pop() {
        for entry in std::fs::read_dir(&own).map_err(Error::at(&own))?.flatten() {
            let path = entry.path();
            let is_other = ["rust", "explorer"].iter().any(|name| path == folder.join(name));
            if path.is_dir() && !is_other {
                left.push(path);
            } else if path.extension().is_some_and(|ending| ending == "html") {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

/// Links of the book's pages to files that are not there, with their pages.
pub(super) fn broken_links(folder: &Path, whole: bool) -> Result<Vec<String>, Error> {
    let mut wrong = Vec::new();
    for path in pages(folder)? {
        let name = path.strip_prefix(folder).unwrap_or(&path).display().to_string();
        let text = read(&path)?;
        let found = references(&text).filter(|target| {
            !leads_somewhere(&path, folder, target, whole) || !has_anchor(&path, &text, target)
        });
        wrong.extend(found.map(|target| format!("{name}: {target}")));
    }
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
    let outside =
        ["https:", "http:", "mailto:", "data:"].iter().any(|scheme| path.starts_with(scheme));
    // mdBook's own page for what is not found has addresses from the root.
    if path.is_empty() || outside || path.starts_with('/') {
        return true;
    }
    let file = page.parent().unwrap_or(folder).join(path.replace("%20", " "));
    let is_left_out = path.contains("rust/") || path.contains("explorer/");
    file.exists() || (!whole && is_left_out)
}

/// Whether the page of a target has its anchor; pages outside of the book have their own checks.
fn has_anchor(page: &Path, text: &str, target: &str) -> bool {
    let Some((path, anchor)) = target.split_once('#') else { return true };
    let is_here = |text: &str| anchor.is_empty() || text.contains(&format!("id=\"{anchor}\""));
    if path.is_empty() {
        return is_here(text);
    }
    let other = page.parent().unwrap_or(page).join(path);
    let is_outside = path.contains(':') || path.contains("explorer/") || path.starts_with('/');
    is_outside || read(&other).is_ok_and(|text| is_here(&text))
}
