//! Two runs of `basin-raster` with one folder: one of them works, and the other one returns an error. The result has
//! the bytes of an undisturbed run, even if either run is stopped or killed.

#![cfg(unix)]
#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// No wait of a test is longer, even on a slow machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// An empty folder, removed when the test passes.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let name = format!("hopper_two_runs_{name}_{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        let _ = std::fs::remove_dir_all(&path);
        Folder(path)
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(&self.0).unwrap();
        let mut names: Vec<_> =
            entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// The bytes of the results; there is no other file in the folder.
    fn results(&self) -> Vec<Vec<u8>> {
        assert_eq!(self.names(), ["basin.npy", "basin.png", "legend.json"]);
        self.names().iter().map(|name| std::fs::read(self.0.join(name)).unwrap()).collect()
    }

    /// Waits until a run in this folder has finished a tile.
    fn wait_for_a_tile(&self) {
        let begin = Instant::now();
        let is_tile =
            |entry: std::fs::DirEntry| entry.path().extension().is_some_and(|e| e == "bin");
        let tiles = || std::fs::read_dir(self.0.join("tiles")).into_iter().flatten().flatten();
        while !tiles().any(is_tile) {
            assert!(begin.elapsed() < PATIENCE, "no tile");
            std::thread::sleep(Duration::from_millis(1));
        }
    }

    fn remove(self) {
        std::fs::remove_dir_all(&self.0).unwrap();
    }
}

/// A run that lasts long enough to be stopped within it: 50 tiles.
fn raster(out: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hopper-paper"));
    command.args(["basin-raster", "--mass-ratio", "0.1", "0.3", "--pixels", "800", "120", "--out"]);
    command.arg(out).env("RAYON_NUM_THREADS", "2").stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

/// The results of an undisturbed run.
fn undisturbed(name: &str) -> Vec<Vec<u8>> {
    let folder = Folder::new(name);
    assert!(raster(&folder.0).status().unwrap().success());
    let results = folder.results();
    folder.remove();
    results
}

fn signal(child: &Child, name: &str) {
    let status = Command::new("kill").args([name, &child.id().to_string()]).status().unwrap();
    assert!(status.success());
}

/// A run that was refused: exit 1, and the error names the folder and the process at work.
fn assert_is_refused(output: &Output, folder: &Path, holder: u32) {
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("is at work"), "{text}");
    assert!(text.contains(&folder.display().to_string()), "{text}");
    assert!(text.contains(&format!("process {holder} ")), "{text}");
}

#[test]
fn of_two_runs_at_once_one_wins_and_the_other_names_it() {
    let (whole, folder) = (undisturbed("at_once_whole"), Folder::new("at_once"));
    for _ in 0..2 {
        let runs = [(); 4].map(|()| raster(&folder.0).spawn().unwrap());
        let ids = runs.each_ref().map(Child::id);
        let outputs = runs.map(|run| run.wait_with_output().unwrap());
        // A run that starts after the end of another run is not a second run at the same time: it computes the result
        // again.
        let winners: Vec<u32> = ids
            .iter()
            .zip(&outputs)
            .filter(|(_, output)| output.status.success())
            .map(|(id, _)| *id)
            .collect();
        assert!(!winners.is_empty());
        for output in outputs.iter().filter(|output| !output.status.success()) {
            let text = String::from_utf8_lossy(&output.stderr);
            let named = winners.iter().find(|id| text.contains(&format!("process {id} ")));
            assert_is_refused(output, &folder.0, *named.unwrap_or(&0));
        }
        assert!(folder.results() == whole);
    }
    folder.remove();
}

#[test]
fn a_stopped_run_keeps_its_folder_and_ends_well() {
    let (whole, folder) = (undisturbed("stopped_whole"), Folder::new("stopped"));
    let first = raster(&folder.0).spawn().unwrap();
    folder.wait_for_a_tile();
    signal(&first, "-STOP");
    let before = folder.names();
    assert_is_refused(&raster(&folder.0).output().unwrap(), &folder.0, first.id());
    // The refused run left no file and removed none.
    assert_eq!(folder.names(), before);
    // A second run that is killed at any time also does no harm.
    for milliseconds in [0, 1, 2, 5, 10, 20] {
        let mut second = raster(&folder.0).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        second.kill().unwrap();
        second.wait().unwrap();
    }
    signal(&first, "-CONT");
    let output = first.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(folder.results() == whole);
    folder.remove();
}

/// The folder of a stopped run is removed, and a second run begins there anew with another window.
#[test]
fn a_run_whose_folder_was_removed_leaves_the_next_run_alone() {
    let folder = Folder::new("removed");
    let other = |out: &Path| {
        let mut command = raster(out);
        command.args(["--speed", "4.5", "20"]);
        command
    };
    assert!(other(&folder.0).status().unwrap().success());
    let whole = folder.results();
    std::fs::remove_dir_all(&folder.0).unwrap();
    let first = raster(&folder.0).spawn().unwrap();
    folder.wait_for_a_tile();
    signal(&first, "-STOP");
    std::thread::sleep(Duration::from_millis(50)); // its threads stop one after another
    std::fs::remove_dir_all(&folder.0).unwrap();
    let second = other(&folder.0).spawn().unwrap();
    folder.wait_for_a_tile();
    signal(&second, "-STOP");
    signal(&first, "-CONT");
    let output = first.wait_with_output().unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains(&folder.0.display().to_string()), "{text}");
    signal(&second, "-CONT");
    let output = second.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(folder.results() == whole);
    folder.remove();
}

#[test]
fn a_name_that_no_result_can_have_is_an_error_before_the_computation() {
    for name in ["basin.npy", "basin.png", "legend.json", "basin-raster.lock"] {
        let folder = Folder::new("names");
        std::fs::create_dir_all(folder.0.join(name)).unwrap();
        let output = raster(&folder.0).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(text.contains(name) && text.contains("remove it"), "{text}");
        assert_eq!(folder.names(), [name]);
        folder.remove();
    }
}

#[test]
fn after_a_kill_the_next_run_goes_on_and_cleans_up() {
    let (whole, folder) = (undisturbed("killed_whole"), Folder::new("killed"));
    let mut first = raster(&folder.0).spawn().unwrap();
    folder.wait_for_a_tile();
    first.kill().unwrap();
    first.wait().unwrap();
    // The lock file of the killed run is still there, and locks nothing.
    assert!(folder.names().contains(&"basin-raster.lock".to_owned()), "{:?}", folder.names());
    for name in ["basin.npy.1-0.partial.tmp", "legend.json.4194304-12.partial.tmp"] {
        std::fs::write(folder.0.join(name), b"half").unwrap();
    }
    std::fs::write(folder.0.join("tiles/piece_000049.bin.1-0.partial.tmp"), b"half").unwrap();
    assert!(raster(&folder.0).status().unwrap().success());
    assert!(folder.results() == whole);
    folder.remove();
}

/// Pairs of runs, each killed after a pseudo-random time or not at all.
#[test]
fn pairs_that_are_killed_at_random_never_leave_a_wrong_result() {
    let begin = Instant::now();
    let (whole, folder) = (undisturbed("random_whole"), Folder::new("random"));
    let longest = begin.elapsed();
    let mut state = 7u64;
    let mut share = || {
        // Knuth's linear congruential generator; only its high bits are random.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1u64 << 24) as f64
    };
    let mut finished = 0;
    for _ in 0..8 {
        let mut pair = [(); 2].map(|()| raster(&folder.0).spawn().unwrap());
        for run in &mut pair {
            std::thread::sleep(longest.mul_f64(0.4 * share()));
            if share() < 0.7 {
                run.kill().unwrap();
            }
        }
        for run in pair {
            let output = run.wait_with_output().unwrap();
            let text = String::from_utf8_lossy(&output.stderr);
            match output.status.code() {
                Some(0) => finished += 1,
                Some(1) => assert!(text.contains("is at work"), "{text}"),
                other => assert_eq!(other, None, "{text}"), // killed
            }
        }
        // An array under its name is complete, however the runs ended.
        if let Ok(array) = std::fs::read(folder.0.join("basin.npy")) {
            assert!(array == whole[0]);
        }
    }
    assert!(raster(&folder.0).status().unwrap().success());
    assert!(folder.results() == whole, "after {finished} finished runs");
    folder.remove();
}

#[test]
fn two_reports_in_one_folder_do_not_disturb_each_other() {
    let folder = Folder::new("reports");
    let report = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hopper-paper"));
        command.args(["reproduce-paper", "--only", "fig1", "--out"]).arg(&folder.0);
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    for run in [(); 6].map(|()| report()) {
        let output = run.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    assert!(folder.names().iter().all(|name| !name.ends_with(".tmp")), "{:?}", folder.names());
    folder.remove();
}
