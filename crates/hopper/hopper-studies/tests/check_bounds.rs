//! `check-bounds` as a program: it passes on the bounds of the libraries, and fails on bounds that are too small.

use std::process::{Command, Output};

fn check(arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hopper-studies"));
    command.arg("check-bounds").args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

#[test]
fn the_bounds_of_hops_hold_on_three_thousand_hops() {
    let output = check(&["--hops", "3000", "--group", "hops"]);
    let (out, error) = (text(&output.stdout), text(&output.stderr));
    assert!(output.status.success(), "{error}");
    for line in ["kernel: x′", "general solver: α′²/α²", "106 bits: μΓ²/α²", "next to grounding"]
    {
        assert!(out.contains(line), "{line}: {out}");
    }
    assert!(out.contains("3000 hops were compared; 0 hops are undecided"), "{out}");
}

/// With a thousandth of each bound, every group fails, and the error names the bound, the class and the input.
#[test]
fn planted_bounds_that_are_too_small_fail() {
    for (group, bound) in
        [("hops", "general solver: α′ (random)"), ("sines", "kernel: sin and cos")]
    {
        let output = check(&["--hops", "3000", "--group", group, "--bound-factor", "0.001"]);
        let error = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{error}");
        assert!(error.contains("bounds are smaller than the actual error"), "{error}");
        let line = error.lines().find(|line| line.starts_with(bound));
        assert!(line.is_some_and(|line| line.contains(" times the bound, at ")), "{error}");
    }
}

#[test]
fn the_seed_chooses_the_hops() {
    let with = |seed| text(&check(&["--hops", "1000", "--group", "sines", "--seed", seed]).stdout);
    let without_time = |out: String| out.split("It took").next().unwrap().to_owned();
    assert_eq!(without_time(with("1")), without_time(with("1")));
    assert_ne!(without_time(with("1")), without_time(with("2")));
}

#[test]
fn options_without_sense_are_refused() {
    for arguments in [
        &["--bless", "--group", "hops"][..],
        &["--bound-factor", "0"],
        &["--bound-factor", "nan"],
        &["--hops", "10"],
    ] {
        let output = check(arguments);
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    }
}
