//! The compared programs as a table and as CSV.

use super::verdict::{End, Verdict};
use crate::error::Error;
use crate::text::{digit, duration, markdown_table};
use journal_figures::{DataFile, csv_text};

/// A table, scene by scene.
pub(crate) fn markdown<'a>(verdicts: &'a [Verdict]) -> String {
    let mut before = "";
    let row = |verdict: &'a Verdict| {
        // The name of the scene stands in its first row only.
        let scene = if verdict.scene == before { "" } else { verdict.scene.as_str() };
        before = &verdict.scene;
        let time = duration(verdict.seconds);
        let (exact, missed) = (verdict.exact, verdict.exact - verdict.right);
        let (error, end) = (digit(verdict.error), end(verdict.end));
        let Verdict { program, wrong, lines, .. } = verdict;
        format!(
            "{scene} | {program} | {exact} | {missed} | {wrong} | {error} | {end} | {time} | {lines}"
        )
    };
    let columns = "scene | program | events: | missed: | wrong: | largest error: | at the end | time an event: | \
                   lines:";
    markdown_table(columns, verdicts.iter().map(row))
}

fn end(end: End) -> String {
    match end {
        End::Right => "right".into(),
        End::Wrong(x) => format!("x = {x:.1}"),
        End::Stuck => "not reached".into(),
    }
}

/// One line for each program and scene.
pub(crate) fn csv(verdicts: &[Verdict]) -> Result<DataFile, Error> {
    let header = [
        "scene",
        "program",
        "events",
        "missed",
        "wrong",
        "largest_error",
        "end",
        "seconds_per_event",
        "lines",
    ];
    let rows = verdicts.iter().map(|verdict| {
        vec![
            verdict.scene.clone(),
            verdict.program.clone(),
            verdict.exact.to_string(),
            (verdict.exact - verdict.right).to_string(),
            verdict.wrong.to_string(),
            format!("{:e}", verdict.error),
            end(verdict.end),
            format!("{:e}", verdict.seconds),
            verdict.lines.to_string(),
        ]
    });
    Ok(csv_text("events.csv", &header, rows)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_is_named_once() {
        let verdict = |end| Verdict {
            scene: "ball".into(),
            program: "one".into(),
            exact: 40,
            right: 38,
            wrong: 1,
            error: 2e-15,
            end,
            seconds: 4.2e-6,
            lines: 20,
        };
        let verdicts = [verdict(End::Right), verdict(End::Wrong(-4.31)), verdict(End::Stuck)];
        let text = markdown(&verdicts);
        let lines: Vec<_> = text.lines().collect();
        assert_eq!(lines[2], "| ball | one | 40 | 2 | 1 | 2e-15 | right | 4.2 µs | 20 |");
        assert_eq!(lines[3], "|  | one | 40 | 2 | 1 | 2e-15 | x = -4.3 | 4.2 µs | 20 |");
        assert!(lines[4].contains("| not reached |"));
        let bytes = csv(&verdicts).unwrap().bytes;
        assert_eq!(String::from_utf8(bytes).unwrap().lines().count(), 4);
    }
}
