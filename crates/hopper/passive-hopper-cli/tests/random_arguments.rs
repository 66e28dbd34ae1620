//! Thousands of random calls: no panic, a known exit status, one line for a refusal.
//!
//! `HOPPER_SEED=1 cargo test -p passive-hopper-cli random_calls` makes other calls than the test.

use super::common::call;
use basin_of_attraction::SplitMix64;
use std::panic::catch_unwind;

/// Random calls. Without optimization these are fewer.
const CALLS: u32 = if cfg!(debug_assertions) { 200 } else { 3000 };

/// Words that calls are made of: names, options, values, and what is none.
const WORDS: &[&str] = &[
    "hop",
    "orbit",
    "fate",
    "map",
    "intervals",
    "units",
    "completions",
    "manual",
    "help",
    "bash",
    "-M",
    "--mass-ratio",
    "--mass-ratio=0.2",
    "-M1",
    "--json",
    "--csv",
    "--table",
    "--quiet",
    "-v",
    "-qv",
    "--hops",
    "--speed",
    "--points",
    "--from",
    "--to",
    "--undecided",
    "--shortest",
    "--most",
    "--samples",
    "--upper",
    "--lower",
    "--stiffness",
    "--gravity",
    "--alpha",
    "--motion",
    "--cobweb",
    "--figure",
    "--animate",
    "--help",
    "-h",
    "--version",
    "--",
    "-",
    "--=",
    "---",
    "-=",
    "",
    " ",
    "\n",
    "\t7",
    "7 ",
    "\u{0}",
    "é",
    "−7",
    "7",
    "4.55",
    "0.2",
    "1",
    "2",
    "3",
    "0",
    "-0",
    "-1",
    "1e-300",
    "1e300",
    "1e-5",
    "1e9",
    "5e-324",
    "inf",
    "-inf",
    "nan",
    "-nan",
    "1e",
    "e1",
    ".",
    "-.",
    "+",
    "1_000",
    "0x1p3",
    "80g",
    "16g",
    "120N/m",
    "9.81m/s2",
    "1.2m/s",
    "-3cm",
    "2e5mJ",
    "g",
    "fates",
    "curve",
    "hops",
    "values",
    "search",
    "{}",
    "%n",
    "$HOME",
    "a b",
    "'",
    "\"",
    "\\",
];

#[test]
fn random_calls_never_panic() {
    let seed = std::env::var("HOPPER_SEED").ok().and_then(|text| text.parse().ok());
    let random = SplitMix64::from_seed(seed.unwrap_or(2026));
    let mut at = 0;
    let mut next = |most: usize| {
        at += 1;
        (random.uniform(at) * most as f64) as usize
    };
    let mut codes = [0u32; 3];
    for k in 0..CALLS {
        let mut arguments: Vec<&str> = (0..next(9)).map(|_| WORDS[next(WORDS.len())]).collect();
        // Two of three calls begin as a sensible one does, so that the words reach further.
        match k % 3 {
            0 => arguments.splice(0..0, [WORDS[next(6)], "-M", "0.2"]).for_each(drop),
            1 => arguments.insert(0, WORDS[next(8)]),
            _ => {}
        }
        // A file with a random ending would be written.
        let writes = ["--motion", "--cobweb", "--figure", "--animate"];
        if arguments.iter().any(|word| writes.contains(word)) {
            arguments.retain(|word| !word.contains('.') || *word == "4.55" || *word == "0.2");
        }
        let input: Vec<u8> = (0..next(40)).map(|_| b"0123456789.e-\n\r \xff#"[next(18)]).collect();
        let called = catch_unwind(|| call(&arguments, &input));
        let called = called.unwrap_or_else(|_| panic!("panic: {arguments:?} {input:?}"));
        assert!(called.code <= 2, "{arguments:?}: {}", called.messages);
        codes[usize::from(called.code)] += 1;
        assert!(called.code != 0 || !called.output.is_empty() || called.messages.is_empty());
        if called.code > 0 {
            let lines = called.messages.lines().filter(|line| line.starts_with("error: "));
            assert_eq!(lines.count(), 1, "{arguments:?}: {}", called.messages);
            assert!(called.messages.ends_with('\n'), "{arguments:?}");
        }
    }
    assert!(codes[0] > CALLS / 60 && codes[2] > CALLS / 2, "{codes:?}");
}

/// Words of `hopper basins`.
const BASINS: &[&str] = &[
    "--mass-ratio",
    "-M",
    "--speed",
    "--layer",
    "label",
    "hops",
    "--coverage",
    "--part",
    "1/2",
    "2/2",
    "3/2",
    "--join",
    "--force",
    "--about",
    "--offset",
    "1e-2",
    "1e-300",
    "--preimage",
    "--turns",
    "--zoom",
    "--frames",
    "--step",
    "--table",
    "files",
    "--csv",
    "--json",
    "-q",
    "-v",
    "0.12",
    "11.92",
    "0.1",
    "0.2",
    "1",
    "2",
    "3",
    "0",
    "-1",
    "5",
    "1e300",
    "5e-324",
    "nan",
    "-inf",
    "1e9",
    "é",
    "",
    "--",
    "x",
];

/// Rasters of nine pixels and zooms of two frames bound the time: a random call that is accepted computes.
#[test]
fn random_rasters_never_panic() {
    let random = SplitMix64::from_seed(1917);
    let mut at = 0;
    let mut next = |most: usize| {
        at += 1;
        (random.uniform(at) * most as f64) as usize
    };
    let folder = std::env::temp_dir().join(format!("hopper_random_{}", std::process::id()));
    let mut codes = [0u32; 3];
    for k in 0..CALLS / 2 {
        let out = folder.join((k / 100).to_string()).display().to_string();
        let mut arguments = vec!["basins", "--out", &out, "--pixels", "3", "3"];
        // Every third call begins with options that belong together.
        let sensible: &[&[&str]] = &[
            &["-M", "0.1", "0.2"],
            &["--layer", "hops", "label"],
            &["--coverage"],
            &["--about", "2", "--offset", "1e-2", "1e-300"],
            &["--about", "2", "--turns", "1"],
            &["--about", "2", "--preimage", "0.12", "11.92"],
            &["--zoom", "0.12", "11.92", "--frames", "2"],
        ];
        if k % 3 == 0 {
            arguments.extend(sensible[next(sensible.len())]);
        }
        arguments.extend((0..next(5)).map(|_| BASINS[next(BASINS.len())]));
        if arguments.contains(&"--zoom") && !arguments.contains(&"--frames") {
            arguments.extend(["--frames", "2"]);
        }
        let called = catch_unwind(|| call(&arguments, b""));
        let called = called.unwrap_or_else(|_| panic!("panic: {arguments:?}"));
        assert!(called.code <= 2, "{arguments:?}: {}", called.messages);
        codes[usize::from(called.code)] += 1;
        let lines = called.messages.lines().filter(|line| line.starts_with("error: "));
        assert_eq!(
            lines.count(),
            usize::from(called.code > 0),
            "{arguments:?}: {}",
            called.messages
        );
    }
    let _ = std::fs::remove_dir_all(&folder);
    assert!(codes[0] > CALLS / 60 && codes[2] > CALLS / 6, "{codes:?}");
}
