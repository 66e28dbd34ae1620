//! Folders of jobs that are looked at and gone on with, and pictures without a folder.

#![cfg(unix)]

use super::basin_calls::{Folder, basins, ends, signal, undisturbed};
use super::common::call;
use std::process::Command;

/// 50 tiles a layer.
const JOB: [&str; 6] = ["--pixels", "800", "150", "--layer", "label", "hops"];

fn hopper(arguments: &[&str]) -> Command {
    let mut call = Command::new(env!("CARGO_BIN_EXE_hopper"));
    call.args(arguments);
    call
}

/// The rows of a table in CSV, without their names.
fn rows(arguments: &[&str], code: u8) -> Vec<Vec<String>> {
    let called = call(&[arguments, &["--csv"]].concat(), b"");
    assert_eq!(called.code, code, "{}", called.messages);
    let fields = |line: &str| line.split(',').map(str::to_owned).collect();
    called.output.lines().skip(1).map(fields).collect()
}

#[test]
fn a_job_goes_on_from_its_folder_alone_and_says_how_far_it_is() {
    let whole = undisturbed("alone_whole", &JOB);
    let folder = Folder::new("alone");
    let path = folder.0.display().to_string();
    let job = basins(&folder.0, &JOB).spawn().unwrap();
    folder.wait_for_a_tile();
    // While it runs, its state can be asked for.
    assert_eq!(rows(&["basins", "status", &path], 0).len(), 2);
    signal(&job, "-INT");
    job.wait_with_output().unwrap();
    let found = rows(&["basins", "status", &path], 0);
    assert_eq!(found[0][..3], ["basin.npy", "tiles", "50"]);
    let finished: usize = found[0][3].parse().unwrap();
    assert!((1..50).contains(&finished), "{found:?}");
    assert_eq!((found[0][5].as_str(), found[1][5].as_str()), ("begun", "not begun"));
    assert_eq!(rows(&["basins", "verify", &path], 0)[0][3..5], [finished.to_string(), "0".into()]);
    // A damaged tile is found by its digest alone.
    let tile = folder.0.join("tiles").join(&folder.names("tiles")[0]);
    std::fs::write(&tile, b"no tile").unwrap();
    assert_eq!(rows(&["basins", "status", &path], 0)[0][3], finished.to_string());
    let verified = call(&["basins", "verify", &path], b"");
    assert!(verified.code == 1 && verified.messages.contains("1 of the files are damaged"));
    assert!(verified.messages.contains(&tile.display().to_string()), "{}", verified.messages);
    ends(hopper(&["basins", "--out", &path, "--quiet"]), 0);
    assert!(folder.files() == whole);
    assert!(rows(&["basins", "verify", &path], 0).iter().all(|row| row[5] == "complete"));
    // A result as well.
    std::fs::write(folder.0.join("hops.npy"), b"no array").unwrap();
    assert_eq!(rows(&["basins", "status", &path], 0)[1][5], "complete");
    assert_eq!(rows(&["basins", "verify", &path], 1)[1][5], "damaged");
    ends(hopper(&["basins", "--out", &path, "--quiet"]), 0);
    assert!(folder.files() == whole);
    folder.remove();
}

/// The commands and the old options do the same, and a folder of each goes on alone.
#[test]
fn jobs_of_all_kinds_are_commands_of_their_own() {
    let kinds: [(&[&str], &[&str]); 3] = [
        (
            &[
                "coverage", "0.1", "-M", "0.17", "0.18", "--speed", "17", "17.8", "--pixels", "4",
                "8",
            ],
            &[
                "--coverage",
                "0.1",
                "-M",
                "0.17",
                "0.18",
                "--speed",
                "17",
                "17.8",
                "--pixels",
                "4",
                "8",
            ],
        ),
        (
            &["scales", "2", "--turns", "2", "-M", "0.19", "0.21", "--pixels", "4", "10"],
            &["--about", "2", "--turns", "2", "-M", "0.19", "0.21", "--pixels", "4", "10"],
        ),
        (
            &["zoom", "0.12", "11.92", "--frames", "2", "--step", "50", "--pixels", "8", "8"],
            &["--zoom", "0.12", "11.92", "--frames", "2", "--step", "50", "--pixels", "8", "8"],
        ),
    ];
    for (own, old) in kinds {
        let (first, second) = (Folder::new("own"), Folder::new("old"));
        let path = first.0.display().to_string();
        ends(hopper(&[own, &["--out", &path]].concat()), 0);
        let messages = super::basin_calls::text(&ends(
            hopper(&[&["basins"], old, &["--out", &second.0.display().to_string()]].concat()),
            0,
        ));
        assert!(messages.contains(&format!("is the command `hopper {}", own[0])), "{messages}");
        assert!(first.files() == second.files(), "{own:?}");
        let again = hopper(&["basins", "--out", &path]);
        let messages = super::basin_calls::text(&ends(again, 0));
        assert!(messages.contains("is complete already"), "{messages}");
        assert_eq!(rows(&["basins", "verify", &path], 0)[0][5], "complete");
        first.remove();
        second.remove();
    }
}

#[test]
fn without_a_folder_there_is_a_small_picture() {
    let shown = call(&["basins", "-M", "0.1", "1", "--pixels", "30", "8"], b"");
    assert_eq!(shown.code, 0, "{}", shown.messages);
    let lines: Vec<&str> = shown.output.lines().collect();
    // Four lines of two rows each, between the ends of the axes.
    assert_eq!((lines.len(), lines[0], lines[5]), (7, "α 20.3713", "α 4.49341"));
    assert!(lines[1..5].iter().all(|line| line.len() == 30), "{}", shown.output);
    assert!(lines[1..5].iter().flat_map(|line| line.chars()).all(|sign| ".#123".contains(sign)));
    // Its signs are the fates.
    let grid = |at: usize| 0.1 + 0.9 * (at as f64 + 0.5) / 30.0;
    for at in [0, 7, 29] {
        let ends = [4.493409457909064, 20.37130295928756];
        let speed = ends[0] + (ends[1] - ends[0]) * 7.5 / 8.0;
        let fate = call(&["fate", &speed.to_string(), "-M", &grid(at).to_string(), "--csv"], b"");
        let row: Vec<&str> = fate.output.lines().nth(1).unwrap().split(',').collect();
        let sign = match row[1] {
            "grounded" => '#',
            "decaying" => '.',
            _ => row[2].chars().next().unwrap(),
        };
        assert_eq!(lines[1].chars().nth(at), Some(sign), "column {at}: {row:?}");
    }
    let file = std::env::temp_dir().join(format!("hopper_picture_{}.png", std::process::id()));
    let path = file.display().to_string();
    let drawn =
        call(&["basins", "--pixels", "30", "8", "--layer", "loss", "--picture", &path], b"");
    assert_eq!((drawn.code, drawn.output.as_str()), (0, ""), "{}", drawn.messages);
    assert!(std::fs::read(&file).unwrap().starts_with(b"\x89PNG"));
    std::fs::remove_file(&file).unwrap();
    for (wrong, why) in [
        (&["basins", "--layer", "label", "hops"][..], "one layer"),
        (&["basins", "--pixels", "4096", "4096"], "--out"),
        (&["basins", "--about", "2"], "--out"),
        (&["basins", "status", "/nowhere"], "call.txt"),
    ] {
        let refused = call(wrong, b"");
        assert!(refused.code == 2 && refused.messages.contains(why), "{}", refused.messages);
    }
}
