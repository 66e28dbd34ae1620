//! Long jobs of `hopper basins`: signals, damaged tiles, parts, other jobs in a folder, closed and full outputs,
//! wrong calls.

#![cfg(unix)]

use super::basin_calls::{Folder, basins, ends, signal, text, undisturbed};
use std::process::{Command, Stdio};

/// 20 tiles of labels.
const JOB: [&str; 3] = ["--pixels", "320", "40"];

/// 50 tiles, so that a call can be stopped within it.
const LONG: [&str; 3] = ["--pixels", "800", "150"];

fn with<'a>(job: &[&'a str], more: &[&'a str]) -> Vec<&'a str> {
    [job, more].concat()
}

#[test]
fn a_signal_ends_a_call_with_its_status_and_the_same_call_goes_on() {
    let whole = undisturbed("signal_whole", &LONG);
    for (name, status) in [("-INT", 130), ("-TERM", 143)] {
        let folder = Folder::new("signal");
        let call = basins(&folder.0, &LONG).spawn().unwrap();
        folder.wait_for_a_tile();
        signal(&call, name);
        let output = call.wait_with_output().unwrap();
        let text = text(&output);
        assert_eq!(output.status.code(), Some(status), "{text}");
        assert!(text.contains("interrupted: "), "{text}");
        assert!(
            text.contains("of 50 tiles are finished; the same call, given again, goes on"),
            "{text}"
        );
        // No lock and no half-written file is left, and no result is there.
        assert_eq!(folder.names(""), ["call.txt", "job.txt", "tiles"]);
        assert!(folder.names("tiles").iter().all(|name| name.ends_with(".bin")));
        let tiles = folder.tiles();
        assert!(text.contains(&format!(" {tiles} of 50 tiles are finished")), "{tiles}: {text}");
        let output = ends(basins(&folder.0, &LONG), 0);
        let text = super::basin_calls::text(&output);
        assert!(text.contains(&format!("{tiles} of 50 tiles found")), "{text}");
        assert!(folder.files() == whole);
        folder.remove();
    }
}

/// A search of some minutes is ended at once. It prints nothing, and has no files.
#[test]
fn a_signal_ends_a_search_with_its_status() {
    for (name, status) in [("-INT", 130), ("-TERM", 143)] {
        let mut call = Command::new(env!("CARGO_BIN_EXE_hopper"));
        call.args(["intervals", "-M", "50", "--samples", "1000000", "--to", "64"]);
        let mut call = call.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        // A signal before the program watches for signals ends it by the system, without a status.
        std::thread::sleep(std::time::Duration::from_secs(1));
        assert!(call.try_wait().unwrap().is_none());
        signal(&call, name);
        let output = call.wait_with_output().unwrap();
        let text = text(&output);
        assert_eq!(output.status.code(), Some(status), "{text}");
        assert!(text.starts_with("interrupted: nothing of the search is kept"), "{text}");
        assert!(output.stdout.is_empty());
    }
}

#[test]
fn damaged_tiles_are_named_and_computed_again() {
    let whole = undisturbed("damaged_whole", &JOB);
    let (folder, other) = (Folder::new("damaged"), Folder::new("damaged_other"));
    ends(basins(&folder.0, &with(&JOB, &["--part", "1/1"])), 0);
    ends(basins(&other.0, &with(&JOB, &["--part", "1/1", "--speed", "5", "6"])), 0);
    let bytes = |tile: usize| std::fs::read(folder.tile(tile)).unwrap();
    let mut flipped = bytes(1);
    flipped[100] ^= 4;
    let damage: [(Vec<u8>, &str); 6] = [
        (bytes(0)[..1000].to_vec(), "damaged"),
        (flipped, "damaged"),
        (Vec::new(), "too short"),
        (std::fs::read(other.tile(3)).unwrap(), "another job"),
        (bytes(5), "another piece"),
        (b"not a tile, but a file of a user: a longer text".to_vec(), "no piece of any job"),
    ];
    for (tile, (bytes, _)) in damage.iter().enumerate() {
        std::fs::write(folder.tile(tile), bytes).unwrap();
    }
    let text = text(&ends(basins(&folder.0, &with(&JOB, &["--join"])), 1));
    assert!(text.contains("6 of 20 tiles are missing or damaged"), "{text}");
    assert!(text.contains("--part 1/1"), "{text}");
    let output = ends(basins(&folder.0, &JOB), 0);
    let text = super::basin_calls::text(&output);
    for (tile, (_, reason)) in damage.iter().enumerate() {
        let name = folder.tile(tile).display().to_string();
        let line = text.lines().find(|line| line.contains(&name)).unwrap_or_default();
        assert!(line.contains(reason) && line.contains("computed again"), "{tile}: {text}");
    }
    assert!(text.contains("14 of 20 tiles found"), "{text}");
    assert!(folder.files() == whole);
    folder.remove();
    other.remove();
}

/// A tile of one layer has other bytes than that of another one: it would be read as basins that are not there.
#[test]
fn a_tile_of_another_layer_is_never_joined() {
    let both = with(&JOB, &["--layer", "label", "hops"]);
    let whole = undisturbed("foreign_layer_whole", &both);
    for (from, to) in [("tiles_hops", "tiles"), ("tiles", "tiles_hops")] {
        let folder = Folder::new(&format!("foreign_{to}"));
        let call = |more: &[&'static str]| basins(&folder.0, &with(&both, more));
        ends(call(&["--part", "1/1"]), 0);
        let tile = |name: &str| folder.0.join(name).join("piece_000001.bin");
        std::fs::copy(tile(from), tile(to)).unwrap();
        let text = text(&ends(call(&["--join"]), 1));
        assert!(text.contains("1 of 20 tiles"), "{text}");
        assert!(text.contains("another job"), "{text}");
        ends(call(&[]), 0);
        assert!(folder.files() == whole);
        folder.remove();
    }
}

#[test]
fn parts_are_computed_side_by_side_and_joined_when_all_are_there() {
    let whole = undisturbed("parts_whole", &LONG);
    let folder = Folder::new("parts");
    let part = |text: &'static str| basins(&folder.0, &with(&LONG, &["--part", text]));
    let mut calls = ["1/3", "2/3"].map(|text| part(text).spawn().unwrap());
    folder.wait_for_a_tile();
    signal(&calls[0], "-STOP");
    // The whole job, the joining and the same part are refused while a part is at work.
    for more in [&[][..], &["--join"], &["--part", "1/3"], &["--force"]] {
        let text = text(&ends(basins(&folder.0, &with(&LONG, more)), 1));
        assert!(text.contains("is at work on 'basins.part-"), "{text}");
    }
    signal(&calls[0], "-CONT");
    for call in &mut calls {
        assert!(call.wait().unwrap().success());
    }
    let text = text(&ends(basins(&folder.0, &with(&LONG, &["--join"])), 1));
    assert!(text.contains("16 of 50 tiles are missing or damaged: 2, 5, 8, 11, 14, …"), "{text}");
    assert!(text.contains("run --part 3/3, or the call without --join"), "{text}");
    assert_eq!(folder.tiles(), 34);
    ends(part("3/3"), 0);
    ends(basins(&folder.0, &with(&LONG, &["--join"])), 0);
    assert!(folder.files() == whole);
    // A part that is computed after the end has nothing to do.
    let output = ends(part("3/3"), 0);
    assert!(super::basin_calls::text(&output).contains("complete already"));
    assert!(folder.files() == whole);
    folder.remove();
}

#[test]
fn a_folder_has_one_job_until_it_is_replaced_by_force() {
    let other = ["--pixels", "320", "40", "--speed", "5", "6"];
    let (whole, whole_other) = (undisturbed("job_whole", &JOB), undisturbed("job_other", &other));
    let folder = Folder::new("job");
    ends(basins(&folder.0, &JOB), 0);
    std::fs::write(folder.0.join("notes.md"), b"of the user").unwrap();
    let before = folder.files();
    for more in [&other[..], &["--pixels", "320", "41"], &["--about", "2", "--pixels", "2", "3"]] {
        let text = text(&ends(basins(&folder.0, more), 2));
        assert!(text.starts_with("error: --out ") && text.contains("--force"), "{text}");
        assert!(text.contains("'basins, M 0.1 to 0.3, "), "{text}");
        assert_eq!(text.lines().count(), 1, "{text}");
        assert!(folder.files() == before);
    }
    // The same job is complete, and computed again only by force.
    assert!(text(&ends(basins(&folder.0, &JOB), 0)).contains("complete already"));
    ends(basins(&folder.0, &with(&JOB, &["--force"])), 0);
    assert!(folder.files() == before);
    ends(basins(&folder.0, &with(&other, &["--force"])), 0);
    let mut files = folder.files();
    assert_eq!(files.remove("notes.md").as_deref(), Some(&b"of the user"[..]));
    assert!(files == whole_other);
    // Results without the description of their job, as earlier versions left them.
    std::fs::remove_file(folder.0.join("job.txt")).unwrap();
    let text = text(&ends(basins(&folder.0, &JOB), 2));
    assert!(text.contains("basin.") && text.contains("job.txt"), "{text}");
    ends(basins(&folder.0, &with(&JOB, &["--force"])), 0);
    std::fs::remove_file(folder.0.join("notes.md")).unwrap();
    assert!(folder.files() == whole);
    folder.remove();
}

#[test]
fn damaged_results_are_named_and_computed_again() {
    let folder = Folder::new("results");
    ends(basins(&folder.0, &JOB), 0);
    let whole = folder.files();
    for name in ["basin.npy", "basin.png", "legend.json", "basin.digests"] {
        let mut damaged = whole[name].clone();
        let middle = damaged.len() / 2;
        damaged[middle] ^= 1;
        for bytes in [Some(&damaged[..]), Some(&damaged[..middle]), Some(b""), None] {
            let path = folder.0.join(name);
            match bytes {
                Some(bytes) => std::fs::write(&path, bytes).unwrap(),
                None => std::fs::remove_file(&path).unwrap(),
            }
            let text = text(&ends(basins(&folder.0, &JOB), 0));
            assert!(!text.contains("complete already"), "{name}: {text}");
            assert!(folder.files() == whole, "{name}");
        }
    }
    assert!(text(&ends(basins(&folder.0, &JOB), 0)).contains("complete already"));
    // A list of digests without one of the results is not that of this job.
    let list = String::from_utf8(whole["basin.digests"].clone()).unwrap();
    let shorter: Vec<&str> = list.lines().filter(|line| !line.ends_with("basin.npy")).collect();
    std::fs::write(folder.0.join("basin.digests"), shorter.join("\n") + "\n").unwrap();
    std::fs::remove_file(folder.0.join("basin.npy")).unwrap();
    assert!(!text(&ends(basins(&folder.0, &JOB), 0)).contains("complete already"));
    assert!(folder.files() == whole);
    folder.remove();
}

#[test]
fn a_layer_can_be_added_and_threads_do_not_change_it() {
    let both = undisturbed("layers_whole", &with(&JOB, &["--layer", "label", "hops"]));
    let folder = Folder::new("layers");
    ends(basins(&folder.0, &JOB), 0);
    let mut call = basins(&folder.0, &with(&JOB, &["--layer", "hops"]));
    call.env("RAYON_NUM_THREADS", "5");
    ends(call, 0);
    assert!(folder.files() == both);
    let header = &both["hops.npy"][..128];
    let text = String::from_utf8_lossy(header);
    assert!(text.contains("'<u8'") && text.contains("(40, 320)"), "{text}");
    assert_eq!(both["hops.npy"].len(), 128 + 8 * 320 * 40);
    folder.remove();
}

#[test]
fn shares_and_frames_go_on_after_a_signal_and_are_joined_from_parts() {
    let shares = ["--about", "2", "--pixels", "12", "60", "--mass-ratio", "0.19", "0.21"];
    let zoom = [
        "--zoom",
        "0.12",
        "11.920553918335777",
        "--frames",
        "4",
        "--step",
        "40",
        "--pixels",
        "9",
        "8",
    ];
    for job in [&shares[..], &zoom] {
        let call = |folder: &Folder, more: &[&str]| {
            let mut call = std::process::Command::new(env!("CARGO_BIN_EXE_hopper"));
            call.arg("basins").args(job).args(more).arg("--out").arg(&folder.0);
            call.stdout(Stdio::null()).stderr(Stdio::piped());
            call
        };
        let whole = Folder::new("scales_whole");
        ends(call(&whole, &[]), 0);
        let folder = Folder::new("scales");
        ends(call(&folder, &["--part", "2/2"]), 0);
        let text = text(&ends(call(&folder, &["--join"]), 1));
        assert!(text.contains("--part 1/2"), "{text}");
        ends(call(&folder, &["--part", "1/2"]), 0);
        ends(call(&folder, &["--join"]), 0);
        assert!(folder.files() == whole.files());
        assert!(
            super::basin_calls::text(&ends(call(&folder, &[]), 0)).contains("complete already")
        );
        whole.remove();
        folder.remove();
    }
}

#[test]
fn a_reader_that_closes_the_output_is_no_error_and_a_full_output_is_one() {
    let folder = Folder::new("output");
    let mut call = basins(&folder.0, &JOB).stdout(Stdio::piped()).spawn().unwrap();
    drop(call.stdout.take());
    let output = call.wait_with_output().unwrap();
    assert_eq!((output.status.code(), text(&output).as_str()), (Some(0), ""));
    let full = std::fs::File::options().write(true).open("/dev/full").unwrap();
    let mut call = basins(&folder.0, &with(&JOB, &["--quiet"]));
    call.stdout(full);
    assert!(text(&ends(call, 1)).contains("standard output"));
    folder.remove();
}

/// Each wrong call has one line that names the option and the remedy, exits with 2, and writes nothing.
#[test]
fn wrong_calls_are_refused_in_one_line_and_write_nothing() {
    let calls: [(&[&str], &str); 35] = [
        (&["--mass-ratio", "1", "0.1"], "--mass-ratio 1 0.1: "),
        (&["--mass-ratio", "1", "1"], "--mass-ratio 1 1: "),
        (&["--mass-ratio", "1", "1.0000000000000002"], "--mass-ratio 1 1.0000000000000002: "),
        (&["--mass-ratio", "0", "1"], "--mass-ratio"),
        (&["--mass-ratio", "-1", "1"], "--mass-ratio"),
        (&["--mass-ratio", "nan", "1"], "--mass-ratio"),
        (&["--mass-ratio", "0.1", "inf"], "--mass-ratio"),
        (&["--mass-ratio", "0.1"], "--mass-ratio"),
        (&["--speed", "6", "5"], "--speed 6 5: "),
        (&["--speed", "-1", "5"], "--speed -1 5: "),
        (&["--speed", "0", "1e6"], "--speed 0 1000000: "),
        (&["--speed", "-inf", "inf"], "-inf"),
        (&["--speed", "five", "6"], "--speed"),
        (&["--pixels", "0", "10"], "--pixels 0 10: "),
        (&["--pixels", "10", "1048577"], "--pixels 10 1048577: "),
        (&["--pixels", "1048576", "1048576"], "--pixels 1048576 1048576: "),
        (&["--pixels", "-1", "10"], "-1"),
        (&["--pixels", "1.5", "10"], "--pixels"),
        (&["--part", "0/4"], "--part"),
        (&["--part", "5/4"], "--part"),
        (&["--part", "1"], "--part"),
        (&["--part", "1/4", "--join"], "--join"),
        (&["--part", "1/4", "--force"], "--force"),
        (&["--join", "--force"], "--force"),
        (&["--join"], "--join --out "),
        (&["--layer", "labels"], "label"),
        (&["--about", "0"], "'0' for '--about <N>'"),
        (&["--about", "2", "--offset", "1e-9", "1e-3"], "--offset "),
        (&["--about", "2", "--turns", "0"], "--turns 0: "),
        (&["--about", "2", "--speed", "5", "6"], "--speed"),
        (&["--about", "2", "--preimage", "0.2", "7.725"], "--preimage 0.2 7.725: "),
        (&["--zoom", "0.12", "11.92", "--frames", "0"], "--frames 0: "),
        (&["--zoom", "0.12", "11.92", "--step", "0"], "--step 0: "),
        (&["--frames", "3"], "--zoom"),
        (&["--color", "red"], "--color"),
    ];
    let folder = Folder::new("wrong");
    for (options, words) in calls {
        let mut call = std::process::Command::new(env!("CARGO_BIN_EXE_hopper"));
        call.arg("basins").args(options).arg("--out").arg(&folder.0);
        let text = text(&ends(call, 2));
        assert!(text.starts_with("error: ") && text.lines().count() == 1, "{options:?}: {text}");
        assert!(text.contains(words), "{options:?}: {text}");
        assert!(!folder.0.exists(), "{options:?}");
    }
}
