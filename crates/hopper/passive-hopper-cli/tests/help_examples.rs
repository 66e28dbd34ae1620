//! The help: every command says units, limits and fields, and its examples run.

use super::common::call;
use std::process::Command;

const COMMANDS: [&str; 10] =
    ["hop", "orbit", "fate", "basins", "coverage", "scales", "zoom", "map", "intervals", "units"];

/// The calls in the examples of a help text.
fn examples(help: &str) -> Vec<String> {
    let after = help.split_once("\nExamples:\n").expect("the help has examples").1;
    let mut calls: Vec<String> = Vec::new();
    for line in after.lines() {
        match line.strip_prefix("    ") {
            // A call may have several lines.
            Some(line) => {
                *calls.last_mut().expect("a text is before a call") += &format!("{line}\n")
            }
            None => calls.push(String::new()),
        }
    }
    calls
}

#[test]
fn every_command_says_its_units_limits_and_fields() {
    for command in COMMANDS {
        let help = call(&[command, "--help"], b"");
        assert_eq!((help.code, help.messages.as_str()), (0, ""));
        for part in
            ["Units:", "Limits:", "Table `", "Examples:", "--json", "--csv", "Usage: hopper"]
        {
            assert!(help.output.contains(part), "{command}: {part}");
        }
        assert!(help.output.contains("m₂gω/k") || help.output.contains("m/s"), "{command}");
        // Every column of the CSV is in the help.
        assert!(examples(&help.output).len() >= 2, "{command}");
    }
    let help = call(&["--help"], b"").output;
    for part in ["m₂gω/k", "130", "Exit status:", "orbit"] {
        assert!(help.contains(part), "{part}");
    }
}

#[test]
fn the_examples_of_the_help_run() {
    let folder = std::env::temp_dir().join(format!("hopper_examples_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_hopper"));
    let own = program.parent().expect("a file is in a folder").display();
    let path = format!("{own}:{}", std::env::var("PATH").unwrap_or_default());
    for command in COMMANDS {
        for line in examples(&call(&[command, "--help"], b"").output) {
            let mut shell = Command::new("sh");
            shell.args(["-c", &line]).env("PATH", &path).current_dir(&folder);
            let done = shell.output().unwrap();
            let messages = String::from_utf8_lossy(&done.stderr);
            assert!(done.status.success(), "{line}: {messages}");
            assert!(!done.stdout.is_empty(), "{line}");
        }
    }
    for file in ["cobweb.png", "motion.svg", "map.svg"] {
        assert!(std::fs::metadata(folder.join(file)).unwrap().len() > 1000, "{file}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_columns_of_the_output_are_those_of_the_help() {
    let calls: [(&[&str], &[&str]); 8] = [
        (&["hop", "7", "-M", "0.2"], &["hops", "landings"]),
        (&["orbit", "7", "-M", "0.2"], &["orbit", "fates"]),
        (&["orbit", "2", "-M", "1"], &["orbit", "fates"]),
        (&["fate", "7", "-M", "0.2"], &["fates"]),
        (&["fate", "-M", "0.2"], &["fates"]),
        (&["map", "-M", "0.2", "--speed", "0", "5"], &["fixed_points", "curve"]),
        (
            &["intervals", "-M", "0.2", "--to", "2", "--undecided", "1e-2"],
            &["fractions", "search", "intervals"],
        ),
        (
            &["units", "--upper", "1kg", "--lower", "1kg", "--stiffness", "1N/m", "1m/s"],
            &["units", "values"],
        ),
    ];
    for (arguments, tables) in calls {
        let help = call(&[arguments[0], "--help"], b"").output;
        let json = call(&[arguments, &["--json"]].concat(), b"4.5\n8\n");
        assert_eq!(json.code, 0, "{}", json.messages);
        let json: serde_json::Value = serde_json::from_str(&json.output).unwrap();
        assert_eq!(json.as_object().unwrap().len(), tables.len());
        for &table in tables {
            let (_, columns) = help.split_once(&format!("\nTable `{table}`: ")).unwrap();
            let columns = columns.lines().skip(1).take_while(|line| line.starts_with("  "));
            // The rest of a long meaning is indented.
            let columns = columns.filter(|line| !line.starts_with("   "));
            let columns: Vec<&str> =
                columns.filter_map(|line| line.split_whitespace().next()).collect();
            let csv = call(&[arguments, &["--csv", "--table", table]].concat(), b"4.5\n8\n").output;
            // The errors of some of them follow.
            let names: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
            let (own, errors) = names.split_at(columns.len());
            assert_eq!(own, columns, "{arguments:?} {table}");
            let of_column =
                |name: &&str| name.strip_suffix("_error").is_some_and(|own| columns.contains(&own));
            assert!(errors.iter().all(of_column), "{errors:?}");
            let rows = json[table].as_array().unwrap();
            assert!(!rows.is_empty() && rows.len() + 1 == csv.lines().count(), "{table}");
            for row in rows {
                // A row with too few cells would lose its last names.
                assert_eq!(row.as_object().unwrap().len(), names.len(), "{table}");
            }
        }
    }
}

#[test]
fn completions_and_manual_pages_name_every_command() {
    for shell in ["bash", "fish", "zsh"] {
        let text = call(&["completions", shell], b"").output;
        assert!(COMMANDS.iter().all(|command| text.contains(command)), "{shell}");
    }
    let page = call(&["manual"], b"").output;
    assert!(page.starts_with(".ie") && page.contains(".TH hopper"), "{page}");
    let folder = std::env::temp_dir().join(format!("hopper_manual_{}", std::process::id()));
    let all = call(&["manual", "--all", &folder.display().to_string()], b"");
    assert_eq!((all.code, all.output.as_str()), (0, ""), "{}", all.messages);
    for command in COMMANDS {
        let page = std::fs::read_to_string(folder.join(format!("hopper-{command}.1"))).unwrap();
        assert!(page.contains(".TH hopper") && page.contains("Limits"), "{command}");
    }
    assert!(folder.join("hopper.1").is_file() && folder.join("hopper-basins-status.1").is_file());
    std::fs::remove_dir_all(&folder).unwrap();
    let page = call(&["manual", "fate"], b"").output;
    assert!(
        page.contains(".TH hopper") && page.contains("mass\\-ratio") && page.contains("Limits")
    );
}
