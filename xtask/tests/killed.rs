//! A run that is killed at any instant and started again leaves the bytes of one that never was.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Duration;

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("hopper_killed_{name}_{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn raster(out: &Path, threads: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_xtask"));
    command.args(["basin-raster", "--mass-ratio", "0.1", "0.3", "--pixels", "320", "100", "--out"]);
    command.arg(out).env("RAYON_NUM_THREADS", threads).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn results(folder: &Path) -> (Vec<u8>, Vec<u8>) {
    let read = |name| std::fs::read(folder.join(name)).unwrap();
    (read("basin.npy"), read("basin.png"))
}

#[test]
fn killed_and_started_again() {
    let (whole, broken) = (folder("whole"), folder("broken"));
    assert!(raster(&whole, "1").status().unwrap().success());
    // After a pseudo-random number of milliseconds, until one run gets through.
    let (mut state, mut kills) = (1u64, 0);
    for round in 0..200 {
        let mut child = raster(&broken, if round % 2 == 0 { "1" } else { "2" }).spawn().unwrap();
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(Duration::from_millis(15 + (state >> 33) % 80));
        match child.try_wait().unwrap() {
            Some(status) => {
                assert!(status.success());
                break;
            }
            None => {
                child.kill().unwrap();
                child.wait().unwrap();
                kills += 1;
            }
        }
    }
    if !broken.join("basin.npy").exists() {
        assert!(raster(&broken, "2").status().unwrap().success());
    }
    assert!(kills > 1, "the runs were too short to be killed: {kills}");
    assert!(results(&whole) == results(&broken));
    assert!(!broken.join("tiles").exists());
    std::fs::remove_dir_all(&whole).unwrap();
    std::fs::remove_dir_all(&broken).unwrap();
}

#[test]
fn a_folder_with_another_job_is_refused() {
    let folder = folder("foreign");
    std::fs::create_dir_all(folder.join("tiles")).unwrap();
    std::fs::write(folder.join("tiles/piece_000000.bin"), b"not a tile, but somebody's file")
        .unwrap();
    let output = raster(&folder, "1").output().unwrap();
    assert!(!output.status.success());
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(text.contains("piece_000000.bin"), "{text}");
    std::fs::remove_dir_all(&folder).unwrap();
}
