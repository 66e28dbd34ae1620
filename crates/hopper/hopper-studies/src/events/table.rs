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

/// The sums over all scenes, a program a row, with the smallest and the largest time of an event in that of the first program.
pub(crate) fn totals(verdicts: &[Verdict]) -> String {
    let mut programs: Vec<&str> = Vec::new();
    for verdict in verdicts {
        if !programs.contains(&verdict.program.as_str()) {
            programs.push(&verdict.program);
        }
    }
    let first = programs.first().copied().unwrap_or_default();
    let row = |program: &&str| {
        let own: Vec<&Verdict> = verdicts.iter().filter(|own| own.program == *program).collect();
        let events: usize = own.iter().map(|own| own.exact).sum();
        let missed: usize = own.iter().map(|own| own.exact - own.right).sum();
        let wrong: usize = own.iter().map(|own| own.wrong).sum();
        let right = own.iter().filter(|own| own.end == End::Right).count();
        let ratios = own.iter().filter_map(|own| {
            let ours = verdicts.iter().find(|v| v.program == first && v.scene == own.scene)?;
            Some(own.seconds / ours.seconds)
        });
        let (low, high) = ratios
            .fold((f64::INFINITY, 0.0f64), |(low, high), ratio| (low.min(ratio), high.max(ratio)));
        let times = match *program == first {
            true => "1".into(),
            false => format!("{} to {}", two_digits(low), two_digits(high)),
        };
        format!("{program} | {events} | {missed} | {wrong} | {right} of {} | {times}", own.len())
    };
    let columns =
        "program | events: | missed: | wrong: | scenes that end right: | time per event, ours = 1:";
    markdown_table(columns, programs.iter().map(row))
}

/// A positive number with two digits.
fn two_digits(number: f64) -> String {
    let rounded: f64 = format!("{number:.1e}").parse().unwrap_or(number);
    rounded.to_string()
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

    /// The table of docs/note.md has the sums of docs/events.csv.
    #[test]
    fn the_note_has_the_sums_of_the_measurements() {
        let docs = crate::repository::repository().join("docs");
        let [data, note] =
            ["events.csv", "note.md"].map(|name| std::fs::read_to_string(docs.join(name)).unwrap());
        let verdicts = data.lines().skip(1).map(|line| {
            let fields: Vec<&str> = line.split(',').collect();
            let number = |at: usize| fields[at].parse::<usize>().unwrap();
            Verdict {
                scene: fields[0].into(),
                program: fields[1].into(),
                exact: number(2),
                right: number(2) - number(3),
                wrong: number(4),
                error: fields[5].parse().unwrap(),
                end: match fields[6] {
                    "right" => End::Right,
                    "not reached" => End::Stuck,
                    _ => End::Wrong(0.0),
                },
                seconds: fields[7].parse().unwrap(),
                lines: number(8),
            }
        });
        let table = totals(&verdicts.collect::<Vec<_>>());
        assert!(note.contains(&table), "docs/note.md needs this table:\n{table}");
    }

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
