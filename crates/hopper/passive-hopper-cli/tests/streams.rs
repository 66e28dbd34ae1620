//! Standard streams: filters, numbers that read back, readers that go away, full disks.

use super::common::call;
use std::io::{Read, Write};
use std::process::{Command, Stdio};

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_hopper"))
}

/// A filter of a hundred thousand lines whose reader goes away after the first: no error.
#[test]
fn a_reader_that_goes_away_is_no_error() {
    for form in ["--csv", "--json", "--quiet"] {
        let mut child = program()
            .args(["fate", "-M", "0.2", form])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut input = child.stdin.take().unwrap();
        let writer = std::thread::spawn(move || {
            for k in 0..100_000 {
                // The program ends before it has read everything.
                if writeln!(input, "{}", 4.5 + f64::from(k) * 1e-4).is_err() {
                    break;
                }
            }
        });
        let mut first = [0; 10];
        child.stdout.take().unwrap().read_exact(&mut first).unwrap();
        let done = child.wait_with_output().unwrap();
        writer.join().unwrap();
        assert_eq!(done.status.code(), Some(0), "{form}");
        assert_eq!(String::from_utf8_lossy(&done.stderr), "", "{form}");
    }
}

#[test]
fn help_into_a_closed_pipe_is_no_error() {
    let mut child =
        program().arg("--help").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    let done = child.wait_with_output().unwrap();
    assert_eq!((done.status.code(), done.stderr), (Some(0), Vec::new()));
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_a_failure() {
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let done = program().args(["hop", "7", "-M", "0.2"]).stdout(full).output().unwrap();
    assert_eq!(done.status.code(), Some(1));
    let message = String::from_utf8_lossy(&done.stderr);
    assert!(message.starts_with("error: standard output: ") && message.lines().count() == 1);
}

#[test]
fn the_exit_status_of_the_process_is_that_of_the_call() {
    let code = |arguments: &[&str]| program().args(arguments).output().unwrap().status.code();
    assert_eq!(code(&["hop", "7", "-M", "0.2"]), Some(0));
    assert_eq!(code(&["hop", "7", "-M", "0"]), Some(2));
    assert_eq!(code(&["orbit", "7", "-M", "0.2", "--motion", "/nowhere/a.csv"]), Some(1));
    assert_eq!(code(&["--version"]), Some(0));
}

/// The filter gives the rows of the arguments, in their order.
#[test]
fn a_filter_gives_the_rows_of_single_calls() {
    let speeds: Vec<String> = (1..400).map(|k| format!("{}", 0.05 * f64::from(k))).collect();
    let mut arguments = vec!["fate", "-M", "0.4", "--csv"];
    arguments.extend(speeds.iter().map(String::as_str));
    let alone = call(&arguments, b"");
    let filtered = call(&["fate", "-M", "0.4", "--csv", "-"], speeds.join("\n").as_bytes());
    assert_eq!((alone.code, filtered.code), (0, 0));
    assert_eq!(alone.output, filtered.output);
    assert!(["incessant", "decaying", "grounded"].iter().all(|fate| alone.output.contains(fate)));
    let json = call(&["fate", "-M", "0.4", "--json"], speeds.join("\r\n").as_bytes());
    let json: serde_json::Value = serde_json::from_str(&json.output).unwrap();
    assert_eq!(json["fates"].as_array().unwrap().len(), speeds.len());
    // Also without any line.
    let none = call(&["fate", "-M", "0.4", "--json"], b"");
    assert_eq!(
        serde_json::from_str::<serde_json::Value>(&none.output).unwrap()["fates"]
            .as_array()
            .unwrap()
            .len(),
        0
    );
}

#[test]
fn numbers_read_back_and_are_short() {
    let called = call(&["hop", "1e-300", "2e-5", "7", "268435457", "-M", "1e-200", "--csv"], b"");
    assert_eq!(called.code, 0, "{}", called.messages);
    assert!(called.output.lines().nth(1).unwrap().starts_with("1e-300,lifts off,1e-300,"));
    for field in called.output.split([',', '\n']) {
        assert!(field.len() <= 24, "{field}");
    }
}

#[test]
fn figures_and_motions_go_to_standard_output() {
    let svg = call(&["orbit", "7", "-M", "0.2", "--cobweb", "-"], b"");
    assert!(svg.code == 0 && svg.output.starts_with("<svg") && svg.output.ends_with("</svg>\n"));
    let csv = call(&["orbit", "7", "-M", "0.2", "--hops", "1", "--motion", "-"], b"").output;
    let mut lines = csv.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    assert_eq!(names.len(), 12);
    assert!(names[7..].iter().all(|name| name.ends_with("_error")), "{names:?}");
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..5], ["0", "0", "flight", "1", "7"]);
    // The last line is the next lift-off, with the speed of the table.
    let next = rows.last().unwrap();
    let (position, velocity) = (next[3].parse::<f64>().unwrap(), next[4].parse::<f64>().unwrap());
    assert!((position - 1.0).abs() < 1e-12 && (velocity - 5.4319312674983316).abs() < 1e-12);
}

/// A hop, an orbit and a fate of a line are those of a call of its own, whatever the form of the line.
#[test]
fn commands_are_filters_of_speeds_pairs_and_columns() {
    for command in ["hop", "orbit", "fate"] {
        let alone = |mass_ratio: &str, speed: &str| {
            let rows = call(&[command, speed, "-M", mass_ratio, "--csv"], b"").output;
            let (_, rows) = rows.split_once('\n').unwrap();
            rows.to_owned()
        };
        // An orbit of the input begins its rows with its start.
        let with_start = |mass_ratio: &str, speed: &str, start: &str| {
            let rows = alone(mass_ratio, speed);
            let start = start.to_owned() + if command == "orbit" { speed } else { "" };
            let start = start.trim_end_matches(',').to_owned();
            let comma = if start.is_empty() { "" } else { "," };
            rows.lines().map(|row| format!("{start}{comma}{row}\n")).collect::<String>()
        };
        let rows = |arguments: &[&str], input: &[u8]| {
            let called = call(&[&[command, "--csv"], arguments].concat(), input);
            assert_eq!(called.code, 0, "{}", called.messages);
            called.output.split_once('\n').unwrap().1.to_owned()
        };
        let speeds = rows(&["-M", "0.2"], b"7\n4.55\n");
        assert_eq!(speeds, with_start("0.2", "7", "") + &with_start("0.2", "4.55", ""));
        let pairs = with_start("0.2", "7", "0.2,") + &with_start("0.9", "4.55", "0.9,");
        assert_eq!(rows(&["--pairs"], b"0.2 7\n0.9,4.55\n"), pairs);
        let table = b"\xef\xbb\xbf# a\nrun,alpha,M\na,7,0.2\nb,4.55,0.9\n";
        assert_eq!(rows(&["--columns", "M,alpha"], table), pairs);
        assert_eq!(rows(&["--columns", "alpha", "-M", "0.2"], table), speeds);
        for (arguments, input, why) in [
            (&["--pairs"][..], "7\n", "line 1, '7': it has 1 numbers; give two"),
            (&["--pairs", "-M", "0.2"], "", "cannot be used with"),
            (&["--columns", "M,v"], "M,alpha\n", "there is no column 'v'; give one of: M, alpha"),
            (&["--columns", "v"], "", "give two names"),
            (&["--columns", "M,v", "-M", "1"], "", "one column"),
            (&["7", "--pairs"], "", "leave one out"),
            (&[], "", "--mass-ratio"),
        ] {
            let called = call(&[&[command], arguments].concat(), input.as_bytes());
            assert_eq!(called.code, 2, "{command} {arguments:?}: {}", called.output);
            assert!(called.messages.contains(why), "{command} {arguments:?}: {}", called.messages);
        }
    }
    let picture = call(&["orbit", "-M", "0.2", "--cobweb", "-"], b"7\n");
    assert!(picture.code == 2 && picture.messages.contains("a picture shows one orbit"));
    let fates = call(&["orbit", "--pairs", "--table", "fates", "--csv"], b"0.2 7\n");
    assert!(
        fates.output.starts_with("mass_ratio,speed,fate")
            && fates.output.contains("0.2,7,decaying")
    );
    let landings = call(&["hop", "--pairs", "--table", "landings", "--csv"], b"0.2 7\n");
    assert!(
        landings.output.starts_with("mass_ratio,speed,landing")
            && landings.output.lines().count() == 3
    );
}

#[test]
fn lines_of_json_are_the_rows() {
    let lines = call(&["fate", "-M", "0.2", "--ndjson"], b"4.55\n7\n").output;
    let whole = call(&["fate", "4.55", "7", "-M", "0.2", "--json"], b"").output;
    let whole: serde_json::Value = serde_json::from_str(&whole).unwrap();
    let rows: Vec<serde_json::Value> =
        lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!(&serde_json::Value::from(rows), &whole["fates"]);
    // Another table, and a command whose rows come at once.
    let landings = call(&["hop", "7", "-M", "0.2", "--ndjson", "--table", "landings"], b"").output;
    assert_eq!(landings.lines().count(), 2);
    assert!(call(&["hop", "7", "-M", "0.2", "--ndjson", "--csv"], b"").code == 2);
}

#[test]
fn wrong_lines_are_passed_over_if_that_is_asked_for() {
    let input = b"4.55\nseven\n\n7\n-1\n";
    let found = call(&["fate", "-M", "0.2", "--csv", "--skip-invalid"], input);
    assert_eq!((found.code, found.output.lines().count()), (0, 3));
    assert!(found.messages.starts_with("2 lines were passed over; the first is line 2, 'seven'"));
    let quiet = call(&["fate", "-M", "0.2", "--csv", "--skip-invalid", "--quiet"], input);
    assert_eq!((quiet.output, quiet.messages.as_str()), (found.output, ""));
}

#[test]
fn undecided_fates_are_an_error_if_that_is_asked_for() {
    let undecided = ["fate", "-M", "1e-12", "--csv"];
    for (strict, code) in [(&[][..], 0), (&["--strict"], 1)] {
        let given = call(&[&undecided[..], &["1e12"], strict].concat(), b"");
        let read = call(&[&undecided[..], strict].concat(), b"1e12\n");
        assert_eq!((given.code, read.code), (code, code), "{}", given.messages);
        assert!(given.output == read.output && given.output.contains("1024 bits do not decide"));
        assert_eq!(given.messages.contains("1 of the results are undecided"), code == 1);
    }
    assert_eq!(call(&["fate", "7", "-M", "0.2", "--strict"], b"").code, 0);
}

#[test]
fn the_number_of_threads_does_not_change_a_row() {
    let rows = |threads: &str| {
        let mut done = program();
        done.args(["fate", "4.55", "7", "-M", "0.2", "--csv", "--threads", threads]);
        done.output().unwrap().stdout
    };
    assert!(!rows("1").is_empty() && rows("1") == rows("3"));
    assert_eq!(call(&["fate", "7", "-M", "0.2", "--threads", "0"], b"").code, 2);
}
