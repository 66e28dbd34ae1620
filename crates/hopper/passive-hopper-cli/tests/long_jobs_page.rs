//! The calls of docs/long-jobs.md, as a reader would type them.

#![cfg(unix)]

use std::path::Path;
use std::process::Command;

const PAGE: &str = include_str!("../../../../docs/long-jobs.md");

/// The shell scripts of a page.
fn scripts(page: &str) -> Vec<&str> {
    page.split("```sh\n").skip(1).filter_map(|rest| rest.split("```").next()).collect()
}

#[test]
fn the_calls_of_the_page_run_and_give_the_files_that_it_names() {
    let folder = std::env::temp_dir().join(format!("hopper_page_{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    let programs = Path::new(env!("CARGO_BIN_EXE_hopper")).parent().unwrap();
    let path = std::env::var("PATH").unwrap();
    let scripts = scripts(PAGE);
    assert_eq!(scripts.len(), 2);
    for script in scripts {
        let mut shell = Command::new("sh");
        shell.args(["-e", "-c", script]).current_dir(&folder);
        let output = shell.env("PATH", format!("{}:{path}", programs.display())).output().unwrap();
        let text = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{script}\n{text}");
    }
    for name in
        ["basin.npy", "basin.png", "legend.json", "job.txt", "hops.npy", "hops.png", "hops.json"]
    {
        assert!(PAGE.contains(&format!("`{name}`")), "{name}");
        assert!(folder.join("basins").join(name).is_file(), "{name}");
    }
    let read = |name: &str| std::fs::read(folder.join(name).join("basin.npy")).unwrap();
    // Both windows have the paper's speeds, the first one as round numbers.
    assert_eq!(read("basins").len(), read("shared").len());
    std::fs::remove_dir_all(&folder).unwrap();
}
