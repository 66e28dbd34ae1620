//! The scores as CSV and as tables of `docs/accuracy.md`.

use super::scenes::Scene;
use super::{METHODS, Method, Score};
use crate::Error;
use std::fmt::Write;
use std::time::Duration;

/// Methods in the tables: not every tolerance.
fn shown(method: Method) -> bool {
    !matches!(method, Method::Integrated(k) if k % 3 != 0)
}

/// One line a class and method.
pub(crate) fn csv(scores: &[Score], unit: Duration) -> Result<Vec<u8>, Error> {
    let fail = |e: csv::Error| Error::Render {
        what: "work_precision.csv".to_owned(),
        reason: e.to_string(),
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer
        .write_record([
            "class",
            "method",
            "cases",
            "refused",
            "wrong_verdicts",
            "median_error",
            "worst_error",
            "seconds_per_hop",
            "sin_cos_per_hop",
        ])
        .map_err(fail)?;
    for score in scores {
        let number = |value: Option<f64>| value.map_or(String::new(), |v| format!("{v:e}"));
        let seconds = score.time.map(|time| time.as_secs_f64());
        writer
            .write_record([
                score.class.clone(),
                score.method.name(),
                score.cases.to_string(),
                score.refused.to_string(),
                score.wrong.to_string(),
                number(score.errors.map(|e| e.0)),
                number(score.errors.map(|e| e.1)),
                number(seconds),
                number(seconds.map(|s| s / unit.as_secs_f64())),
            ])
            .map_err(fail)?;
    }
    writer
        .into_inner()
        .map_err(|e| Error::Render { what: "work_precision.csv".into(), reason: e.to_string() })
}

/// The paper's window in full, and the hard classes by their worst errors.
pub(crate) fn methods(scores: &[Score], unit: Duration) -> String {
    let mut out = String::from(
        "| on the paper's window | time a hop | in `sin_cos` | median error | worst error | wrong | refused |\n\
         |---|---:|---:|---:|---:|---:|---:|\n",
    );
    for score in scores.iter().filter(|s| s.class == "window" && shown(s.method)) {
        let (median, worst) = match score.errors {
            Some((median, worst)) => (digit(median), digit(worst)),
            None => ("–".into(), "–".into()),
        };
        let (time, units) = match score.time {
            Some(time) => {
                let units = time.as_secs_f64() / unit.as_secs_f64();
                let digits = usize::from(units < 9.95);
                (duration(time), format!("{units:.digits$}"))
            }
            None => ("–".into(), "–".into()),
        };
        let (wrong, refused) = (score.wrong, score.refused);
        let name = score.method.name();
        let _ = writeln!(
            out,
            "| {name} | {time} | {units} | {median} | {worst} | {wrong} | {refused} |"
        );
    }
    out.push_str(
        "\nThe hard classes: worst error, time a hop; then, if any, wrong verdicts and refused inputs.\n\n",
    );
    let mut classes: Vec<&str> = Vec::new();
    for score in scores.iter().filter(|s| s.class != "window") {
        if !classes.contains(&score.class.as_str()) {
            classes.push(&score.class);
        }
    }
    let _ = writeln!(out, "| method | {} |", classes.join(" | "));
    let _ = writeln!(out, "|---|{}", "---|".repeat(classes.len()));
    for &method in METHODS.iter().filter(|&&method| shown(method)) {
        let cells = classes.iter().map(|class| {
            let score = scores.iter().find(|s| s.class == *class && s.method == method);
            score.map_or(String::new(), cell)
        });
        let _ = writeln!(out, "| {} | {} |", method.name(), cells.collect::<Vec<_>>().join(" | "));
    }
    out
}

fn cell(score: &Score) -> String {
    let (Some((_, worst)), Some(time)) = (score.errors, score.time) else { return "–".into() };
    let mut text = format!("{}, {}", digit(worst), duration(time));
    if score.wrong > 0 {
        let _ = write!(text, ", {} wrong", score.wrong);
    }
    if score.refused > 0 {
        let _ = write!(text, ", {} refused", score.refused);
    }
    text
}

/// Which question needs which model.
pub(crate) fn scenes(scenes: &[Scene]) -> String {
    let mut out =
        String::from("| question | model only | call | time | error |\n|---|---|---|---:|---|\n");
    for scene in scenes {
        let Scene { question, model, call, time, per, error } = scene;
        let time = duration(*time);
        let _ = writeln!(out, "| {question} | {model} | {call} | {time} {per} | {error} |");
    }
    out
}

/// An error to one digit.
pub(crate) fn digit(error: f64) -> String {
    if error == 0.0 { "0".into() } else { format!("{error:.0e}") }
}

/// Two digits and a unit.
pub(crate) fn duration(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    let (value, unit) = match seconds {
        s if s < 1e-6 => (s * 1e9, "ns"),
        s if s < 1e-3 => (s * 1e6, "µs"),
        s if s < 1.0 => (s * 1e3, "ms"),
        s => (s, "s"),
    };
    let digits = usize::from(value < 9.95);
    format!("{value:.digits$} {unit}")
}

/// `text` with what stands between the markers of `name` replaced by `block`.
pub(crate) fn replace_block(text: &str, name: &str, block: &str) -> Result<String, Error> {
    let (begin, end) = (format!("<!-- begin {name} -->\n"), format!("<!-- end {name} -->"));
    let missing = || Error::Render {
        what: "docs/accuracy.md".to_owned(),
        reason: format!("it has no markers for '{name}'"),
    };
    let (before, rest) = text.split_once(&begin).ok_or_else(missing)?;
    let (_, after) = rest.split_once(&end).ok_or_else(missing)?;
    Ok(format!("{before}{begin}{}\n\n{end}{after}", block.trim_end()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_have_two_digits_and_a_unit() {
        let text = |seconds: f64| duration(Duration::from_secs_f64(seconds));
        assert_eq!(text(9.0e-9), "9.0 ns");
        assert_eq!(text(7.4e-7), "740 ns");
        assert_eq!(text(2.1e-6), "2.1 µs");
        assert_eq!(text(0.013), "13 ms");
    }

    #[test]
    fn blocks_are_replaced_between_their_markers() {
        let text = "a\n<!-- begin x -->\nold\n<!-- end x -->\nb";
        let new = replace_block(text, "x", "new\n").unwrap();
        assert_eq!(new, "a\n<!-- begin x -->\nnew\n\n<!-- end x -->\nb");
        assert!(replace_block(text, "y", "new").is_err());
    }

    /// The document has the blocks that the command fills, filled with all methods.
    #[test]
    fn the_document_is_filled() {
        let path = crate::output::repository().join("docs/accuracy.md");
        let text = crate::output::read(&path).unwrap();
        for name in ["methods", "scenes"] {
            assert!(replace_block(&text, name, "").is_ok());
        }
        for method in METHODS.iter().filter(|&&method| shown(method)) {
            assert!(text.contains(&method.name()), "{}", method.name());
        }
    }
}
