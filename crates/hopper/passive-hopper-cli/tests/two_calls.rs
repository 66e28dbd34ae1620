//! Two calls of `hopper basins` with one folder: one of them works, and the other one returns an error. The result has
//! the bytes of an undisturbed call, even if either call is stopped or killed.

#![cfg(unix)]

use super::basin_calls::{Folder, basins, ends, signal, text, undisturbed};
use std::path::Path;
use std::process::{Child, Command, Output};
use std::time::Duration;

/// A call that lasts long enough to be stopped within it: 50 tiles.
const LONG: [&str; 3] = ["--pixels", "800", "120"];

/// The same pixels of another window.
const OTHER: [&str; 6] = ["--pixels", "800", "120", "--speed", "4.5", "20"];

fn raster(out: &Path) -> Command {
    basins(out, &LONG)
}

/// A call that was refused: exit 1, and the error names the folder and the process at work.
fn assert_is_refused(output: &Output, folder: &Path, holder: u32) {
    let text = text(output);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains("is at work"), "{text}");
    assert!(text.contains(&folder.display().to_string()), "{text}");
    assert!(text.contains(&format!("process {holder} ")), "{text}");
}

#[test]
fn of_two_calls_at_once_one_wins_and_the_other_names_it() {
    let (whole, folder) = (undisturbed("at_once_whole", &LONG), Folder::new("at_once"));
    let calls = [(); 4].map(|()| raster(&folder.0).spawn().unwrap());
    let ids = calls.each_ref().map(Child::id);
    let outputs = calls.map(|call| call.wait_with_output().unwrap());
    // A call that starts after the end of another one finds its results complete.
    let ended = |(_, output): &(&u32, &Output)| output.status.success();
    let winners: Vec<u32> = ids.iter().zip(&outputs).filter(ended).map(|(id, _)| *id).collect();
    assert!(!winners.is_empty());
    for output in outputs.iter().filter(|output| !output.status.success()) {
        let text = text(output);
        let named = winners.iter().find(|id| text.contains(&format!("process {id} ")));
        assert_is_refused(output, &folder.0, *named.unwrap_or(&0));
    }
    assert!(folder.files() == whole);
    folder.remove();
}

#[test]
fn a_stopped_call_keeps_its_folder_and_ends_well() {
    let (whole, folder) = (undisturbed("stopped_whole", &LONG), Folder::new("stopped"));
    let first = raster(&folder.0).spawn().unwrap();
    folder.wait_for_a_tile();
    signal(&first, "-STOP");
    let before = folder.names("");
    assert_is_refused(&raster(&folder.0).output().unwrap(), &folder.0, first.id());
    // The refused call left no file and removed none.
    assert_eq!(folder.names(""), before);
    // A second call that is killed at any time also does no harm.
    for milliseconds in [0, 1, 2, 5, 10, 20] {
        let mut second = raster(&folder.0).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(milliseconds));
        second.kill().unwrap();
        second.wait().unwrap();
    }
    signal(&first, "-CONT");
    let output = first.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", text(&output));
    assert!(folder.files() == whole);
    folder.remove();
}

/// The folder of a stopped call is removed, and a second call begins there anew with another window.
#[test]
fn a_call_whose_folder_was_removed_leaves_the_next_call_alone() {
    let (whole, folder) = (undisturbed("removed_whole", &OTHER), Folder::new("removed"));
    let first = raster(&folder.0).spawn().unwrap();
    folder.wait_for_a_tile();
    signal(&first, "-STOP");
    std::thread::sleep(Duration::from_millis(50)); // its threads stop one after another
    std::fs::remove_dir_all(&folder.0).unwrap();
    let second = basins(&folder.0, &OTHER).spawn().unwrap();
    folder.wait_for_a_tile();
    signal(&second, "-STOP");
    signal(&first, "-CONT");
    let output = first.wait_with_output().unwrap();
    let text = text(&output);
    assert_eq!(output.status.code(), Some(1), "{text}");
    assert!(text.contains(&folder.0.display().to_string()), "{text}");
    signal(&second, "-CONT");
    let output = second.wait_with_output().unwrap();
    assert!(output.status.success(), "{}", super::basin_calls::text(&output));
    assert!(folder.files() == whole);
    folder.remove();
}

#[test]
fn a_name_that_no_result_can_have_is_an_error_before_the_computation() {
    for name in ["basin.npy", "basin.png", "legend.json", "basin.digests", "basins.lock", "job.txt"]
    {
        let folder = Folder::new("names");
        std::fs::create_dir_all(folder.0.join(name)).unwrap();
        let text = text(&ends(raster(&folder.0), 1));
        assert!(text.contains(name) && text.contains("remove it"), "{text}");
        assert_eq!(folder.names(""), [name]);
        folder.remove();
        // A named pipe would let the call wait for ever.
        let folder = Folder::new("pipes");
        std::fs::create_dir_all(&folder.0).unwrap();
        assert!(Command::new("mkfifo").arg(folder.0.join(name)).status().unwrap().success());
        let output = ends(raster(&folder.0), 1);
        assert!(super::basin_calls::text(&output).contains(name), "{output:?}");
        folder.remove();
    }
}

#[test]
fn after_a_kill_the_next_call_goes_on_and_cleans_up() {
    let (whole, folder) = (undisturbed("killed_whole", &LONG), Folder::new("killed"));
    let mut first = raster(&folder.0).spawn().unwrap();
    folder.wait_for_a_tile();
    first.kill().unwrap();
    first.wait().unwrap();
    // The lock file of the killed call is still there, and locks nothing.
    assert!(folder.names("").contains(&"basins.lock".to_owned()), "{:?}", folder.names(""));
    for name in ["basin.npy.1-0.partial.tmp", "legend.json.4194304-12.partial.tmp"] {
        std::fs::write(folder.0.join(name), b"half").unwrap();
    }
    std::fs::write(folder.0.join("tiles/piece_000049.bin.1-0.partial.tmp"), b"half").unwrap();
    ends(raster(&folder.0), 0);
    assert!(folder.files() == whole);
    folder.remove();
}
