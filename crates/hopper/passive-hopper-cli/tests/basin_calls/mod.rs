//! Calls of `hopper basins` as processes, and their folders.

#![allow(dead_code)]

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// No wait of a test is longer, even on a slow machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// The bytes of files by their names.
pub(crate) type Files = BTreeMap<String, Vec<u8>>;

/// An empty folder, removed when the test passes.
#[derive(Debug)]
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new(name: &str) -> Self {
        let name = format!("hopper_basins_{name}_{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        let _ = std::fs::remove_dir_all(&path);
        Folder(path)
    }

    /// The names in a folder of this folder; none if it does not exist.
    pub(crate) fn names(&self, folder: &str) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.join(folder)).into_iter().flatten().flatten();
        let mut names: Vec<_> =
            entries.map(|entry| entry.file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The files of the folder. It has no folder in it.
    pub(crate) fn files(&self) -> Files {
        let names = self.names("").into_iter();
        names.map(|name| (name.clone(), std::fs::read(self.0.join(name)).unwrap())).collect()
    }

    /// The number of finished tiles, in all folders of pieces.
    pub(crate) fn tiles(&self) -> usize {
        let all = ["tiles", "tiles_hops"].map(|folder| self.names(folder));
        all.iter().flatten().filter(|name| name.ends_with(".bin")).count()
    }

    /// Waits until a call in this folder has finished a tile.
    pub(crate) fn wait_for_a_tile(&self) {
        let begin = Instant::now();
        while self.tiles() == 0 {
            assert!(begin.elapsed() < PATIENCE, "no tile");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    /// A tile of labels.
    pub(crate) fn tile(&self, number: usize) -> PathBuf {
        self.0.join(format!("tiles/piece_{number:06}.bin"))
    }

    pub(crate) fn remove(self) {
        std::fs::remove_dir_all(&self.0).unwrap();
    }
}

/// A call with the options of `more` in the folder `out`.
pub(crate) fn basins(out: &Path, more: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hopper"));
    command.args(["basins", "--mass-ratio", "0.1", "0.3"]).args(more).arg("--out").arg(out);
    command.env("RAYON_NUM_THREADS", "2").stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// The output of a call that must end with this status.
pub(crate) fn ends(mut command: Command, status: i32) -> Output {
    let output = command.output().unwrap();
    assert_eq!(output.status.code(), Some(status), "{command:?}: {}", text(&output));
    output
}

/// What a call wrote to standard error.
pub(crate) fn text(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// The files of an undisturbed call.
pub(crate) fn undisturbed(name: &str, more: &[&str]) -> Files {
    let folder = Folder::new(name);
    ends(basins(&folder.0, more), 0);
    let files = folder.files();
    folder.remove();
    files
}

/// Sends a signal to a running call.
pub(crate) fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

/// Numbers that look random: Knuth's linear congruential generator.
#[derive(Debug)]
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// From 0 to 1. Only the high bits of the generator are random.
    pub(crate) fn share(&mut self) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / (1u64 << 24) as f64
    }

    /// One of 0 … `count` − 1.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        (self.share() * count as f64) as usize
    }
}
