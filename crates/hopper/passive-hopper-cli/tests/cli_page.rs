//! The calls of docs/cli.md, run in order in one folder, give the output that the page shows.

use std::process::Command;

/// The calls of the page, each with the lines after it.
fn calls(page: &str) -> Vec<(&str, String)> {
    let mut calls: Vec<(&str, String)> = Vec::new();
    let mut inside = false;
    for line in page.lines() {
        if let Some(fence) = line.strip_prefix("```") {
            inside = fence == "console";
        } else if let Some(call) = line.strip_prefix("$ ").filter(|_| inside) {
            calls.push((call, String::new()));
        } else if let Some((_, output)) = calls.last_mut().filter(|_| inside) {
            *output += line;
            *output += "\n";
        }
    }
    calls
}

#[test]
fn the_calls_of_the_page_give_its_output() {
    let page = include_str!("../../../../docs/cli.md");
    let folder = std::env::temp_dir().join(format!("hopper_cli_page_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_hopper"));
    let own = program.parent().expect("a file is in a folder").display();
    let path = format!("{own}:{}", std::env::var("PATH").unwrap_or_default());
    let calls = calls(page);
    assert!(calls.len() >= 15);
    for (call, expected) in calls {
        let mut shell = Command::new("sh");
        shell.args(["-c", call]).env("PATH", &path).env("LC_ALL", "C").current_dir(&folder);
        let output = String::from_utf8(shell.output().unwrap().stdout).unwrap();
        assert_eq!(output, expected, "{call}");
    }
    for file in ["cobweb.svg", "motion.csv", "hopper.gif"] {
        assert!(std::fs::metadata(folder.join(file)).unwrap().len() > 1000, "{file}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
