//! A run that is killed at any instant and started again leaves the bytes of an undisturbed run.

#![allow(missing_docs, clippy::unwrap_used, clippy::panic, clippy::disallowed_methods)]

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("hopper_killed_{name}_{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    folder
}

fn raster(out: &Path, threads: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hopper-paper"));
    command.args(["basin-raster", "--mass-ratio", "0.1", "0.3", "--pixels", "320", "100", "--out"]);
    command.arg(out).env("RAYON_NUM_THREADS", threads).stdout(Stdio::null()).stderr(Stdio::piped());
    command
}

fn results(folder: &Path) -> (Vec<u8>, Vec<u8>) {
    let read = |name| std::fs::read(folder.join(name)).unwrap();
    (read("basin.npy"), [read("basin.png"), read("legend.json")].concat())
}

/// The number of finished tiles in a folder.
fn tiles(folder: &Path) -> usize {
    let entries = std::fs::read_dir(folder.join("tiles")).into_iter().flatten().flatten();
    entries.filter(|entry| entry.path().extension().is_some_and(|e| e == "bin")).count()
}

#[test]
fn a_killed_and_restarted_run_gives_the_same_bytes() {
    let (whole, broken) = (folder("whole"), folder("broken"));
    let begin = Instant::now();
    assert!(raster(&whole, "1").status().unwrap().success());
    let longest = begin.elapsed();
    // Each run is killed after a pseudo-random part of that time, until one run ends before it is killed. The
    // multiplier and the increment are those of Knuth's linear congruential generator.
    let (mut state, mut kept, mut removing) = (1u64, Vec::new(), 0);
    for round in 0..100 {
        let threads = if round % 2 == 0 { "1" } else { "3" };
        let mut child = raster(&broken, threads).spawn().unwrap();
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let share = (state >> 40) as f64 / (1u64 << 24) as f64;
        // The first six runs are killed early, so that several runs are needed.
        std::thread::sleep(longest.mul_f64(if round < 6 {
            0.05 + 0.25 * share
        } else {
            1.1 * share
        }));
        if let Some(status) = child.try_wait().unwrap() {
            assert!(status.success());
            break;
        }
        child.kill().unwrap();
        child.wait().unwrap();
        // The legend is the last result. A run that is killed after it is removing its tiles.
        if broken.join("legend.json").exists() {
            removing += 1;
        } else {
            kept.push(tiles(&broken));
        }
    }
    // If no run reached its end, one more run is not disturbed.
    if broken.join("tiles").exists() {
        assert!(raster(&broken, "2").status().unwrap().success());
    }
    // At least two killed runs left finished tiles, and no later run lost a tile.
    let partly = kept.iter().filter(|&&tiles| tiles > 0).count();
    assert!(partly > 1, "tiles after each kill: {kept:?}, {removing} while removing");
    assert!(kept.windows(2).all(|pair| pair[0] <= pair[1]), "{kept:?}");
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
