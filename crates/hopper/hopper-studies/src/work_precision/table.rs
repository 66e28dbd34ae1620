//! The scores as CSV and as tables of `docs/accuracy.md`.

use super::methods::Method;
use super::scenes::Scene;
use super::score::Score;
use crate::error::Error;
use crate::text::{digit, duration, markdown_table};
use journal_figures::{DataFile, csv_text};
use std::fmt::Write;
use std::time::Duration;

/// Whether a method is in the tables. Of the tolerances every third is: 1e-3, 1e-6, 1e-9 and 1e-12.
fn shown(method: Method) -> bool {
    !matches!(method, Method::Integrated(k) if k % 3 != 0)
}

/// The methods in the table of the hard classes: the two that this project recommends, the paper's own equations, and
/// what a user of an ODE solver would do. The CSV file has all methods.
const HARD: [Method; 4] = [Method::Stable, Method::Local, Method::Printed, Method::Integrated(9)];

/// One line for each class and method.
pub(crate) fn csv(scores: &[Score], unit: Duration) -> Result<DataFile, Error> {
    let header = [
        "class",
        "method",
        "cases",
        "refused",
        "wrong_verdicts",
        "median_error",
        "worst_error",
        "seconds_per_hop",
        "sin_cos_per_hop",
    ];
    let number = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:e}"));
    let rows = scores.iter().map(|score| {
        let seconds = score.time.map(|time| time.as_secs_f64());
        vec![
            score.class.clone(),
            score.method.name(),
            score.cases.to_string(),
            score.refused.to_string(),
            score.wrong.to_string(),
            number(score.errors.map(|e| e.0)),
            number(score.errors.map(|e| e.1)),
            number(seconds),
            number(seconds.map(|s| s / unit.as_secs_f64())),
        ]
    });
    Ok(csv_text("work_precision.csv", &header, rows)?)
}

/// A table of the paper's window with all numbers, and one of the hard classes for the methods in [`HARD`]. `unit` is
/// the time of one `sin_cos`.
pub(crate) fn methods(scores: &[Score], unit: Duration) -> String {
    let row = |score: &Score| {
        let (median, worst) = match score.errors {
            Some((median, worst)) => (digit(median), digit(worst)),
            None => ("–".into(), "–".into()),
        };
        let (time, units) = match score.time {
            Some(time) => {
                let units = time.as_secs_f64() / unit.as_secs_f64();
                let digits = usize::from(units < 9.95);
                (duration(time.as_secs_f64()), format!("{units:.digits$}"))
            }
            None => ("–".into(), "–".into()),
        };
        let (wrong, refused) = (score.wrong, score.refused);
        let name = score.method.name();
        format!("{name} | {time} | {units} | {median} | {worst} | {wrong} | {refused}")
    };
    let columns = "on the paper's window | time a hop: | in `sin_cos`: | median error: | worst error: | wrong: | \
                   refused:";
    let window = scores.iter().filter(|s| s.class == "window" && shown(s.method));
    let mut out = markdown_table(columns, window.map(row));
    out.push_str(
        "\nThe hard classes: the worst error, then, if any, the wrong decisions and the refused inputs. All methods, \
         with \
         their times, are in [work_precision.csv](work_precision.csv).\n\n",
    );
    let mut classes: Vec<&str> = Vec::new();
    for score in scores.iter().filter(|s| s.class != "window") {
        if !classes.contains(&score.class.as_str()) {
            classes.push(&score.class);
        }
    }
    let names: Vec<String> = HARD.iter().map(|method| method.name()).collect();
    let row = |class: &str| {
        let cells = HARD.iter().map(|&method| {
            let score = scores.iter().find(|s| s.class == class && s.method == method);
            score.map_or(String::new(), cell)
        });
        format!("{class} | {}", cells.collect::<Vec<_>>().join(" | "))
    };
    let columns = format!("class | {}", names.join(" | "));
    out + &markdown_table(&columns, classes.into_iter().map(row))
}

/// A class and a method: the worst error, the wrong decisions and the refused inputs.
fn cell(score: &Score) -> String {
    let Some((_, worst)) = score.errors else { return "–".into() };
    let mut text = digit(worst);
    if score.wrong > 0 {
        let _ = write!(text, ", {} wrong", score.wrong);
    }
    if score.refused > 0 {
        let _ = write!(text, ", {} refused", score.refused);
    }
    text
}

/// The table of questions and models.
pub(crate) fn scenes(scenes: &[Scene]) -> String {
    let row = |scene: &Scene| {
        let Scene { question, model, call, time, per, error } = scene;
        let time = duration(time.as_secs_f64());
        format!("{question} | {model} | {call} | {time} {per} | {error}")
    };
    markdown_table("question | model only | call | time: | error", scenes.iter().map(row))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::replace_block;
    use crate::work_precision::methods::ALL as METHODS;

    /// The document has the blocks that the command fills, and contains every method of the tables.
    #[test]
    fn the_document_is_filled() {
        let path = crate::repository::repository().join("docs/accuracy.md");
        let text = crate::repository::read(&path).unwrap();
        for name in ["methods", "scenes"] {
            assert!(replace_block(&text, name, "").is_ok());
        }
        for method in METHODS.iter().filter(|&&method| shown(method)) {
            assert!(text.contains(&method.name()), "{}", method.name());
        }
        let lines = crate::repository::read(&path.with_file_name("work_precision.csv")).unwrap();
        for method in METHODS {
            let name = method.name();
            // A name with a comma is quoted in the file.
            let known = [format!("window,{name},"), format!("window,\"{name}\",")];
            assert!(lines.lines().any(|line| known.iter().any(|k| line.starts_with(k))), "{name}");
        }
    }
}
