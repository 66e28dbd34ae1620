//! Two reports in one folder at the same time.

use std::process::{Command, Stdio};

#[test]
fn two_reports_in_one_folder_do_not_disturb_each_other() {
    let folder = std::env::temp_dir().join(format!("hopper_two_reports_{}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    let report = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_hopper-studies"));
        command.args(["reproduce-paper", "--only", "fig1", "--out"]).arg(&folder);
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    };
    for run in [(); 6].map(|()| report()) {
        let output = run.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let entries = std::fs::read_dir(&folder).unwrap();
    let names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    assert!(names.iter().all(|name| !name.ends_with(".tmp")), "{names:?}");
    std::fs::remove_dir_all(&folder).unwrap();
}
