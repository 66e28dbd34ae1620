//! `reproduce-paper --check` as a program.

use std::process::{Command, Output};

fn check(only: &str) -> Output {
    let name = format!("hopper_reproduce_{only}_{}", std::process::id());
    let folder = std::env::temp_dir().join(name);
    let mut command = Command::new(env!("CARGO_BIN_EXE_hopper-studies"));
    let output = command
        .args(["reproduce-paper", "--check", "--only", only, "--out"])
        .arg(&folder)
        .output()
        .unwrap();
    std::fs::remove_dir_all(&folder).unwrap();
    output
}

/// Fig. 1 is a sketch: it has no data and no copy in docs/figures.
#[test]
fn a_check_that_compares_nothing_is_an_error() {
    let output = check("fig1");
    let error = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(error.contains("--check compared nothing"), "{error}");
}

#[test]
fn a_check_tells_the_files_compared() {
    let output = check("fig2");
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(text.contains(" files compared with docs/figures"), "{text}");
    assert!(!text.contains(" 0 files"), "{text}");
}
