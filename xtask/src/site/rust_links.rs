//! Links of pages to Rust items, such as `[guards](crate::Guard)`: in the site they lead to the documentation of the crates.

use super::read;
use crate::error::Error;
use crate::tidy::links::{prose, targets};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// What marks the target of an item until the documentation of the crates is there.
const MARK: &str = "rust:";

/// The kinds of items that have a page of their own.
const KINDS: [&str; 7] = ["struct", "enum", "trait", "fn", "type", "macro", "constant"];

/// The kinds of parts that stand on the page of their item.
const PARTS: [&str; 5] = ["method", "tymethod", "variant", "structfield", "associatedconstant"];

/// A page whose links to items are marked. A page of a crate that is documentation of a module is the module's page in the book.
pub(super) fn marked(page: &str, text: &str, pages: &BTreeSet<String>) -> String {
    let own = page.strip_prefix("crates/").and_then(|rest| rest.split('/').nth(1));
    let own = own.unwrap_or_default().replace('-', "_");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    for (number, line) in prose(text) {
        let Some(whole) = lines.get_mut(number - 1) else { continue };
        for target in targets(&line).into_iter().filter(|target| target.contains("::")) {
            let item = target.split_once('@').map_or(target, |(_, item)| item);
            let item = match item.strip_prefix("crate::") {
                Some(rest) => format!("{own}::{rest}"),
                None => item.to_owned(),
            };
            let (item, heading) =
                item.split_once('#').map_or((&*item, ""), |(item, own)| (item, own));
            let name = item.rsplit("::").next().unwrap_or_default();
            let beside = page.rsplit_once('/').map_or("", |(folder, _)| folder);
            let new = match pages.contains(&format!("{beside}/{name}.md")) {
                true if heading.is_empty() => format!("{name}.md"),
                true => format!("{name}.md#{heading}"),
                false => format!("{MARK}{item}"),
            };
            *whole = whole.replace(&format!("]({target})"), &format!("]({new})"));
        }
        *whole = with_shortcuts(whole);
    }
    lines.join("\n") + "\n"
}

/// Items that are named in brackets and backticks, without a target.
fn with_shortcuts(line: &str) -> String {
    let (mut result, mut rest) = (String::with_capacity(line.len()), line);
    while let Some(at) = rest.find("[`") {
        let Some(length) = rest[at..].find("`]") else { break };
        let (before, from) = rest.split_at(at);
        let (name, after) = from.split_at(length + "`]".len());
        result.push_str(before);
        result.push_str(name);
        let item = &name["[`".len()..name.len() - "`]".len()];
        if item.contains("::") && !after.starts_with(['(', '[', ':']) {
            result.push_str(&format!("({MARK}{item})"));
        }
        rest = after;
    }
    result + rest
}

/// Leads the marked links of a page to the documentation in `rust`, or takes them away where it is not built.
///
/// # Errors
/// [`Error`] for an item that the documentation does not have.
pub(super) fn resolved(html: &str, up: &str, rust: Option<&Path>) -> Result<String, Error> {
    let start = format!("<a href=\"{MARK}");
    let (mut result, mut rest) = (String::with_capacity(html.len()), html);
    while let Some(at) = rest.find(&start) {
        let (before, from) = rest.split_at(at);
        result.push_str(before);
        let from = &from[start.len()..];
        let parts =
            from.split_once("\">").and_then(|(item, rest)| Some((item, rest.split_once("</a>")?)));
        let Some((item, (text, after))) = parts else {
            return Err(Error::new(format!(
                "a link to {} does not end",
                from.get(..60).unwrap_or(from)
            )));
        };
        match rust {
            Some(rust) => {
                let found = address(item, rust)?;
                result.push_str(&format!("<a href=\"{up}rust/{found}\">{text}</a>"));
            }
            None => result.push_str(text),
        }
        rest = after;
    }
    Ok(result + rest)
}

/// The address of an item under the folder of the documentation.
fn address(item: &str, rust: &Path) -> Result<String, Error> {
    let parts: Vec<&str> = item.split("::").collect();
    let not_found = || Error::new(format!("the documentation of the crates has no {item}"));
    let is_file = |path: &str| rust.join(path).is_file();
    let page_of = |folder: &str, name: &str| {
        let pages = KINDS.iter().map(|kind| format!("{folder}/{kind}.{name}.html"));
        let module = format!("{folder}/{name}/index.html");
        pages.chain([module]).find(|path| is_file(path))
    };
    let [modules @ .., name] = &parts[..] else { return Err(not_found()) };
    if modules.is_empty() {
        let index = format!("{name}/index.html");
        return is_file(&index).then_some(index).ok_or_else(not_found);
    }
    if let Some(page) = page_of(&modules.join("/"), name) {
        return Ok(page);
    }
    // A method, a variant or a field of the item before.
    let [modules @ .., item_name] = modules else { return Err(not_found()) };
    let page = page_of(&modules.join("/"), item_name).ok_or_else(not_found)?;
    let text = read(&PathBuf::from(rust).join(&page))?;
    let part = PARTS.iter().map(|kind| format!("{kind}.{name}"));
    let part = part.into_iter().find(|part| text.contains(&format!("id=\"{part}\"")));
    part.map(|part| format!("{page}#{part}")).ok_or_else(not_found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_marked_by_their_crate() {
        let pages = BTreeSet::from(["crates/any/a-b/docs/certainty.md".to_owned()]);
        let text = "[g](crate::Guard) [f](fn@crate::many) [c](crate::certainty#a) [`x::Y`] `[z](crate::Z)`\n";
        let expected = "[g](rust:a_b::Guard) [f](rust:a_b::many) [c](certainty.md#a) [`x::Y`](rust:x::Y) `[z](crate::Z)`\n";
        assert_eq!(marked("crates/any/a-b/docs/guide.md", text, &pages), expected);
    }

    #[test]
    fn without_the_documentation_the_words_stay() {
        let html = "a <a href=\"rust:x::Y\"><code>Y</code></a> b";
        assert_eq!(resolved(html, "../", None).unwrap(), "a <code>Y</code> b");
        assert!(resolved(html, "../", Some(Path::new("/nowhere"))).is_err());
    }
}
