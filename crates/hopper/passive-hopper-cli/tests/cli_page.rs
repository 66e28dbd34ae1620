//! The calls of docs/cli.md and docs/nonsmooth-cli.md, run in order in one folder, give the output that the pages show.

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

/// The folder in which the calls of a page run, with some files.
fn folder(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("{name}_{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs the calls of a page, at least so many, one after the other.
fn check(page: &str, least: usize, folder: &std::path::Path) {
    let program = std::path::Path::new(env!("CARGO_BIN_EXE_hopper"));
    let own = program.parent().expect("a file is in a folder").display();
    let path = format!("{own}:{}", std::env::var("PATH").unwrap_or_default());
    let calls = calls(page);
    assert!(calls.len() >= least);
    for (call, expected) in calls {
        let mut shell = Command::new("sh");
        shell.args(["-c", call]).env("PATH", &path).env("LC_ALL", "C").current_dir(folder);
        let output = String::from_utf8(shell.output().unwrap().stdout).unwrap();
        assert_eq!(output, expected, "{call}");
    }
}

#[test]
fn the_calls_of_the_page_give_its_output() {
    let folder = folder("hopper_cli_page");
    check(include_str!("../../../../docs/cli.md"), 15, &folder);
    for file in ["cobweb.svg", "motion.csv", "hopper.gif"] {
        assert!(std::fs::metadata(folder.join(file)).unwrap().len() > 1000, "{file}");
    }
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn the_calls_of_the_page_of_any_model_give_its_output() {
    let page = include_str!("../../../../docs/nonsmooth-cli.md");
    let folder = folder("nonsmooth_page");
    let models = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    for file in std::fs::read_dir(models).unwrap() {
        let file = file.unwrap();
        std::fs::copy(file.path(), folder.join(file.file_name())).unwrap();
    }
    // The files of the page are those of the examples, but for their first line.
    let shown = page.split("```toml\n").skip(1).map(|rest| rest.split("```").next().unwrap());
    let shown: Vec<&str> = shown.collect();
    assert_eq!(shown.len(), 2);
    for (file, shown) in ["ball.toml", "oscillator.toml"].iter().zip(shown) {
        let own = std::fs::read_to_string(folder.join(file)).unwrap();
        assert_eq!(own.split_once('\n').unwrap().1, shown);
    }
    check(page, 8, &folder);
    assert!(std::fs::metadata(folder.join("branch.png")).unwrap().len() > 1000);
    // The pictures of the page are those of its calls.
    let figures = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../docs/figures");
    for file in ["diagram.png", "basin.png"] {
        let (own, shown) = (folder.join(file), figures.join(format!("nonsmooth_{file}")));
        assert!(
            std::fs::read(&own).unwrap() == std::fs::read(&shown).unwrap(),
            "{}",
            own.display()
        );
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
