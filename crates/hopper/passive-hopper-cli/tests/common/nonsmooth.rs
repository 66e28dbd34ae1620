//! Calls of `nonsmooth` in this process, and files for them.

use passive_hopper_cli::{Streams, run_nonsmooth};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

/// A call: its exit status, its output, and its messages.
pub(crate) fn call(arguments: &[&str]) -> (u8, String, String) {
    let (mut output, mut messages) = (Vec::new(), Vec::new());
    let streams = Streams {
        input: &mut std::io::empty(),
        input_is_terminal: false,
        output_has_colors: false,
        output: &mut output,
        messages: &mut messages,
    };
    let all = std::iter::once("nonsmooth").chain(arguments.iter().copied());
    let code = run_nonsmooth(all.map(Into::into), streams);
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (code, text(output), text(messages))
}

/// A model of the examples.
pub(crate) fn model(name: &str) -> String {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    folder.join(name).to_str().unwrap().to_owned()
}

/// A file with this text, for one test.
pub(crate) struct File(pub(crate) PathBuf);

impl File {
    pub(crate) fn new(name: &str, text: &str) -> File {
        static NEXT: AtomicUsize = AtomicUsize::new(0);
        let number = NEXT.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("{}_{number}_{name}", std::process::id()));
        std::fs::write(&path, text).unwrap();
        File(path)
    }

    pub(crate) fn path(&self) -> &str {
        self.0.to_str().unwrap()
    }
}

impl Drop for File {
    fn drop(&mut self) {
        let _ = std::fs::remove_file(&self.0);
    }
}
