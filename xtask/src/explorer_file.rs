//! The explorer as one file, which a browser opens without a server.
//!
//! A browser loads no modules and no WebAssembly from `file://`. So the file holds the texts of all modules and the
//! core in base 64, and a small script makes addresses of them, each with the addresses of the modules that it
//! imports in the place of their names.

use crate::error::Error;
use std::fmt::Write;
use std::path::Path;

/// Makes a module of each text, then runs the first one. A worker of a file can be no module: it gets its two texts
/// as one script.
const LOADER: &str = r#"<script type="module">
const texts = new Map([...document.querySelectorAll("script[data-name]")].map((part) => [part.dataset.name, part.textContent]));
const plain = (name) => texts.get(name).replace(/^import .*$/gm, "").replace(/^export /gm, "");
texts.set("worker.js", plain("core.js") + plain("worker.js"));
texts.set("pool.js", texts.get("pool.js").replace('{ type: "module" }', "{}"));
const made = new Map(["core.wasm", "deep.wasm"].map((name) => [name, `data:application/wasm;base64,${texts.get("deep.wasm")}`]));
function addressOf(name) {
  if (!made.has(name)) {
    const text = texts.get(name).replace(/"(?:\.\/)?(\w+\.(?:js|wasm))"/g, (quoted, other) => (texts.has(other) || made.has(other) ? `"${addressOf(other)}"` : quoted));
    made.set(name, URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
  }
  return made.get(name);
}
import(addressOf("main.js"));
</script>
"#;

/// The text of the file, from the folder of the page.
pub(crate) fn one_file(folder: &Path) -> Result<String, Error> {
    let text = |name: &str| {
        let path = folder.join(name);
        std::fs::read_to_string(&path).map_err(Error::at(&path))
    };
    let mut parts = String::new();
    let mut add = |name: &str, text: &str| {
        let _ = writeln!(parts, "<script type=\"text/plain\" data-name=\"{name}\">{text}</script>");
    };
    // It has all that the smaller core has. The module of other systems is left out: it would be a third of the file.
    let core = folder.join("deep.wasm");
    add("deep.wasm", &base_64(&std::fs::read(&core).map_err(Error::at(&core))?));
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .map_err(Error::at(folder))?
        .map(|entry| {
            Ok(entry.map_err(Error::at(folder))?.file_name().to_string_lossy().into_owned())
        })
        .collect::<Result<_, Error>>()?;
    names.sort();
    // The service worker keeps a page that has an address. A file has none, and is always there.
    for name in names.iter().filter(|name| name.ends_with(".js") && *name != "sw.js") {
        add(name, &text(name)?);
    }
    let index = text("index.html")?;
    let mut page = String::new();
    for line in index.lines() {
        if let Some(style) = line.strip_prefix("<link rel=\"stylesheet\" href=\"") {
            let _ = writeln!(page, "<style>\n{}</style>", text(style.trim_end_matches("\">"))?);
        } else if line == "</body>" {
            let _ = writeln!(page, "{parts}{LOADER}{line}");
        } else if !line.starts_with("<link") && !line.starts_with("<script type") {
            let _ = writeln!(page, "{line}");
        }
    }
    Ok(page)
}

/// Bytes in base 64 (RFC 4648).
fn base_64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |three: &[u8]| {
        let at = |k: usize| u32::from(three.get(k).copied().unwrap_or(0));
        let bits = at(0) << 16 | at(1) << 8 | at(2);
        let digit = |k: usize| {
            let place = (bits >> (18 - 6 * k) & 63) as usize;
            if k > three.len() { '=' } else { char::from(DIGITS[place]) }
        };
        [0, 1, 2, 3].map(digit)
    };
    bytes.chunks(3).flat_map(group).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base_64_has_the_values_of_its_standard() {
        let pairs =
            [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")];
        for (plain, coded) in pairs {
            assert_eq!(base_64(plain.as_bytes()), coded);
        }
        assert_eq!(base_64(&[0xfb, 0xff, 0xfe]), "+//+");
    }
}
