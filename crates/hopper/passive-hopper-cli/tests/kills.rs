//! Calls of `hopper basins` that are killed at any instant, beside others or alone, and full disks: no result has
//! wrong bytes, and no exit status is wrong.
//!
//! `HOPPER_KILLS=200 cargo test -p passive-hopper-cli kills -- --nocapture` kills 200 calls, and prints what happened.

#![cfg(unix)]

use super::basin_calls::{Files, Folder, Random, basins, ends, signal, text};
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

/// Kills of the test, unless `HOPPER_KILLS` says another number.
const KILLS: usize = if cfg!(debug_assertions) { 8 } else { 16 };

/// 20 tiles of labels and 20 of numbers of hops.
const JOB: [&str; 6] = ["--pixels", "320", "40", "--layer", "label", "hops"];

/// The number of SIGKILL.
const KILLED: i32 = 9;

/// What happened.
#[derive(Debug, Default)]
struct Tally {
    kills: usize,
    stops: usize,
    full_disks: usize,
    read_only: usize,
    /// Calls that ended by themselves.
    ended: usize,
}

struct Campaign {
    random: Random,
    tally: Tally,
    /// The results of an undisturbed call.
    whole: Files,
    /// A folder with all tiles and no result.
    tiles: Folder,
    /// Times of a whole call, and of the joining alone.
    longest: Duration,
    joining: Duration,
}

impl Campaign {
    fn new() -> Self {
        let begin = Instant::now();
        let whole = super::basin_calls::undisturbed("kills_whole", &JOB);
        let longest = begin.elapsed();
        let (tiles, join) = (Folder::new("kills_tiles"), Folder::new("kills_join"));
        ends(job(&tiles.0, &["--part", "1/1"]), 0);
        copy(&tiles.0, &join.0);
        let begin = Instant::now();
        ends(job(&join.0, &["--join"]), 0);
        let joining = begin.elapsed();
        assert!(join.files() == whole);
        join.remove();
        Campaign { random: Random(7), tally: Tally::default(), whole, tiles, longest, joining }
    }

    /// Waits for a random part of a time, and kills the call if it still runs. Its status is that of the kill, or 0.
    fn kill_after(&mut self, most: Duration, child: &mut Child) -> bool {
        std::thread::sleep(most.mul_f64(self.random.share()));
        if let Some(status) = child.try_wait().unwrap() {
            assert_eq!(status.code(), Some(0));
            self.tally.ended += 1;
            return false;
        }
        child.kill().unwrap();
        let status = child.wait().unwrap();
        // It may have ended between the look and the kill.
        assert!(status.code() == Some(0) || status.signal() == Some(KILLED), "{status}");
        self.tally.kills += 1;
        true
    }

    /// A result under its name is complete, however the calls ended.
    fn check(&self, folder: &Folder) {
        for (name, bytes) in &self.whole {
            if let Ok(found) = std::fs::read(folder.0.join(name)) {
                assert!(found == *bytes, "{name} has wrong bytes");
            }
        }
    }

    /// The last call is not disturbed: it leaves the results and nothing else.
    fn finish(&self, folder: Folder, more: &[&str]) {
        ends(job(&folder.0, more), 0);
        let files = folder.files();
        let names: Vec<_> = files.keys().collect();
        assert!(files == self.whole, "other bytes, or other files: {names:?}");
        folder.remove();
    }

    /// One call after another is killed.
    fn alone(&mut self) {
        let folder = Folder::new("kills_alone");
        for _ in 0..3 {
            let mut call = job(&folder.0, &[]).spawn().unwrap();
            self.kill_after(self.longest.mul_f64(0.7), &mut call);
            self.check(&folder);
        }
        self.finish(folder, &[]);
    }

    /// All tiles are there: calls are killed while they write the arrays, rename them, draw, and remove the tiles.
    fn joining(&mut self) {
        let folder = Folder::new("kills_joining");
        copy(&self.tiles.0, &folder.0);
        for _ in 0..3 {
            let mut call = job(&folder.0, &["--join"]).spawn().unwrap();
            self.kill_after(self.joining, &mut call);
            self.check(&folder);
        }
        self.finish(folder, &["--join"]);
        // A call that goes on after the end removes what is left.
    }

    /// Two calls at once, of which one is killed, or stopped and killed later.
    fn pair(&mut self) {
        let folder = Folder::new("kills_pair");
        let mut first = job(&folder.0, &[]).spawn().unwrap();
        std::thread::sleep(self.longest.mul_f64(0.3 * self.random.share()));
        let is_stopped = self.random.share() < 0.5 && first.try_wait().unwrap().is_none();
        if is_stopped {
            signal(&first, "-STOP");
            self.tally.stops += 1;
        }
        let second = job(&folder.0, &[]).spawn().unwrap();
        if is_stopped {
            // The stopped call keeps its folder.
            self.ended_or_refused(second.wait_with_output().unwrap());
            signal(&first, "-CONT");
            self.kill_after(self.longest, &mut first);
        } else {
            self.kill_after(self.longest.mul_f64(0.5), &mut first);
            self.ended_or_refused(second.wait_with_output().unwrap());
        }
        self.check(&folder);
        self.finish(folder, &[]);
    }

    fn ended_or_refused(&mut self, output: Output) {
        let text = text(&output);
        match output.status.code() {
            Some(0) => {}
            Some(1) => assert!(text.contains("is at work"), "{text}"),
            other => panic!("{other:?}: {text}"),
        }
        self.tally.ended += 1;
    }

    /// Three parts at once, of which two are killed; then joining, which says what is missing.
    fn parts(&mut self) {
        let folder = Folder::new("kills_parts");
        let part = |k: usize| ["--part".to_owned(), format!("{k}/3")];
        let call = |k: usize| job(&folder.0, &part(k).each_ref().map(String::as_str));
        let mut calls = [1, 2, 3].map(|k| call(k).spawn().unwrap());
        let mut killed = Vec::new();
        for k in [0, 1] {
            if self.kill_after(self.longest.mul_f64(0.4), &mut calls[k]) {
                killed.push(k + 1);
            }
        }
        let [_, _, third] = calls;
        let output = third.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", text(&output));
        self.check(&folder);
        for k in killed {
            ends(call(k), 0);
        }
        self.finish(folder, &["--join"]);
    }

    /// The disk is full, or files may not be larger: the call fails with a message, and the next one goes on.
    fn full_disk(&mut self) {
        let folder = Folder::new("kills_full");
        let bytes: usize = self.whole.values().map(Vec::len).sum();
        let kilobytes = 4 + self.random.below(2 * bytes / 1024);
        let output = on_small_disk(&folder.0, kilobytes).unwrap_or_else(|| {
            let limit = self.random.below(300);
            with_small_files(&folder.0, limit)
        });
        self.ended_or_full(&output);
        self.check(&folder);
        let limit = self.random.below(300);
        let output = with_small_files(&folder.0, limit);
        self.ended_or_full(&output);
        self.check(&folder);
        self.finish(folder, &[]);
    }

    fn ended_or_full(&mut self, output: &Output) {
        let text = text(output);
        match output.status.code() {
            Some(0) => self.tally.ended += 1,
            Some(1) => {
                let reasons = ["No space left", "File too large"];
                assert!(reasons.iter().any(|reason| text.contains(reason)), "{text}");
                self.tally.full_disks += 1;
            }
            other => panic!("{other:?}: {text}"),
        }
    }

    /// A folder that cannot be written stays as it is.
    fn read_only(&mut self) {
        let folder = Folder::new("kills_read_only");
        copy(&self.tiles.0, &folder.0);
        let script = "mount --bind \"$0\" \"$0\" && mount -o remount,bind,ro \"$0\" && exec \"$@\"";
        if let Some(output) = in_own_mounts(script, &folder.0, &JOB) {
            let text = text(&output);
            assert_eq!(output.status.code(), Some(1), "{text}");
            assert!(text.contains("Read-only"), "{text}");
            self.tally.read_only += 1;
            assert_eq!(folder.names("tiles"), self.tiles.names("tiles"));
        }
        self.finish(folder, &[]);
    }
}

fn job(out: &Path, more: &[&str]) -> Command {
    basins(out, &[&JOB, more].concat())
}

/// The call where a file may have so many blocks of 512 bytes.
fn with_small_files(out: &Path, blocks: usize) -> Output {
    let call = job(out, &[]);
    let mut command = Command::new("sh");
    command.args(["-c", "ulimit -f \"$0\" && exec \"$@\""]).arg(blocks.to_string());
    command.arg(call.get_program()).args(call.get_args()).env("RAYON_NUM_THREADS", "2");
    command.stdout(Stdio::null()).output().unwrap()
}

/// The call on a disk of so many kilobytes, whose contents are copied to `out` at its end. `None` if a user may not
/// have such a disk.
fn on_small_disk(out: &Path, kilobytes: usize) -> Option<Output> {
    std::fs::create_dir_all(out).unwrap();
    let script = format!(
        "mkdir \"$0.disk\" && mount -t tmpfs -o size={kilobytes}k none \"$0.disk\" && {{ \"$@\"; code=$?; \
         cp -r \"$0.disk/.\" \"$0\"; umount \"$0.disk\"; rmdir \"$0.disk\"; exit $code; }}"
    );
    in_own_mounts(&script, out, &JOB).inspect(|output| {
        let _ = std::fs::remove_dir(format!("{}.disk", out.display()));
        assert!(!text(output).contains("cp:"), "{}", text(output));
    })
}

/// The call in a script that mounts things, which no other process sees. `None` if the system does not let users do so.
fn in_own_mounts(script: &str, out: &Path, more: &[&str]) -> Option<Output> {
    let probe = Command::new("unshare").args(["-rm", "true"]).stderr(Stdio::null()).status();
    if !probe.is_ok_and(|status| status.success()) {
        return None;
    }
    let place = if script.contains("tmpfs") {
        format!("{}.disk", out.display())
    } else {
        out.display().to_string()
    };
    let call = basins(place.as_ref(), more);
    let mut command = Command::new("unshare");
    command.args(["-rm", "sh", "-c", script]).arg(out);
    command.arg(call.get_program()).args(call.get_args()).env("RAYON_NUM_THREADS", "2");
    let output = command.stdout(Stdio::null()).output().unwrap();
    let text = text(&output);
    // In a container a user may have name spaces, and yet no mounts.
    (!text.contains("mount: ")).then_some(output)
}

/// Copies a folder with its folders.
fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let (from, to) = (entry.as_ref().unwrap().path(), to.join(entry.unwrap().file_name()));
        if from.is_dir() {
            copy(&from, &to);
        } else {
            std::fs::copy(&from, &to).unwrap();
        }
    }
}

#[test]
fn no_kill_leaves_wrong_bytes_or_a_wrong_status() {
    let kills = std::env::var("HOPPER_KILLS").ok().and_then(|text| text.parse().ok());
    let mut campaign = Campaign::new();
    while campaign.tally.kills < kills.unwrap_or(KILLS) {
        campaign.alone();
        campaign.pair();
        campaign.joining();
        campaign.parts();
        campaign.full_disk();
        campaign.read_only();
    }
    println!("{:?}: 0 wrong bytes, 0 wrong exit codes", campaign.tally);
    campaign.tiles.remove();
}
