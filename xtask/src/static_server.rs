//! A server of one folder on the loopback address. It answers GET and HEAD, and nothing outside the folder.

use std::io::{BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The most bytes of a request that are read: a browser's are some hundred.
const LONGEST_REQUEST: u64 = 16_384;

/// A browser that opens a connection and sends nothing is not waited for any longer.
const PATIENCE: Duration = Duration::from_secs(10);

/// Answers requests until the process ends.
pub(crate) fn serve(listener: &TcpListener, folder: &Path) {
    for stream in listener.incoming().flatten() {
        let folder = folder.to_path_buf();
        // A connection that breaks off concerns its browser alone.
        std::thread::spawn(move || answer(stream, &folder).is_ok());
    }
}

fn answer(mut stream: TcpStream, folder: &Path) -> std::io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    let mut lines = BufReader::new(stream.try_clone()?.take(LONGEST_REQUEST)).lines();
    let request = lines.next().transpose()?.unwrap_or_default();
    // The headers do not matter, but they are read: a connection closed before would be reset.
    for line in lines.by_ref() {
        if line?.is_empty() {
            break;
        }
    }
    let mut words = request.split(' ');
    let (method, target) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let file = place(folder, target).filter(|_| method == "GET" || method == "HEAD");
    let read = |file: PathBuf| std::fs::read(&file).ok().map(|body| (file, body));
    let Some((file, body)) = file.and_then(read) else {
        let head = "HTTP/1.1 404 Not Found\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";
        return stream.write_all(head.as_bytes());
    };
    let head = format!(
        "HTTP/1.1 200 OK\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-cache\r\nConnection: \
         close\r\n\r\n",
        content_type(&file),
        body.len()
    );
    stream.write_all(head.as_bytes())?;
    if method == "GET" { stream.write_all(&body) } else { Ok(()) }
}

/// The file of a request; `None` for names that leave the folder.
fn place(folder: &Path, target: &str) -> Option<PathBuf> {
    let path = target.split(['?', '#']).next()?.strip_prefix('/')?;
    let name = if path.is_empty() { "index.html" } else { path };
    let plain = |part: &str| {
        let letters = part.chars().all(|c| c.is_ascii_alphanumeric() || "._-".contains(c));
        letters && !part.starts_with('.') && !part.is_empty()
    };
    name.split('/').all(plain).then(|| folder.join(name))
}

fn content_type(file: &Path) -> &'static str {
    match file.extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("svg") => "image/svg+xml",
        Some("wasm") => "application/wasm",
        _ => "application/octet-stream",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_stays_in_the_folder() {
        let folder = Path::new("page");
        assert_eq!(place(folder, "/"), Some(folder.join("index.html")));
        assert_eq!(place(folder, "/core.wasm?x=1"), Some(folder.join("core.wasm")));
        for outside in [
            "/../Cargo.toml",
            "//etc/passwd",
            "/a/../../b",
            "/.git/config",
            "core.wasm",
            "/%2e%2e/x",
        ] {
            assert_eq!(place(folder, outside), None, "{outside}");
        }
    }

    #[test]
    fn a_browser_gets_the_page_and_a_missing_file_is_404() {
        let folder = std::env::temp_dir().join(format!("static_server_{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("index.html"), "hello").unwrap();
        let listener = TcpListener::bind("127.0.0.1:0").unwrap();
        let address = listener.local_addr().unwrap();
        let served = folder.clone();
        std::thread::spawn(move || serve(&listener, &served));
        let ask = |request: &str| {
            let mut stream = TcpStream::connect(address).unwrap();
            stream.write_all(request.as_bytes()).unwrap();
            let mut text = String::new();
            stream.read_to_string(&mut text).unwrap();
            text
        };
        let page = ask("GET / HTTP/1.1\r\nHost: x\r\n\r\n");
        assert!(page.starts_with("HTTP/1.1 200") && page.ends_with("\r\n\r\nhello"), "{page}");
        assert!(ask("GET /none.js HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 404"));
        assert!(ask("POST / HTTP/1.1\r\n\r\n").starts_with("HTTP/1.1 404"));
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
