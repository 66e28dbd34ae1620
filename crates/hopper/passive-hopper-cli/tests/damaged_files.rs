//! Files of a job with random bytes: no call panics, and no result has wrong bytes.
//!
//! `HOPPER_ROUNDS=1000 cargo test -p passive-hopper-cli damaged_files` damages more files than the test.

#![cfg(unix)]

use super::basin_calls::{Files, Folder, Random, basins, ends, text, undisturbed};
use std::path::PathBuf;

/// Rounds unless `HOPPER_ROUNDS` says another number.
const ROUNDS: usize = if cfg!(debug_assertions) { 10 } else { 25 };

/// 5 tiles.
const JOB: [&str; 3] = ["--pixels", "80", "20"];

/// All files below a folder.
fn files_below(folder: &std::path::Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { found.extend(files_below(&path)) } else { found.push(path) }
    }
    found.sort();
    found
}

/// Changes a byte, cuts, empties, lengthens, or replaces a file by another one.
fn damage(path: &PathBuf, other: &PathBuf, random: &mut Random) {
    let mut bytes = std::fs::read(path).unwrap();
    let at = random.below(bytes.len().max(1));
    match random.below(6) {
        0 if !bytes.is_empty() => bytes[at] ^= 1 << random.below(8),
        1 => bytes.truncate(at),
        2 => bytes.clear(),
        3 => bytes.extend((0..at).map(|k| (31 * k) as u8)),
        4 => bytes = std::fs::read(other).unwrap(),
        _ => return std::fs::remove_file(path).unwrap(),
    }
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn damaged_files_never_give_wrong_results_or_a_panic() {
    let rounds = std::env::var("HOPPER_ROUNDS").ok().and_then(|text| text.parse().ok());
    let (whole, mut random): (Files, _) = (undisturbed("fuzz_whole", &JOB), Random(11));
    for round in 0..rounds.unwrap_or(ROUNDS) {
        let folder = Folder::new("fuzz");
        // Tiles alone, or results alone.
        let first: &[&str] = if round % 2 == 0 { &["--part", "1/1"] } else { &[] };
        ends(basins(&folder.0, &[&JOB[..], first].concat()), 0);
        for name in ["basins.lock", "job.lock", "basin.npy.1-0.partial.tmp"] {
            std::fs::write(folder.0.join(name), b"4194304").unwrap();
        }
        for _ in 0..1 + random.below(3) {
            let files = files_below(&folder.0);
            let other = &files[random.below(files.len())];
            damage(&files[random.below(files.len())], other, &mut random);
        }
        let output = basins(&folder.0, &JOB).output().unwrap();
        let text = text(&output);
        assert!(!text.contains("panicked"), "{text}");
        match output.status.code() {
            Some(0) => {}
            // The description of the job was damaged.
            Some(2) => {
                assert!(text.contains("job.txt") || text.contains("another job"), "{text}");
                ends(basins(&folder.0, &[&JOB[..], &["--force"]].concat()), 0);
            }
            other => panic!("{other:?}: {text}"),
        }
        assert!(folder.files() == whole, "round {round}: {:?}: {text}", folder.names(""));
        folder.remove();
    }
}
