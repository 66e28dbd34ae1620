//! `check-reference` as a program: a check that compares no value, or allows every error, is an error.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

const GOOD: &str = r#"{"class": "c", "mass_ratio": 1, "alpha": 100, "sudden": 0, "alpha_next": "35.997158341573688180303069833057"}"#;

fn check(arguments: &[&str], files: &[&Path]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_hopper-studies"));
    command.arg("check-reference").args(arguments).args(files).output().unwrap()
}

fn file(name: &str, text: &str) -> PathBuf {
    let name = format!("hopper_check_{}_{name}", std::process::id());
    let path = std::env::temp_dir().join(name);
    std::fs::write(&path, text).unwrap();
    path
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_file_without_reference_values_is_an_error_that_names_it() {
    let good = file("good_beside.jsonl", GOOD);
    for (name, text) in [
        ("empty", ""),
        ("blank", "\n  \n\t\n"),
        ("array", "[]"),
        ("spaced_array", " [ \n ] \n"),
        ("undecided", r#"{"n": 1, "mass_ratio": 1, "edge": "not decided", "delta_exact": null}"#),
    ] {
        let path = file(name, text);
        // The file is also tested beside a good file, in both orders.
        for files in [vec![&*path], vec![&*good, &*path], vec![&*path, &*good]] {
            let output = check(&[], &files);
            let error = errors(&output);
            assert_eq!(output.status.code(), Some(1), "{name}: {error}");
            assert!(error.contains(&path.display().to_string()), "{name}: {error}");
            assert!(error.contains("holds no reference value"), "{name}: {error}");
        }
        std::fs::remove_file(&path).unwrap();
    }
    std::fs::remove_file(&good).unwrap();
}

#[test]
fn a_file_of_other_things_is_an_error_that_names_file_and_line() {
    for (name, text, words) in [
        ("other", r#"{"name": "x", "version": 1}"#, "line 1: this is none of the known kinds"),
        ("numbers", "1\n2\n", "line 1: this is none of the known kinds"),
        ("arrays", "[[], []]", "line 1: this is none of the known kinds"),
        ("second", &format!("{GOOD}\n{{}}\n"), "line 2: this is none of the known kinds"),
        ("prose", "not JSON at all\n", "line 1: "),
    ] {
        let path = file(name, text);
        let output = check(&[], &[&path]);
        let error = errors(&output);
        assert_eq!(output.status.code(), Some(1), "{name}: {error}");
        assert!(error.contains(&path.display().to_string()), "{name}: {error}");
        assert!(error.contains(words), "{name}: {error}");
        std::fs::remove_file(&path).unwrap();
    }
}

#[test]
fn a_limit_that_allows_everything_or_nothing_is_refused_with_the_range() {
    let path = file("limits.jsonl", GOOD);
    for limit in ["inf", "-inf", "infinity", "NaN", "nan", "-NaN", "0", "-0", "-1", "1e16", "x", ""]
    {
        for arguments in [vec!["--limit", limit], vec![&*format!("--limit={limit}")]] {
            let output = check(&arguments, &[&path]);
            let error = errors(&output);
            assert_eq!(output.status.code(), Some(2), "{limit}: {error}");
            assert!(error.contains("--limit"), "{limit}: {error}");
            let reason = if limit.is_empty() { "value" } else { "0 < K ≤ 1e15" };
            assert!(error.contains(reason), "{limit}: {error}");
        }
    }
    for limit in ["4", "0.5", "1e15"] {
        assert!(check(&["--limit", limit], &[&path]).status.success(), "{limit}");
    }
    std::fs::remove_file(&path).unwrap();
}

/// A wrong α′ in a line that states an error so large that every answer is within it.
#[test]
fn a_line_that_allows_every_answer_is_no_comparison() {
    let line = |next: &str, more: &str| {
        format!(r#"{{"mass_ratio": 1, "alpha": 100, "sudden": 0, "alpha_next": "{next}"{more}}}"#)
    };
    for (name, text, words) in [
        ("tiny", line("1e-300", ""), "1 errors over K"),
        ("subnormal", line("5e-324", ""), "1 errors over K"),
        ("slope", line("20", r#", "dalpha_next_dalpha": "1e308""#), "no digit was compared"),
        ("slope_m", line("20", r#", "dalpha_next_dM": 1e20"#), "no digit was compared"),
    ] {
        let path = file(name, &text);
        let output = check(&[], &[&path]);
        assert_eq!(output.status.code(), Some(1), "{name}");
        assert!(errors(&output).contains(words), "{name}: {}", errors(&output));
        std::fs::remove_file(&path).unwrap();
    }
    // Beside a line with digits, such a line is counted.
    let mixed =
        file("mixed", &format!("{GOOD}\n{}", line("20", r#", "dalpha_next_dalpha": "1e308""#)));
    let output = check(&[], &[&mixed]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(text.contains("1 of them without a digit to compare"), "{text}");
    std::fs::remove_file(&mixed).unwrap();
}

#[test]
fn the_largest_whole_numbers_are_wrong_decisions() {
    for (name, text) in [
        (
            "n",
            r#"{"n": 18446744073709551615, "mass_ratio": 1, "offset": "1e-5", "sudden": 0, "offset_next": "1e-5"}"#,
        ),
        (
            "sudden",
            r#"{"n": 1, "mass_ratio": 1, "offset": "1e-5", "sudden": 18446744073709551615, "offset_next": "1e-5"}"#,
        ),
    ] {
        let path = file(name, text);
        let output = check(&[], &[&path]);
        assert_eq!(output.status.code(), Some(1), "{name}: {}", errors(&output));
        assert!(errors(&output).contains("1 wrong decisions"), "{name}: {}", errors(&output));
        std::fs::remove_file(&path).unwrap();
    }
}

#[test]
fn the_summary_tells_the_values_compared_in_each_file() {
    let two = file("two.jsonl", &format!("{GOOD}\n\n{GOOD}\n"));
    let array = file("array.json", &format!("[{GOOD}]"));
    let wrong = file("wrong.jsonl", &GOOD.replace("35.9971583415", "35.9971583416"));
    let output = check(&[], &[&two, &array]);
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(output.status.success(), "{}", errors(&output));
    assert!(text.contains("two.jsonl: 2 values compared"), "{text}");
    assert!(text.contains("array.json: 1 values compared"), "{text}");
    let output = check(&[], &[&two, &wrong]);
    assert_eq!(output.status.code(), Some(1));
    assert!(errors(&output).contains("1 errors over K = 4"), "{}", errors(&output));
    for path in [two, array, wrong] {
        std::fs::remove_file(path).unwrap();
    }
}
